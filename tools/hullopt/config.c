#include "config.h"

#include "cli.h"
#include "config_schema.h"
#include "digest.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A number of the file and where it goes. */
struct number {
    const char *field;
    const char *text; /* NULL: not given, the default stays */
    double least, most;
    bool open; /* the ends themselves are not allowed */
    double *out;
};

static bool read_number(const char *path, const struct number *number)
{
    double value;
    if (!number->text)
        return true;
    bool ok = cli_parse_double(number->text, &value) &&
              (number->open ? value > number->least && value < number->most
                            : value >= number->least && value <= number->most);
    if (ok) {
        *number->out = value;
        return true;
    }
    if (isinf(number->most))
        cli_yaml_fail(path, number->field, "is '%s', expected a number %s %g", number->text,
                      number->open ? ">" : ">=", number->least);
    else
        cli_yaml_fail(path, number->field, "is '%s', expected a number %s %g and %g%s",
                      number->text, number->open ? "between" : "from", number->least, number->most,
                      number->open ? ", both excluded" : "");
    return false;
}

static bool read_numbers(const char *path, const struct number *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!read_number(path, &numbers[i]))
            return false;
    return true;
}

static bool read_count(const char *path, const char *field, const char *text, size_t least,
                       size_t most, size_t *out)
{
    size_t value;
    if (!text)
        return true;
    if (!cli_parse_size(text, &value) || value < least || value > most) {
        cli_yaml_fail(path, field, "is '%s', expected an integer from %zu to %zu", text, least,
                      most);
        return false;
    }
    *out = value;
    return true;
}

static bool read_switch(const char *path, const char *field, const char *text, int *out)
{
    static const char *const yes[] = {"true", "yes", "on"}, *const no[] = {"false", "no", "off"};
    if (!text)
        return true;
    for (size_t i = 0; i < 3; i++) {
        if (strcmp(text, yes[i]) == 0 || strcmp(text, no[i]) == 0) {
            *out = strcmp(text, yes[i]) == 0;
            return true;
        }
    }
    cli_yaml_fail(path, field, "is '%s', expected true or false", text);
    return false;
}

/* Paths of the file are relative to the folder of the file. */
static char *resolve(const char *config, const char *path)
{
    const char *slash = strrchr(config, '/');
    size_t folder = slash && *path != '/' ? (size_t)(slash - config) + 1 : 0;
    char *joined = malloc(folder + strlen(path) + 1);
    if (joined) {
        memcpy(joined, config, folder);
        strcpy(joined + folder, path);
    }
    return joined;
}

static bool read_file_name(const char *path, const char *field, const char *text, char **out)
{
    *out = resolve(path, text);
    if (*out && access(*out, R_OK) == 0)
        return true;
    cli_yaml_fail(path, field, "is '%s', and %s cannot be read: %s", text, *out ? *out : text,
                  strerror(errno));
    return false;
}

static bool read_latent(const char *path, const struct config_file *file, struct config *config)
{
    const struct number numbers[] = {
        {"latent.variance", file->latent.variance, 0, 1, true, &config->variance},
        {"reconstruction.tolerance", file->reconstruction.tolerance, 0, 0.1, true,
         &config->tolerance},
        {"constraints.displacement", file->constraints.displacement, 0, 1, true,
         &config->displacement},
        {"constraints.breadth", file->constraints.breadth, 0, 1, true, &config->breadth},
        {"constraints.entrance", file->constraints.entrance, 1, 10, true, &config->entrance},
        {"constraints.pressure", file->constraints.pressure, 0, 10, true, &config->pressure},
        {"constraints.speeds", file->constraints.speeds, 0, 10, true, &config->speeds},
    };
    size_t seed = 1;
    if (!read_count(path, "grid.sections", file->grid.sections, 4, 2000, &config->sections) ||
        !read_count(path, "grid.girth", file->grid.girth, 4, 2000, &config->girth) ||
        !read_count(path, "latent.samples", file->latent.samples, 2, 10000000, &config->samples) ||
        !read_count(path, "latent.seed", file->latent.seed, 0, SIZE_MAX, &seed))
        return false;
    config->latent_seed = seed;
    return read_numbers(path, numbers, sizeof numbers / sizeof *numbers);
}

