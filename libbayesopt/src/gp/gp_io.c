/* A regression as a text file: numbers in hexadecimal floating point, which round-trips. */
#include "core/error.h"
#include "gp/gp_internal.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void put(FILE *file, const char *key, size_t n, const double *values)
{
    fprintf(file, "%s", key);
    for (size_t i = 0; i < n; i++)
        fprintf(file, " %a", values[i]);
    fputc('\n', file);
}

static void write_all(const bayesopt_gp *gp, FILE *file)
{
    const bayesopt_gp_options *o = &gp->options;
    const struct transform *t = &gp->transform;
    double head[] = {(double)gp->d, (double)gp->n, o->kernel,    o->scales,
                     o->mean,       o->noise,      o->transform, o->choice};
    double prior[] = {o->prior_shift,
                      o->prior_common,
                      o->prior_variance,
                      (double)o->starts,
                      (double)o->evaluations,
                      (double)(o->seed >> 32),
                      (double)(o->seed & UINT32_MAX)};
    double state[] = {gp->has_parameters, gp->isotropic,  gp->wide,         gp->signal,
                      gp->noise,          gp->fixed_mean, gp->log_posterior};
    double map[] = {t->kind, t->shift, t->unit, t->lambda, (double)t->n, t->offset, t->scale};
    /* Version 1 knows no categories, and files without keep it. */
    fprintf(file, "bayesopt-gp %d\n", gp->categorical ? 2 : 1);
    put(file, "head", sizeof head / sizeof *head, head);
    put(file, "prior", sizeof prior / sizeof *prior, prior);
    put(file, "state", sizeof state / sizeof *state, state);
    put(file, "scales", gp->d, gp->lengthscale);
    fprintf(file, "groups");
    for (size_t j = 0; j < gp->d; j++)
        fprintf(file, " %zu", gp->group[j]);
    fputc('\n', file);
    if (gp->categorical) {
        fprintf(file, "categorical");
        for (size_t j = 0; j < gp->d; j++)
            fprintf(file, " %d", gp->categorical[j]);
        fputc('\n', file);
    }
    put(file, "map", sizeof map / sizeof *map, map);
    put(file, "knots", t->n, t->knots);
    put(file, "scores", t->n, t->scores);
    for (size_t i = 0; i < gp->n; i++)
        put(file, "x", gp->d, gp->x + i * gp->d);
    put(file, "y", gp->n, gp->y);
    put(file, "variance", gp->n, gp->variance);
}

/* Numbers are written and read in the C locale whatever the program's is. */
static locale_t enter_c_locale(locale_t *before)
{
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c)
        *before = uselocale(c);
    return c;
}

static void leave_c_locale(locale_t c, locale_t before)
{
    uselocale(before);
    freelocale(c);
}

bayesopt_status bayesopt_gp_save(const bayesopt_gp *gp, const char *path)
{
    NEED(gp);
    NEED(path);
    size_t length = strlen(path);
    char *temporary = malloc(length + 5);
    if (!temporary)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "gp: out of memory");
    memcpy(temporary, path, length);
    memcpy(temporary + length, ".new", 5);
    FILE *file = fopen(temporary, "w");
    bool ok = file != NULL;
    int reason = errno;
    if (ok) {
        locale_t before, c = enter_c_locale(&before);
        ok = c != (locale_t)0;
        if (ok) {
            write_all(gp, file);
            leave_c_locale(c, before);
        }
        ok = ok && !ferror(file) && fflush(file) == 0 && fsync(fileno(file)) == 0;
        reason = errno;
        bool closed = fclose(file) == 0;
        if (ok && (!closed || rename(temporary, path) != 0)) {
            reason = errno;
            ok = false;
        }
        if (!ok)
            remove(temporary);
    }
    free(temporary);
    if (ok)
        return BAYESOPT_OK;
    return bayesopt_fail(reason == ENOMEM ? BAYESOPT_ERROR_MEMORY : BAYESOPT_ERROR_FILE,
                         "%s: cannot be written: %s", path, strerror(reason));
}

