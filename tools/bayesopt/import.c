#include "import.h"

#include "csv.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Columns of a table; SIZE_MAX: it has none such. */
struct columns {
    size_t id, f, state, level, note;
    size_t *variables;   /* [d] */
    size_t *constraints; /* [m] */
    bool has_variables;
};

/* One row. */
struct entry {
    bool skipped; /* pending or lost in the table: nothing to tell */
    bool asked;   /* the result of a pending point of the store */
    uint64_t id;
    double *x, *constraints;
    double f;
    const char *note;
};

static void columns_free(struct columns *c)
{
    free(c->variables);
    free(c->constraints);
}

static bool find_columns(const struct csv *csv, const struct names *names, struct columns *c)
{
    *c = (struct columns){csv_column(csv, "id"),
                          SIZE_MAX,
                          csv_column(csv, "state"),
                          csv_column(csv, "level"),
                          csv_column(csv, "note"),
                          malloc(names->d * sizeof(size_t)),
                          malloc((names->m + 1) * sizeof(size_t)),
                          true};
    if (!c->variables || !c->constraints)
        return cli_refuse("out of memory");
    bool ok = csv_need(csv, "f", &c->f);
    for (size_t j = 0; j < names->d && ok; j++) {
        c->variables[j] = csv_column(csv, names->variables[j]);
        c->has_variables = c->has_variables && c->variables[j] != SIZE_MAX;
    }
    for (size_t j = 0; j < names->d && ok && !c->has_variables; j++)
        if (c->id == SIZE_MAX && c->variables[j] == SIZE_MAX)
            ok = cli_refuse("%s: expected a column 'id', or one for every variable: there is none "
                            "called '%s'",
                            csv->path, names->variables[j]);
    for (size_t k = 0; k < names->m && ok; k++)
        ok = csv_need(csv, names->constraints[k], &c->constraints[k]);
    return ok;
}

static bool has_state(const struct csv *csv, const struct columns *c, size_t row, const char *state)
{
    return c->state != SIZE_MAX && strcmp(csv_cell(csv, row, c->state), state) == 0;
}

/* The pending point of a row's id, if its variables, when the table has them, are the row's. */
static bool find_asked(const bayesopt *bo, const struct names *names, const struct columns *c,
                       struct entry *e)
{
    bayesopt_point p;
    for (size_t i = 0; i < bayesopt_count(bo); i++)
        if (!bayesopt_get(bo, i, &p) && p.id == e->id)
            return p.state == BAYESOPT_STATE_PENDING &&
                   (!c->has_variables || memcmp(p.x, e->x, names->d * sizeof *e->x) == 0);
    return false;
}

static bool read_id(const struct csv *csv, const struct columns *c, size_t row, struct entry *e)
{
    size_t id;
    const char *text = csv_cell(csv, row, c->id);
    bool ok = cli_parse_size(text, &id) || cli_refuse("%s:%zu: id is '%s', expected a whole number",
                                                      csv->path, csv->lines[row], text);
    e->id = ok ? id : 0;
    return ok;
}

/* The values of a row. A point that failed may have none. */
static bool read_values(const struct csv *csv, const struct names *names, const struct columns *c,
                        size_t row, struct entry *e)
{
    bool failed = has_state(csv, c, row, "failed"), ok = true;
    e->note = c->note != SIZE_MAX ? csv_cell(csv, row, c->note) : NULL;
    e->f = NAN;
    if (!failed)
        ok = csv_number(csv, row, c->f, &e->f);
    for (size_t k = 0; k < names->m && ok; k++) {
        e->constraints[k] = NAN;
        if (isfinite(e->f))
            ok = csv_number(csv, row, c->constraints[k], &e->constraints[k]);
    }
    return ok;
}

static bool read_entry(const bayesopt *bo, const struct names *names, const struct csv *csv,
                       const struct columns *c, size_t row, struct entry *e)
{
    double level;
    bool ok = true;
    e->skipped = has_state(csv, c, row, "pending") || has_state(csv, c, row, "lost");
    for (size_t j = 0; j < names->d && ok && c->has_variables; j++)
        ok = csv_value(csv, row, c->variables[j], names, j, &e->x[j]);
    ok = ok && (c->id == SIZE_MAX || read_id(csv, c, row, e)) &&
         (e->skipped || read_values(csv, names, c, row, e));
    e->asked = ok && c->id != SIZE_MAX && find_asked(bo, names, c, e);
    if (ok && !e->skipped && !e->asked && !c->has_variables)
        ok = cli_refuse("%s:%zu: no pending point has the id %llu", csv->path, csv->lines[row],
                        (unsigned long long)e->id);
    if (ok && !e->skipped && !e->asked && c->level != SIZE_MAX && bayesopt_level_count(bo) > 1)
        ok = csv_number(csv, row, c->level, &level) &&
             (level == 1 || cli_refuse("%s:%zu: a value of the cheap level, expected level 1",
                                       csv->path, csv->lines[row]));
    return ok;
}

/* Whether every new point lies within the bounds. */
static bool check_bounds(const bayesopt *bo, const struct names *names, const struct csv *csv,
                         const struct entry *entries)
{
    double *lower = malloc(2 * names->d * sizeof *lower), *upper = lower + names->d;
    bool ok = lower || cli_refuse("out of memory");
    if (ok)
        bayesopt_dimension(bo, lower, upper);
    for (size_t i = 0; i < csv->rows && ok; i++)
        for (size_t j = 0; j < names->d && ok && !entries[i].asked && !entries[i].skipped; j++)
            ok = (entries[i].x[j] >= lower[j] && entries[i].x[j] <= upper[j]) ||
                 cli_refuse("%s:%zu: %s is %g, expected %g to %g", csv->path, csv->lines[i],
                            names->variables[j], entries[i].x[j], lower[j], upper[j]);
    free(lower);
    return ok;
}

static bool tell(bayesopt *bo, const struct names *names, const struct csv *csv,
                 const struct entry *entries, bool outside)
{
    for (size_t i = 0; i < csv->rows; i++) {
        const struct entry *e = &entries[i];
        const bayesopt_result result = {.f = e->f,
                                        .constraints = names->m ? e->constraints : NULL,
                                        .note = e->note && *e->note ? e->note : NULL,
                                        .outside = outside};
        bayesopt_status status = e->skipped ? BAYESOPT_OK
                                 : e->asked ? bayesopt_tell_result(bo, e->id, &result)
                                            : bayesopt_tell_point_result(bo, e->x, &result, NULL);
        if (status)
            return cli_refuse("%s:%zu: %s", csv->path, csv->lines[i], bayesopt_last_error());
    }
    return true;
}

bool import_table(bayesopt *bo, const struct names *names, const char *path, bool outside)
{
    struct csv csv;
    struct columns columns;
    if (!csv_read(path, &csv))
        return false;
    bool ok = find_columns(&csv, names, &columns);
    size_t width = names->d + names->m;
    struct entry *entries = calloc(csv.rows + 1, sizeof *entries);
    double *numbers = calloc((csv.rows + 1) * width, sizeof *numbers);
    if (ok && (!entries || !numbers))
        ok = cli_refuse("out of memory");
    for (size_t i = 0; i < csv.rows && ok; i++) {
        entries[i].x = numbers + i * width;
        entries[i].constraints = entries[i].x + names->d;
        ok = read_entry(bo, names, &csv, &columns, i, &entries[i]);
    }
    ok = ok && (outside || check_bounds(bo, names, &csv, entries)) &&
         tell(bo, names, &csv, entries, outside);
    free(entries);
    free(numbers);
    columns_free(&columns);
    csv_free(&csv);
    return ok;
}