/* Spans of the density's own knots; "auto" leaves the choice to the solver's rule. */
static bool read_elements(const char *path, const char *field, const char *text, int *out)
{
    size_t value;
    if (!text)
        return true;
    if (strcmp(text, "auto") == 0) {
        *out = -1;
        return true;
    }
    if (!read_count(path, field, text, 0, 1000, &value))
        return false;
    *out = (int)value;
    return true;
}

static bool read_flow(const char *path, const struct config_file *file, igabem_options *solver)
{
    const struct number numbers[] = {
        {"flow.froude", file->flow.froude, 0, 10, true, &solver->froude},
        {"flow.gravity", file->flow.gravity, 0, INFINITY, true, &solver->gravity},
        {"flow.density", file->flow.density, 0, INFINITY, true, &solver->density},
        {"solver.cutoff_angle", file->solver.cutoff_angle, 0, INFINITY, true,
         &solver->cutoff_angle},
        {"solver.cutoff_factor", file->solver.cutoff_factor, 0, INFINITY, true,
         &solver->cutoff_factor},
        {"solver.stem_limit", file->solver.stem_limit, 0, INFINITY, true, &solver->stem_limit},
        {"solver.stern_length", file->solver.stern_length, 0, 1, false, &solver->stern_length},
        {"solver.stern_blend", file->solver.stern_blend, 0, 1, true, &solver->stern_blend},
        {"solver.spectrum_limit", file->solver.spectrum_limit, 1, INFINITY, true,
         &solver->spectrum_limit},
        {"solver.tolerance", file->solver.tolerance, 0, 0.1, true, &solver->tolerance},
    };
    size_t refine = (size_t)solver->refine, degree = (size_t)solver->degree;
    if (!read_numbers(path, numbers, sizeof numbers / sizeof *numbers) ||
        !read_count(path, "solver.refine", file->solver.refine, 1, 16, &refine) ||
        !read_elements(path, "solver.elements_u", file->solver.elements_u, &solver->elements_u) ||
        !read_elements(path, "solver.elements_v", file->solver.elements_v, &solver->elements_v) ||
        !read_count(path, "solver.degree", file->solver.degree, 1, 9, &degree) ||
        !read_switch(path, "solver.line_term", file->solver.line_term, &solver->line_term))
        return false;
    solver->refine = (int)refine;
    solver->degree = (int)degree;
    const char *name = file->solver.formulation;
    if (name && !igabem_formulation_parse(name, &solver->formulation)) {
        char names[200] = "";
        for (igabem_formulation f = IGABEM_FORMULATION_AUTO; igabem_formulation_info(f); f++) {
            size_t at = strlen(names);
            snprintf(names + at, sizeof names - at, " %s", igabem_formulation_name(f));
        }
        cli_yaml_fail(path, "solver.formulation", "is '%s', expected one of%s", name, names);
        return false;
    }
    return true;
}

static bool read_design_kind(const char *path, const char *name, bayesopt_design_kind *kind)
{
    static const bayesopt_design_kind kinds[] = {BAYESOPT_DESIGN_STLBO,
                                                 BAYESOPT_DESIGN_ANNEALED_LHS, BAYESOPT_DESIGN_LHS,
                                                 BAYESOPT_DESIGN_SOBOL, BAYESOPT_DESIGN_UNIFORM};
    if (!name)
        return true;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcmp(name, bayesopt_design_name(kinds[i])) == 0) {
            *kind = kinds[i];
            return true;
        }
    }
    cli_yaml_fail(path, "search.design", "is '%s', expected one of %s %s %s %s %s", name,
                  bayesopt_design_name(kinds[0]), bayesopt_design_name(kinds[1]),
                  bayesopt_design_name(kinds[2]), bayesopt_design_name(kinds[3]),
                  bayesopt_design_name(kinds[4]));
    return false;
}

static bool read_strategy(const char *path, const char *name, bayesopt_strategy *strategy)
{
    static const bayesopt_strategy all[] = {BAYESOPT_STRATEGY_AUTO, BAYESOPT_STRATEGY_GLOBAL,
                                            BAYESOPT_STRATEGY_LOCAL};
    if (!name)
        return true;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (strcmp(name, bayesopt_strategy_name(all[i])) == 0) {
            *strategy = all[i];
            return true;
        }
    }
    cli_yaml_fail(path, "search.strategy", "is '%s', expected auto, global or local", name);
    return false;
}

