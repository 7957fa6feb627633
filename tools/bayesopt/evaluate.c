#include "evaluate.h"

#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Writes the value of a template's field: a variable, the id, the level. false: unknown. */
static bool expand(const struct config *c, const struct evaluation *e, const char *name,
                   size_t length, FILE *out)
{
    if (length == 5 && strncmp(name, "level", 5) == 0)
        return fprintf(out, "%d", e->level) > 0;
    if (length == 2 && strncmp(name, "id", 2) == 0)
        return fprintf(out, "%llu", (unsigned long long)e->id) > 0;
    for (size_t j = 0; j < c->names.d; j++)
        if (strlen(c->names.variables[j]) == length &&
            strncmp(c->names.variables[j], name, length) == 0)
            return fprintf(out, "%.17g", e->x[j]) > 0;
    return false;
}

/* The command with every {name} replaced; "{{" stands for a brace. NULL with a sentence on failure.
 */
static char *fill_template(const struct config *c, const struct evaluation *e)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool ok = out != NULL, cheap = c->options.n_levels == 2 && e->level == 0;
    for (const char *p = cheap ? c->cheap : c->command; ok && *p; p++) {
        const char *end = *p == '{' ? strchr(p, '}') : NULL;
        if (p[0] == '{' && p[1] == '{') {
            fputc('{', out);
            p++;
        } else if (end) {
            ok = expand(c, e, p + 1, (size_t)(end - p - 1), out);
            if (!ok)
                cli_fail("%s: %s has '%.*s}', which is no variable", c->path,
                         cheap ? "levels.cheap" : "objective.command", (int)(end - p), p);
            p = end;
        } else {
            fputc(*p, out);
        }
    }
    if (out && fclose(out) != 0)
        ok = false;
    if (!ok) {
        free(text);
        text = NULL;
    }
    return text;
}

/* In the child: working folder, output files, a process group of its own to be killed as one. */
static void become(const struct evaluation *e, const char *command)
{
    setpgid(0, 0);
    if (chdir(e->folder) != 0)
        _exit(127);
    int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    int in = open("/dev/null", O_RDONLY);
    if (out < 0 || err < 0 || in < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0)
        _exit(127);
    execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    _exit(127);
}

bool evaluation_start(const struct config *c, struct evaluation *e)
{
    const char *parent = c->folder;
    char *command = fill_template(c, e);
    if (!command)
        return false;
    int length =
        snprintf(e->folder, sizeof e->folder, "%s/%06llu", parent, (unsigned long long)e->id);
    bool ok = length > 0 && (size_t)length < sizeof e->folder;
    if (!ok || (mkdir(parent, 0777) != 0 && errno != EEXIST) ||
        (mkdir(e->folder, 0777) != 0 && errno != EEXIST)) {
        cli_fail("%s: %s", e->folder, strerror(errno));
        ok = false;
    }
    if (ok) {
        e->timed_out = false;
        e->started = cli_seconds();
        e->process = fork();
        if (e->process == 0)
            become(e, command);
        ok = e->process > 0;
        if (ok)
            setpgid(e->process, e->process); /* in both, whichever comes first */
        else
            cli_fail("starting a process: %s", strerror(errno));
    }
    free(command);
    return ok;
}

void evaluation_check_time(const struct config *c, struct evaluation *e)
{
    if (!e->timed_out && cli_seconds() - e->started > c->timeout) {
        e->timed_out = true;
        kill(-e->process, SIGKILL);
    }
}

/* n numbers from the text on, brackets, quotes and separators ignored. */
static bool read_numbers(const char *text, size_t n, double *values)
{
    for (size_t i = 0; i < n; i++) {
        char *end;
        text += strspn(text, " \t\":=,[");
        values[i] = strtod(text, &end);
        if (end == text)
            return false;
        text = end;
    }
    return true;
}

/* The last n numbers that follow the key and one of ":= ," in the output, quotes ignored, so that
 * "cw: 3e-4", "cw = 3e-4", "cw 3e-4" and {"cw": 3e-4} all serve. */
static bool find_numbers(const char *text, const char *key, size_t n, double *values)
{
    bool found = false;
    size_t length = strlen(key);
    for (const char *p = text; (p = strstr(p, key)) != NULL; p += length) {
        bool starts = p == text || strchr(" \t\n\",{", p[-1]);
        const char *after = p + length;
        if (starts && strchr(" \t\":=,", *after) && *after)
            found = read_numbers(after, n, values) || found;
    }
    return found;
}

/* Without a key: the last number that ends a line. */
static bool last_number(const char *text, double *value)
{
    bool found = false;
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        size_t word = length;
        while (word > 0 && !strchr(" \t=:,", line[word - 1]))
            word--;
        char *end;
        double read = strtod(line + word, &end);
        if (end > line + word && end == line + length) {
            *value = read;
            found = true;
        }
        line += length + (line[length] == '\n');
    }
    return found;
}

static char *read_output(const struct evaluation *e)
{
    char path[600];
    snprintf(path, sizeof path, "%s/stdout", e->folder);
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t size = 0;
    FILE *out = file ? open_memstream(&text, &size) : NULL;
    for (int c; out && (c = fgetc(file)) != EOF;)
        fputc(c ? c : ' ', out);
    if (out)
        fclose(out);
    if (file)
        fclose(file);
    return text;
}

bool evaluation_read(const struct config *c, const struct evaluation *e, int status, double *f,
                     double *constraints, double *gradient, char *reason, size_t size)
{
    const char *key = c->key;
    if (e->timed_out)
        snprintf(reason, size, "took longer than %g s", c->timeout);
    else if (WIFSIGNALED(status))
        snprintf(reason, size, "killed by signal %d", WTERMSIG(status));
    else if (WEXITSTATUS(status) != 0)
        snprintf(reason, size, "exit status %d", WEXITSTATUS(status));
    else
        reason[0] = '\0';
    if (*reason)
        return false;
    char *text = read_output(e);
    bool ok = text && (key ? find_numbers(text, key, 1, f) : last_number(text, f));
    if (!ok)
        snprintf(reason, size, "no number%s%s in the output", key ? " after " : "", key ? key : "");
    for (size_t k = 0; k < c->names.m && ok; k++) {
        ok = find_numbers(text, c->names.constraints[k], 1, &constraints[k]);
        if (!ok)
            snprintf(reason, size, "no number after %s in the output", c->names.constraints[k]);
    }
    const char *slope = c->gradient;
    if (ok && slope && !find_numbers(text, slope, c->names.d, gradient)) {
        snprintf(reason, size, "not %zu numbers after %s in the output", c->names.d, slope);
        ok = false;
    }
    free(text);
    return ok;
}