/* Reads "key" and n numbers; at most one of them may be NAN where the format says so. */
static bool get(FILE *file, const char *key, size_t n, double *values)
{
    char word[32];
    if (fscanf(file, "%31s", word) != 1 || strcmp(word, key) != 0)
        return false;
    for (size_t i = 0; i < n; i++) {
        char text[64], *end;
        if (fscanf(file, "%63s", text) != 1)
            return false;
        values[i] = strtod(text, &end);
        if (end == text || *end != '\0')
            return false;
    }
    return true;
}

/* A number that is a whole one in 0..most. */
static bool whole(double value, double most)
{
    return value >= 0 && value <= most && value == floor(value);
}

static bool read_options(FILE *file, const double *head, bayesopt_gp_options *o)
{
    double prior[7];
    if (!get(file, "prior", 7, prior))
        return false;
    for (int i = 2; i < 8; i++)
        if (!whole(head[i], 16))
            return false;
    if (!whole(prior[3], 1e6) || !whole(prior[4], 1e6) || !whole(prior[5], UINT32_MAX) ||
        !whole(prior[6], UINT32_MAX))
        return false;
    *o = (bayesopt_gp_options){
        .kernel = (bayesopt_kernel)head[2],
        .scales = (bayesopt_scales)head[3],
        .mean = (bayesopt_mean)head[4],
        .noise = (bayesopt_noise)head[5],
        .transform = (bayesopt_transform)head[6],
        .choice = (bayesopt_choice)head[7],
        .prior_shift = prior[0],
        .prior_common = prior[1],
        .prior_variance = prior[2],
        .starts = (size_t)prior[3],
        .evaluations = (size_t)prior[4],
        .seed = ((uint64_t)prior[5] << 32) | (uint64_t)prior[6],
    };
    return true;
}

static bool read_map(FILE *file, struct transform *t)
{
    double map[7];
    if (!get(file, "map", 7, map) || !whole(map[0], BAYESOPT_TRANSFORM_WINSORISED) ||
        !whole(map[4], 1e6) || !isfinite(map[5]) || !(map[6] > 0))
        return false;
    transform_free(t);
    *t = (struct transform){.kind = (bayesopt_transform)map[0],
                            .shift = map[1],
                            .unit = map[2],
                            .lambda = map[3],
                            .n = (size_t)map[4],
                            .offset = map[5],
                            .scale = map[6]};
    t->knots = malloc((t->n + 1) * sizeof(double));
    t->scores = malloc((t->n + 1) * sizeof(double));
    return t->knots && t->scores && get(file, "knots", t->n, t->knots) &&
           get(file, "scores", t->n, t->scores);
}

/* Room grows with what the file has, not with what its head claims. */
static double *read_points(FILE *file, size_t d, size_t n)
{
    double *x = malloc((d + 1) * sizeof *x);
    bool ok = x != NULL;
    for (size_t i = 0, room = 1; i < n && ok; i++) {
        double *more = i < room ? x : realloc(x, 2 * room * d * sizeof *x);
        room = i < room ? room : 2 * room;
        x = more ? more : x;
        ok = more && get(file, "x", d, x + i * d);
    }
    if (!ok) {
        free(x);
        x = NULL;
    }
    return x;
}

static bool read_data(FILE *file, bayesopt_gp *gp, size_t n)
{
    double *x = read_points(file, gp->d, n), *y = x ? malloc((2 * n + 1) * sizeof *y) : NULL;
    bool ok = y && get(file, "y", n, y) && get(file, "variance", n, y + n) &&
              !bayesopt_gp_set_data(gp, n, x, y, y + n);
    free(x);
    free(y);
    return ok;
}

