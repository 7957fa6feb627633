#include "output.h"

#include "cli.h"
#include "json_result.h"
#include "model_file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void warn(struct warnings *warnings, const char *format, ...)
{
    char text[640];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fprintf(stderr, "%s: warning: %s\n", cli_name(), text);
    if (warnings->n < sizeof warnings->text / sizeof *warnings->text)
        warnings->text[warnings->n++] = strdup(text);
}

void warnings_free(struct warnings *warnings)
{
    for (size_t i = 0; i < warnings->n; i++)
        free(warnings->text[i]);
    warnings->n = 0;
}

json_t *json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *json_whole(size_t value)
{
    return json_integer((json_int_t)value);
}

json_t *json_numbers(size_t n, const double *values)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_result_append(list, json_number(values[i]));
    return list;
}

json_t *json_model(const galv_model *m)
{
    size_t spectrum = galv_model_spectrum(m), modes = galv_model_modes(m);
    const galv_confidence confidence = galv_model_confidence(m);
    const struct {
        const char *name;
        json_t *value;
    } figures[] = {
        {"samples", json_whole(galv_model_samples(m))},
        {"elements", json_whole(galv_model_points(m))},
        {"coordinates", json_whole(galv_model_coordinates(m))},
        {"active", json_whole(galv_model_active(m))},
        {"parameters", json_whole(galv_model_parameters(m))},
        {"modes", json_whole(modes)},
        {"retained", json_number(galv_model_retained(m))},
        {"retained_geometry", json_number(galv_model_retained_geometry(m))},
        {"retained_fresh", json_number(confidence.retained_fresh)},
        {"retained_error", json_number(confidence.retained_error)},
        {"subspace_angle", json_number(confidence.angle)},
        {"trace", json_number(galv_model_trace(m))},
        {"truncation", json_number(galv_model_truncation(m))},
        {"eigenvalues", json_numbers(spectrum, galv_model_eigenvalues(m))},
        {"residuals", json_numbers(spectrum, galv_model_residuals(m))},
        {"mse", json_numbers(spectrum, galv_model_mse(m))},
        {"latent_lower", json_numbers(modes, galv_model_lower(m))},
        {"latent_upper", json_numbers(modes, galv_model_upper(m))},
        {"centred", json_boolean(galv_model_centred(m))},
        {"method", json_string(method_name(galv_model_method(m)))},
    };
    json_t *root = json_object();
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        json_result_set(root, figures[i].name, figures[i].value);
    return root;
}

int output_end(void)
{
    return cli_printed();
}

int json_print(json_t *root, const struct warnings *warnings)
{
    json_t *list = json_array();
    for (size_t i = 0; i < warnings->n; i++)
        json_result_append(list, json_string(warnings->text[i]));
    json_result_set(root, "warnings", list);
    return json_result_print(root, JSON_REAL_PRECISION(17) | JSON_INDENT(1));
}

static int print_csv(const struct table *t)
{
    for (size_t k = 0; k < t->width; k++)
        printf("%s%s%zu", k ? "," : "", t->prefix, k + 1);
    for (size_t k = 0; k < t->extras; k++)
        printf(",%s", t->names[k]);
    for (size_t r = 0; r < t->rows; r++) {
        for (size_t k = 0; k < t->width; k++)
            printf("%c%.17g", k ? ',' : '\n', t->values[r * t->width + k]);
        for (size_t k = 0; k < t->extras; k++)
            printf(",%.17g", t->more[r * t->extras + k]);
    }
    putchar('\n');
    return output_end();
}

int table_print(const struct table *t, bool json, const struct warnings *warnings)
{
    if (!json)
        return print_csv(t);
    json_t *list = json_array();
    char name[32];
    for (size_t r = 0; r < t->rows; r++) {
        json_t *row = json_object();
        for (size_t k = 0; k < t->width; k++) {
            snprintf(name, sizeof name, "%s%zu", t->prefix, k + 1);
            json_result_set(row, name, json_number(t->values[r * t->width + k]));
        }
        for (size_t k = 0; k < t->extras; k++)
            json_result_set(row, t->names[k], json_number(t->more[r * t->extras + k]));
        json_result_append(list, row);
    }
    return json_print(json_pack("{s:o}", "rows", list), warnings);
}
