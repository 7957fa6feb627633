#include "core/identity.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the size of a move: other machines and numbers of threads agree to rounding. */
static const double MOVE_TOLERANCE = 1e-6;

/* What decides how a search goes on, not what a design is. */
static const char *const ELSEWHERE[] = {
    "name ",
    "search.method ",
    "search.confirm ",
    "search.initial ",
    "search.seed ",
    "search.iterations ",
    "search.design ",
    "search.strategy ",
    "waves.",
    "verification.refine ",
    "objective.quantity ",
    "flow.viscosity ",
    "flow.form_factor ",
};

static bool is_elsewhere(const char *line)
{
    for (size_t i = 0; i < sizeof ELSEWHERE / sizeof *ELSEWHERE; i++)
        if (strncmp(line, ELSEWHERE[i], strlen(ELSEWHERE[i])) == 0)
            return true;
    return false;
}

/* The lines of the canonical text that count. */
static json_t *settings(const struct config *config)
{
    char *text = malloc(strlen(config->text) + 1);
    size_t length = 0;
    for (const char *line = config->text; text && *line;) {
        size_t n = strcspn(line, "\n");
        n += line[n] == '\n';
        if (!is_elsewhere(line)) {
            memcpy(text + length, line, n);
            length += n;
        }
        line += n;
    }
    json_t *value = text ? json_stringn(text, length) : NULL;
    free(text);
    return value;
}

/* Signs without a pattern, so that different moves have different sums (splitmix64, Steele, Lea and
 * Flood 2014). */
static double sign_of(uint64_t i)
{
    i = (i + 1) * 0x9e3779b97f4a7c15u;
    i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9u;
    i = (i ^ (i >> 27)) * 0x94d049bb133111ebu;
    return (i ^ (i >> 31)) & 1 ? 1 : -1;
}

/* Signed sum and size of the move of the grid to a point. */
static json_t *move_to(const galv_model *model, const double *u, double *points)
{
    const double *parent = galv_model_parent(model);
    double sum = 0, square = 0;
    if (galv_displace(model, u, points) != GALV_OK)
        return NULL;
    for (size_t i = 0; i < 3 * galv_model_points(model); i++) {
        double move = points[i] - parent[i];
        sum += sign_of(i) * move;
        square += move * move;
    }
    return json_pack("[f, f]", sum, sqrt(square));
}

/* To the lower and to the upper end of each variable. */
static json_t *moves(const galv_model *model)
{
    size_t modes = galv_model_modes(model);
    double *u = calloc(modes, sizeof *u);
    double *points = malloc(3 * galv_model_points(model) * sizeof *points);
    json_t *list = u && points ? json_array() : NULL;
    for (size_t k = 0; k < 2 * modes && list; k++) {
        u[k / 2] = (k % 2 ? galv_model_upper(model) : galv_model_lower(model))[k / 2];
        if (json_array_append_new(list, move_to(model, u, points)) != 0) {
            json_decref(list);
            list = NULL;
        }
        u[k / 2] = 0;
    }
    free(points);
    free(u);
    return list;
}

json_t *identity_of(const struct problem *problem)
{
    json_t *text = settings(problem->config), *ends = moves(problem->model);
    json_t *identity = json_pack("{s:o, s:o}", "settings", text, "moves", ends);
    if (!identity)
        core_no_memory();
    return identity;
}

bool identity_agrees(const json_t *mine, const json_t *theirs, char *sentence, size_t size)
{
    static const char *const sides[] = {"here", "there"};
    const char *text = json_string_value(json_object_get(theirs, "settings"));
    const json_t *own = json_object_get(mine, "moves"), *list = json_object_get(theirs, "moves");
    snprintf(sentence, size, "what the problem is cannot be read");
    if (!text || !json_is_array(list) ||
        config_difference(json_string_value(json_object_get(mine, "settings")), text, sides,
                          sentence, size))
        return false;
    snprintf(sentence, size, "%zu variables here, %zu there", json_array_size(own) / 2,
             json_array_size(list) / 2);
    if (json_array_size(list) != json_array_size(own))
        return false;
    for (size_t k = 0; k < json_array_size(own); k++) {
        double sum = json_number_value(json_array_get(json_array_get(own, k), 0));
        double extent = json_number_value(json_array_get(json_array_get(own, k), 1));
        const json_t *other = json_array_get(json_array_get(list, k), 0);
        snprintf(sentence, size, "variable %zu at its %s end moves the grid otherwise than there",
                 k / 2 + 1, k % 2 ? "upper" : "lower");
        if (!json_is_number(other) ||
            !(fabs(json_number_value(other) - sum) <= MOVE_TOLERANCE * extent))
            return false;
    }
    return true;
}