static bool read_search(const char *path, const struct config_file *file, struct config *config)
{
    size_t seed = 1;
    if (!read_count(path, "search.initial", file->search.initial, 2, 100000, &config->initial) ||
        !read_count(path, "search.iterations", file->search.iterations, 0, 100000,
                    &config->iterations) ||
        !read_count(path, "search.seed", file->search.seed, 0, SIZE_MAX, &seed))
        return false;
    config->search_seed = seed;
    return read_design_kind(path, file->search.design, &config->design) &&
           read_strategy(path, file->search.strategy, &config->strategy);
}

static bool read_verification(const char *path, const struct config_file *file,
                              struct config *config)
{
    size_t refine = 2;
    if (!read_count(path, "verification.refine", file->verification.refine, 1, 16, &refine))
        return false;
    config->verify_refine = (int)refine;
    config->verify_froudes = file->verification.froude_count;
    for (size_t i = 0; i < config->verify_froudes; i++) {
        const struct number number = {
            "verification.froude",    file->verification.froude[i], 0, 10, true,
            &config->verify_froude[i]};
        if (!read_number(path, &number))
            return false;
    }
    if (isnan(config->speeds) || config->verify_froudes)
        return true;
    cli_yaml_fail(path, "constraints.speeds", "needs a list of speeds in verification.froude");
    return false;
}

static bool read_waves(const char *path, const struct config_file *file, struct config *config)
{
    return read_count(path, "waves.along", file->waves.along, 2, 5000, &config->waves_along) &&
           read_count(path, "waves.across", file->waves.across, 2, 5000, &config->waves_across);
}

static void set_defaults(struct config *config)
{
    config->waves_along = 221;
    config->waves_across = 66;
    config->samples = 9000;
    config->latent_seed = 1;
    config->variance = 0.95;
    config->tolerance = 1e-4;
    config->displacement = NAN;
    config->breadth = NAN;
    config->entrance = NAN;
    config->pressure = NAN;
    config->speeds = NAN;
    config->initial = 200;
    config->iterations = 100;
    config->design = BAYESOPT_DESIGN_STLBO;
    config->strategy = BAYESOPT_STRATEGY_AUTO;
    config->search_seed = 1;
    igabem_options_init(&config->solver);
}

static void write_line(FILE *out, const char *field, double value)
{
    if (isnan(value))
        fprintf(out, "%s = by rule\n", field);
    else
        fprintf(out, "%s = %.15g\n", field, value);
}

static void write_limit(FILE *out, const char *field, double value)
{
    if (isnan(value))
        fprintf(out, "%s = none\n", field);
    else
        fprintf(out, "%s = %.15g\n", field, value);
}

static void write_count(FILE *out, const char *field, size_t value)
{
    if (value)
        fprintf(out, "%s = %zu\n", field, value);
    else
        fprintf(out, "%s = as in the hull file\n", field);
}

static bool write_digest(FILE *out, const char *field, const char *path)
{
    char digest[DIGEST_SIZE];
    const char *slash = strrchr(path, '/');
    if (!digest_file(path, digest)) {
        cli_fail("%s: %s", path, strerror(errno));
        return false;
    }
    fprintf(out, "%s = %s (%s)\n", field, slash ? slash + 1 : path, digest);
    return true;
}

static void write_elements(FILE *out, const char *field, int value)
{
    if (value < 0)
        fprintf(out, "%s = auto\n", field);
    else
        fprintf(out, "%s = %d\n", field, value);
}

