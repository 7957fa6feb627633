#include "core/external.h"

#include "fields.h"
#include "program.h"
#include "result.h"
#include "text.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_REASON = 400 };

/* The folder of the configuration, from the root. */
static bool find_here(const struct config *config, char here[PATH_MAX])
{
    const char *slash = strrchr(config->path, '/');
    size_t length = 0, given = slash ? (size_t)(slash - config->path) : 0;
    bool absolute = *config->path == '/';
    here[0] = '\0';
    if (!absolute && !getcwd(here, PATH_MAX))
        return core_fail("the working folder: %s", strerror(errno));
    length = strlen(here);
    if (length + given + 2 > PATH_MAX)
        return core_fail("%s: %s", config->path, strerror(ENAMETOOLONG));
    if (given)
        sprintf(here + length, "%s%.*s", absolute ? "" : "/", (int)given, config->path);
    return true;
}

/* The folder of the first number that is free, in the one of that kind: "hulls". */
static bool make_folder(const struct config *config, const char *here, const char *kind,
                        char folder[PATH_MAX])
{
    char parent[PATH_MAX];
    bool absolute = *config->folder == '/';
    int n = snprintf(parent, sizeof parent, "%s%s%s", absolute ? "" : here, absolute ? "" : "/",
                     config->folder);
    if (n < 0 || n > PATH_MAX - 64)
        return core_fail("folder: %s", strerror(ENAMETOOLONG));
    sprintf(parent + n, "/%s", kind);
    for (char *slash = parent + 1; (slash = strchr(slash, '/')) != NULL; *slash++ = '/') {
        *slash = '\0'; /* those above it, where there are none yet */
        if (mkdir(parent, 0777) != 0 && errno != EEXIST && access(parent, X_OK) != 0)
            return core_fail("%s: %s", parent, strerror(errno));
    }
    unsigned long long number = 1;
    do
        snprintf(folder, PATH_MAX, "%.*s/%06llu", PATH_MAX - 40, parent, number);
    while (access(folder, F_OK) == 0 && ++number);
    return program_folder(parent, number, folder, PATH_MAX) ||
           core_fail("%s: %s", folder, strerror(errno));
}

/* The command with its fields filled in, in the folder. */
static bool run(const struct config_command *c, struct config_fields *fields, const char *folder)
{
    char *text = NULL, reason[MOST_REASON];
    size_t size;
    FILE *out = text_open(&text, &size);
    if (out)
        fields_write(c->command, strlen(c->command), config_field, fields, out);
    if (!out || !text_close(out, &text))
        return core_no_memory();
    bool ok = program_run(folder, text, c->timeout, reason, sizeof reason);
    free(text);
    return ok || core_fail("command: %s", reason);
}

static double *values_of(const struct config *config, const double *u)
{
    double *x = malloc((config->n_parameters + 1) * sizeof *x);
    for (size_t k = 0; x && k < config->n_parameters; k++)
        x[k] = config->original[k] + (u ? u[k] : 0);
    if (!x)
        core_no_memory();
    return x;
}

static bool in_folder(const char *folder, const char *file, char path[CONFIG_PATH])
{
    return snprintf(path, CONFIG_PATH, "%s/%s", folder, file) < CONFIG_PATH ||
           core_fail("folder: %s", strerror(ENAMETOOLONG));
}

bool external_make(const struct config *config, const double *u, char path[CONFIG_PATH])
{
    char here[PATH_MAX], folder[PATH_MAX];
    double *x = values_of(config, u);
    struct config_fields fields = {.config = config, .x = x, .here = here};
    bool ok = x && find_here(config, here) && make_folder(config, here, "hulls", folder) &&
              in_folder(folder, config->maker.file, path) && run(&config->maker, &fields, folder);
    free(x);
    return ok && (access(path, R_OK) == 0 || core_fail("command: it ended well, but %s: %s",
                                                       config->maker.file, strerror(errno)));
}

/* A number in what the command printed. */
static bool read_value(const char *text, const char *key, double *value)
{
    char reason[MOST_REASON];
    bool ok = key ? result_find(text, key, RESULT_EQUAL, 1, value, reason, sizeof reason)
                  : result_last(text, value, reason, sizeof reason);
    if (ok && !isfinite(*value)) {
        snprintf(reason, sizeof reason, "%g is no finite number", *value);
        ok = false;
    }
    return ok || core_fail("objective: %s", reason);
}

static bool read_values(const struct config *config, const char *folder, double *value,
                        double others[OBJECTIVES_MOST - 1])
{
    char *text = program_read(folder, "stdout");
    if (!text)
        return core_fail("objective: stdout: %s", strerror(errno));
    bool ok = read_value(text, config->judge.key, value);
    for (size_t k = 0; k + 1 < OBJECTIVES_MOST; k++)
        if (config->other[k].quantity == QUANTITY_COMMAND)
            ok = ok && read_value(text, config->other[k].key, &others[k]);
    free(text);
    return ok;
}

bool external_judge(const struct config *config, const double *u, const nurbs_hull *hull,
                    double *value, double others[OBJECTIVES_MOST - 1])
{
    char here[PATH_MAX], folder[PATH_MAX], path[CONFIG_PATH];
    double *x = values_of(config, u);
    struct config_fields fields = {.config = config, .x = x, .here = here, .hull = path};
    bool ok = x && find_here(config, here) && make_folder(config, here, "objectives", folder) &&
              in_folder(folder, config->judge.file, path) &&
              (nurbs_patches_write(nurbs_hull_full(hull), path) == NURBS_OK ||
               core_fail("objective: %s", nurbs_last_error())) &&
              run(&config->judge, &fields, folder) && read_values(config, folder, value, others);
    free(x);
    return ok;
}
