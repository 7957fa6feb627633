#include "tangent/change.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <stdlib.h>
#include <string.h>

igabem_status rules_create(const struct influence *influence, struct rules **result)
{
    size_t n = influence->mesh->panels * REGULAR_CLASSES * REGULAR_CLASSES;
    struct rules *rules = calloc(1, sizeof *rules);
    *result = rules;
    if (rules)
        rules->rule = calloc(n, sizeof *rules->rule);
    if (!rules || !rules->rule)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu rules", n);
    rules->n = n;
    return IGABEM_OK;
}

void rules_free(struct rules *rules)
{
    if (!rules)
        return;
    for (size_t k = 0; k < rules->n; k++)
        free(rules->rule[k].x);
    free(rules->rule);
    free(rules);
}

struct rule *rules_of(const struct rules *rules, size_t panel, const int class[2])
{
    size_t k = panel * REGULAR_CLASSES + (size_t) class[0];
    return &rules->rule[k * REGULAR_CLASSES + (size_t) class[1]];
}

/* What filling takes, one of a thread. */
struct filler {
    struct nodes nodes;
    struct moving moving;
    double *change; /* [2][fields] */
};

static bool fill(const struct change *change, size_t k, struct filler *filler, struct rule *rule)
{
    const struct field *field = change->tangent->field;
    const struct nodes *nodes = &filler->nodes;
    const int class[2] = {(int)(k / REGULAR_CLASSES % REGULAR_CLASSES), (int)(k % REGULAR_CLASSES)};
    nodes_clear(&filler->nodes);
    regular_nodes(change->influence, k / (REGULAR_CLASSES * REGULAR_CLASSES), class,
                  &filler->nodes);
    size_t n = nodes->n, width = field->width;
    if (!moving_fill(change->tangent, change->bernstein, nodes, &filler->moving))
        return false;
    rule->x = calloc(n * (4 + 2 * width), sizeof *rule->x);
    if (!rule->x)
        return false;
    rule->n = n;
    rule->y = rule->x + n;
    rule->z = rule->x + 2 * n;
    rule->strength = rule->x + 3 * n;
    rule->change = rule->x + 4 * n;
    memcpy(rule->x, nodes->x, n * sizeof *rule->x);
    memcpy(rule->y, nodes->y, n * sizeof *rule->x);
    memcpy(rule->z, nodes->z, n * sizeof *rule->x);
    memcpy(rule->strength, filler->moving.strength, n * sizeof *rule->x);
    for (size_t b = 0; b < nodes->blocks; b++)
        for (size_t i = nodes->block[b].begin; i < nodes->block[b].end; i++) {
            double *to = rule->change + 2 * i * width;
            moving_changes(field, nodes, &filler->moving, nodes->block[b].element, i,
                           filler->change);
            memcpy(to, filler->change, field->n * sizeof *to);
            memcpy(to + width, filler->change + field->n, field->n * sizeof *to);
        }
    return true;
}

bool rules_fill(const struct change *change, struct rules *rules)
{
    const struct influence *influence = change->influence;
    bool failed = false;
#pragma omp parallel num_threads(influence->threads) reduction(| : failed)
    {
        struct filler filler = {.change = malloc(2 * change->tangent->field->n * sizeof(double))};
        nodes_init(&filler.nodes, influence->mesh);
        filler.nodes.with_jets = true;
        failed |= !filler.change;
#pragma omp for schedule(dynamic, 16)
        for (size_t k = 0; k < rules->n; k++)
            if (!failed && rules->rule[k].used && !rules->rule[k].x)
                failed |= !fill(change, k, &filler, &rules->rule[k]);
        nodes_free(&filler.nodes);
        moving_free(&filler.moving);
        free(filler.change);
    }
    return !failed;
}

bool kernels_clear(struct kernels *kernels, size_t n)
{
    if (n > kernels->capacity) {
        free(kernels->k);
        kernels->capacity = n + n / 2;
        kernels->k = malloc(9 * kernels->capacity * sizeof *kernels->k);
    }
    if (!kernels->k) {
        kernels->capacity = 0;
        return n == 0;
    }
    kernels->n = n;
    kernels->slope = kernels->k + 3 * n;
    kernels->turned = kernels->k + 6 * n;
    memset(kernels->k, 0, 9 * n * sizeof *kernels->k);
    return true;
}

void kernels_free(struct kernels *kernels)
{
    free(kernels->k);
}

static void add_turn(const struct kernels *kernels, const double *strength, double turn[3])
{
    size_t n = kernels->n;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < n; i++)
            turn[c] += kernels->turned[c * n + i] * strength[i];
}

void kernels_sum(const struct kernels *kernels, const struct field *field,
                 const struct nodes *nodes, const struct moving *moving, double *out,
                 double turn[3])
{
    moving_add(field, nodes, moving, kernels->k, kernels->slope, out);
    add_turn(kernels, moving->strength, turn);
}

/* Sums over the nodes of one block of fields. */
VECTOR_MULTIVERSION
static void sum_block(size_t n, size_t width, const double *k, const double *slope,
                      const double *change, double sum[3][FIELD_BLOCK])
{
    double x[FIELD_BLOCK] = {0}, y[FIELD_BLOCK] = {0}, z[FIELD_BLOCK] = {0};
    for (size_t i = 0; i < n; i++, change += 2 * width) {
        const double *moved = change + width;
        for (size_t l = 0; l < FIELD_BLOCK; l++) {
            x[l] += k[i] * change[l] - slope[i] * moved[l];
            y[l] += k[n + i] * change[l] - slope[n + i] * moved[l];
            z[l] += k[2 * n + i] * change[l] - slope[2 * n + i] * moved[l];
        }
    }
    memcpy(sum[0], x, sizeof x);
    memcpy(sum[1], y, sizeof y);
    memcpy(sum[2], z, sizeof z);
}

void kernels_sum_rule(const struct kernels *kernels, const struct field *field,
                      const struct rule *rule, double *out, double turn[3])
{
    for (size_t first = 0; first < field->n; first += FIELD_BLOCK) {
        double sum[3][FIELD_BLOCK];
        size_t fields = field->n - first < FIELD_BLOCK ? field->n - first : FIELD_BLOCK;
        sum_block(kernels->n, field->width, kernels->k, kernels->slope, rule->change + first, sum);
        for (size_t c = 0; c < 3; c++)
            for (size_t l = 0; l < fields; l++)
                out[c * field->n + first + l] += sum[c][l];
    }
    add_turn(kernels, rule->strength, turn);
}