static bool read_state(FILE *file, bayesopt_gp *gp, size_t *group)
{
    double state[7], *groups = malloc(gp->d * sizeof *groups);
    bool ok = groups && get(file, "state", 7, state) &&
              get(file, "scales", gp->d, gp->lengthscale) && get(file, "groups", gp->d, groups);
    size_t count = 0; /* of groups, whose numbers have no gaps */
    for (size_t j = 0; j < gp->d && ok; j++) {
        ok = gp->lengthscale[j] >= 0 && isfinite(gp->lengthscale[j]) &&
             whole(groups[j], (double)count);
        group[j] = ok ? (size_t)groups[j] : 0;
        count += ok && group[j] == count;
    }
    free(groups);
    if (!ok || !(state[3] >= 0 && isfinite(state[3])) || !(state[4] >= 0 && isfinite(state[4])) ||
        !isfinite(state[5]))
        return false;
    gp->has_parameters = state[0] != 0;
    gp->isotropic = state[1] != 0;
    gp->wide = state[2] != 0;
    gp->signal = state[3];
    gp->noise = state[4];
    gp->fixed_mean = state[5];
    gp->log_posterior = state[6];
    return true;
}

/* Whether each variable is categorical, of files that have that line. */
static bool read_categorical(FILE *file, bayesopt_gp *gp)
{
    double *values = malloc(gp->d * sizeof *values);
    gp->categorical = calloc(gp->d, sizeof *gp->categorical);
    gp->jump = calloc(gp->d, sizeof *gp->jump);
    bool ok = values && gp->categorical && gp->jump && get(file, "categorical", gp->d, values);
    for (size_t j = 0; j < gp->d && ok; j++) {
        ok = whole(values[j], 1);
        gp->categorical[j] = values[j] != 0;
    }
    free(values);
    return ok;
}

static bayesopt_status read_all(FILE *file, bayesopt_gp **out)
{
    double head[8], version;
    bayesopt_gp_options options;
    bayesopt_gp *gp = NULL;
    if (!get(file, "bayesopt-gp", 1, &version) || (version != 1 && version != 2) ||
        !get(file, "head", 8, head) || !whole(head[0], BAYESOPT_MOST_VARIABLES) ||
        !whole(head[1], BAYESOPT_MOST_POINTS) || !read_options(file, head, &options))
        return BAYESOPT_ERROR_FORMAT;
    /* Groups come later in the file; until they are read every variable is its own. */
    bayesopt_scales scales = options.scales;
    if (scales == BAYESOPT_SCALES_TIED)
        options.scales = BAYESOPT_SCALES_ARD;
    bayesopt_status status = bayesopt_gp_create((size_t)head[0], &options, &gp);
    if (status)
        return status == BAYESOPT_ERROR_MEMORY ? status : BAYESOPT_ERROR_FORMAT;
    gp->options.scales = scales;
    bool ok = read_state(file, gp, gp->group) && (version < 2 || read_categorical(file, gp)) &&
              read_map(file, &gp->transform) && read_data(file, gp, (size_t)head[1]);
    if (ok && gp->has_parameters && gp->n)
        ok = gp_condition(gp);
    if (!ok) {
        bayesopt_gp_free(gp);
        return BAYESOPT_ERROR_FORMAT;
    }
    *out = gp;
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_gp_load(const char *path, bayesopt_gp **gp)
{
    NEED(path);
    NEED(gp);
    FILE *file = fopen(path, "r");
    if (!file)
        return bayesopt_fail(errno == ENOMEM ? BAYESOPT_ERROR_MEMORY : BAYESOPT_ERROR_FILE,
                             "%s: cannot be read: %s", path, strerror(errno));
    locale_t before, c = enter_c_locale(&before);
    bayesopt_status status = BAYESOPT_ERROR_MEMORY;
    errno = 0;
    if (c) {
        status = read_all(file, gp);
        leave_c_locale(c, before);
    }
    /* Readers and the algebra say no more than that they could not. */
    bool no_memory = status == BAYESOPT_ERROR_MEMORY || (status && errno == ENOMEM);
    bool unread = ferror(file) != 0;
    int reason = errno;
    fclose(file);
    if (no_memory)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "%s: out of memory", path);
    if (unread)
        return bayesopt_fail(BAYESOPT_ERROR_FILE, "%s: cannot be read: %s", path, strerror(reason));
    return status ? bayesopt_fail(status, "%s: not a regression saved by bayesopt_gp_save()", path)
                  : BAYESOPT_OK;
}
