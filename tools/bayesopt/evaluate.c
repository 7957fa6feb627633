#include "evaluate.h"

#include "cli.h"
#include "program.h"
#include "result.h"
#include "template.h"
#include "text.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char *fill_command(const struct config *c, const struct template_values *values)
{
    bool cheap = c->options.n_levels == 2 && values->level == 0;
    const char *command = cheap ? c->cheap : c->command;
    char *text = NULL;
    size_t size = 0;
    FILE *out = text_open(&text, &size);
    if (out)
        template_write(command, strlen(command), values, out);
    if (out && text_close(out, &text))
        return text;
    cli_fail("out of memory");
    return NULL;
}

/* A folder of the evaluation's number; where there is one, of an earlier attempt or another study.
 */
static bool make_folder(const struct config *c, struct evaluation *e)
{
    char *parent = config_folder(c);
    bool ok = parent && program_folder(parent, e->id, e->folder, sizeof e->folder);
    if (!ok)
        cli_fail("%s: %s", parent ? parent : "", strerror(errno));
    free(parent);
    return ok;
}

/* Ordinal values as the numbers that they are called. */
static void become_request(const struct config *c, const struct umbridge *model,
                           const struct evaluation *e)
{
    double *x = malloc(c->names.d * sizeof *x);
    char buffer[VALUE_SIZE];
    bool ok = x && program_enter(e->folder);
    for (size_t j = 0; j < c->names.d && ok; j++)
        if (!cli_parse_double(names_value(&c->names, j, e->x[j], buffer), &x[j]))
            x[j] = e->x[j];
    bool gradient = model->has_gradient && c->use_gradient;
    int code = ok ? umbridge_evaluate(model, x, gradient ? c->output : 0, stdout, stderr) : 127;
    _exit(fflush(stdout) == 0 && fflush(stderr) == 0 ? code : UMBRIDGE_LOST);
}

bool evaluation_start(const struct config *c, const struct umbridge *model, struct evaluation *e)
{
    const struct template_values values = {&c->names, e->x, e->id, e->level};
    char *command = model ? NULL : fill_command(c, &values);
    bool ok = (model || command) && make_folder(c, e);
    for (size_t i = 0; i < c->n_templates && ok; i++)
        ok = template_copy(c->templates[i], e->folder, &values);
    if (ok) {
        e->timed_out = false;
        e->started = cli_seconds();
        e->process = program_fork();
        if (e->process == 0 && model)
            become_request(c, model, e);
        else if (e->process == 0)
            program_become(e->folder, command);
        ok = e->process > 0;
        if (!ok)
            cli_fail("starting a process: %s", strerror(errno));
    }
    free(command);
    return ok;
}

void evaluation_check_time(const struct config *c, struct evaluation *e)
{
    if (!e->timed_out && cli_seconds() - e->started > c->timeout) {
        e->timed_out = true;
        program_kill(e->process);
    }
}

/* A file of the evaluation's folder as a text; NULL with errno. Want of memory is no failure of the
 * point: that is noted. */
static char *read_file(const struct evaluation *e, const char *name, struct outcome *o)
{
    char *text = program_read(e->folder, name);
    o->no_memory = o->no_memory || (!text && errno == ENOMEM);
    return text;
}

/* The numbers that a request has printed. */
static void read_answer(const struct config *c, const struct umbridge *model, const char *out,
                        struct outcome *o)
{
    char key[32];
    bool ok = out != NULL;
    if (!ok)
        snprintf(o->reason, sizeof o->reason, "stdout: %s", strerror(errno));
    for (size_t k = 0; k <= c->names.m && ok; k++) {
        snprintf(key, sizeof key, "output.%zu", k ? config_output(c, k - 1) : c->output);
        ok = result_find(out, key, RESULT_FIRST, 1, k ? &o->constraints[k - 1] : &o->f, o->reason,
                         sizeof o->reason);
    }
    if (ok && model->has_gradient && c->use_gradient)
        ok = result_find(out, "gradient", RESULT_FIRST, c->names.d, o->gradient, o->reason,
                         sizeof o->reason);
    o->kind = ok ? OUTCOME_DONE : OUTCOME_UNREAD;
}

/* The numbers of a process that ended well. */
static void read_numbers(const struct config *c, const struct evaluation *e, const char *out,
                         struct outcome *o)
{
    char *file = c->file ? read_file(e, c->file, o) : NULL;
    const char *text = c->file ? file : out;
    bool ok = text != NULL;
    if (!ok)
        snprintf(o->reason, sizeof o->reason, "%s: %s", c->file ? c->file : "stdout",
                 strerror(errno));
    ok = ok && (config_key(c) ? result_find(text, config_key(c), c->match, 1, &o->f, o->reason,
                                            sizeof o->reason)
                              : result_last(text, &o->f, o->reason, sizeof o->reason));
    for (size_t k = 0; k < c->names.m && ok; k++)
        ok = result_find(text, c->names.constraints[k], c->match, 1, &o->constraints[k], o->reason,
                         sizeof o->reason);
    if (ok && c->gradient)
        ok = result_find(text, c->gradient, c->match, c->names.d, o->gradient, o->reason,
                         sizeof o->reason);
    o->kind = ok ? OUTCOME_DONE : OUTCOME_UNREAD;
    free(file);
}

/* Whether a failure is one of those that the file calls transient. */
static bool is_transient(const struct config *c, const struct outcome *o, const char *err,
                         const char *out)
{
    if (o->kind == OUTCOME_TIMEOUT)
        return c->transient_timeout;
    bool listed = c->n_transient_status > 0;
    if (c->url && !listed && o->kind == OUTCOME_STATUS)
        return o->code == UMBRIDGE_LOST || o->code == UMBRIDGE_MODEL;
    for (size_t i = 0; i < c->n_transient_status && o->kind == OUTCOME_STATUS; i++)
        if (o->code == (int)c->transient_status[i])
            return true;
    const char *texts[] = {out, err};
    for (size_t i = 0; i < 2 && c->transient_pattern; i++)
        if (texts[i] && regexec(&c->pattern, texts[i], 0, NULL, 0) == 0)
            return true;
    return false;
}

bool evaluation_read(const struct config *c, const struct umbridge *model,
                     const struct evaluation *e, int status, struct outcome *o)
{
    o->no_memory = false;
    char *out = read_file(e, "stdout", o), *err = read_file(e, "stderr", o);
    o->reason[0] = '\0';
    o->transient = false;
    o->code = 0;
    o->f = NAN;
    if (e->timed_out) {
        o->kind = OUTCOME_TIMEOUT;
        snprintf(o->reason, sizeof o->reason, "took longer than %g s", c->timeout);
    } else if (WIFSIGNALED(status)) {
        o->kind = OUTCOME_SIGNAL;
        o->code = WTERMSIG(status);
        snprintf(o->reason, sizeof o->reason, "killed by signal %d", o->code);
    } else if (WEXITSTATUS(status) != 0) {
        o->kind = OUTCOME_STATUS;
        o->code = WEXITSTATUS(status);
        snprintf(o->reason, sizeof o->reason, "exit status %d", o->code);
    } else if (model) {
        read_answer(c, model, out, o);
    } else {
        read_numbers(c, e, out, o);
    }
    if (o->kind != OUTCOME_DONE) {
        o->transient = is_transient(c, o, err, out);
        program_add_words(err, o->kind == OUTCOME_UNREAD ? NULL : out, o->reason, sizeof o->reason);
    }
    free(out);
    free(err);
    return !o->no_memory || cli_refuse("%s: no memory for what the evaluation left", e->folder);
}