static void write_settings(FILE *out, const struct config *c)
{
    const igabem_options *s = &c->solver;
    write_count(out, "grid.sections", c->sections);
    write_count(out, "grid.girth", c->girth);
    fprintf(out, "latent.samples = %zu\nlatent.seed = %llu\n", c->samples,
            (unsigned long long)c->latent_seed);
    write_line(out, "latent.variance", c->variance);
    write_line(out, "reconstruction.tolerance", c->tolerance);
    write_limit(out, "constraints.displacement", c->displacement);
    write_limit(out, "constraints.breadth", c->breadth);
    write_limit(out, "constraints.entrance", c->entrance);
    write_limit(out, "constraints.pressure", c->pressure);
    write_limit(out, "constraints.speeds", c->speeds);
    write_line(out, "flow.froude", s->froude);
    write_line(out, "flow.gravity", s->gravity);
    write_line(out, "flow.density", s->density);
    fprintf(out, "solver.formulation = %s\n", igabem_formulation_name(s->formulation));
    fprintf(out, "solver.refine = %d\nsolver.degree = %d\nsolver.line_term = %s\n", s->refine,
            s->degree, s->line_term ? "true" : "false");
    write_elements(out, "solver.elements_u", s->elements_u);
    write_elements(out, "solver.elements_v", s->elements_v);
    write_line(out, "solver.cutoff_angle", s->cutoff_angle);
    write_line(out, "solver.cutoff_factor", s->cutoff_factor);
    write_line(out, "solver.stem_limit", s->stem_limit);
    write_line(out, "solver.stern_length", s->stern_length);
    write_line(out, "solver.stern_blend", s->stern_blend);
    write_line(out, "solver.spectrum_limit", s->spectrum_limit);
    write_line(out, "solver.tolerance", s->tolerance);
    fprintf(out, "search.initial = %zu\nsearch.iterations = %zu\n", c->initial, c->iterations);
    fprintf(out, "search.design = %s\nsearch.strategy = %s\nsearch.seed = %llu\n",
            bayesopt_design_name(c->design), bayesopt_strategy_name(c->strategy),
            (unsigned long long)c->search_seed);
    fprintf(out, "verification.refine = %d\nverification.froude =", c->verify_refine);
    for (size_t i = 0; i < c->verify_froudes; i++)
        fprintf(out, "%s %.15g", i ? "," : "", c->verify_froude[i]);
    fprintf(out, "\nwaves.along = %zu\nwaves.across = %zu\n", c->waves_along, c->waves_across);
}

static bool write_text(struct config *config)
{
    size_t length;
    FILE *out = open_memstream(&config->text, &length);
    if (!out)
        return false;
    fprintf(out, "name = %s\n", config->name);
    bool ok = write_digest(out, "hull", config->hull) && write_digest(out, "shape", config->shape);
    write_settings(out, config);
    return fclose(out) == 0 && ok;
}

static bool interpret(const char *path, const struct config_file *file,
                      const struct config_overrides *overrides, struct config *config)
{
    set_defaults(config);
    config->path = strdup(path);
    config->name = strdup(file->name ? file->name : "Hull form optimisation");
    if (!config->path || !config->name ||
        !read_file_name(path, "hull", file->hull, &config->hull) ||
        !read_file_name(path, "shape", file->shape, &config->shape))
        return false;
    if (!read_latent(path, file, config) || !read_flow(path, file, &config->solver) ||
        !read_search(path, file, config) || !read_verification(path, file, config) ||
        !read_waves(path, file, config))
        return false;
    if (overrides && overrides->initial != SIZE_MAX)
        config->initial = overrides->initial;
    if (overrides && overrides->iterations != SIZE_MAX)
        config->iterations = overrides->iterations;
    return write_text(config);
}

bool config_read(const char *path, const struct config_overrides *overrides, struct config *config)
{
    struct config_file *file;
    *config = (struct config){0};
    if (!config_file_load(path, &file))
        return false;
    bool ok = interpret(path, file, overrides, config);
    config_file_free(file);
    if (!ok)
        config_free(config);
    return ok;
}

void config_free(struct config *config)
{
    free(config->path);
    free(config->name);
    free(config->hull);
    free(config->shape);
    free(config->text);
    *config = (struct config){0};
}

bool config_difference(const char *now, const char *then, char *sentence, size_t size)
{
    while (*now || *then) {
        size_t a = strcspn(now, "\n"), b = strcspn(then, "\n");
        if (a != b || memcmp(now, then, a) != 0) {
            snprintf(sentence, size, "now '%.*s', then '%.*s'", (int)a, now, (int)b, then);
            return true;
        }
        now += a + (now[a] == '\n');
        then += b + (then[b] == '\n');
    }
    return false;
}
