#include "config_schema.h"

#include "config.h"

#define REQUIRED(name, part)                                                                       \
    CYAML_FIELD_STRING_PTR(#name, CYAML_FLAG_POINTER, struct part, name, 1, CYAML_UNLIMITED)
#define OPTIONAL(name, part)                                                                       \
    CYAML_FIELD_STRING_PTR(#name, CYAML_FLAG_POINTER_NULL_STR | CYAML_FLAG_OPTIONAL, struct part,  \
                           name, 1, CYAML_UNLIMITED)
#define SECTION(name, fields)                                                                      \
    CYAML_FIELD_MAPPING(#name, CYAML_FLAG_OPTIONAL, struct config_file, name, fields)

static const cyaml_schema_field_t grid[] = {
    OPTIONAL(sections, config_grid),
    OPTIONAL(girth, config_grid),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t latent[] = {
    OPTIONAL(samples, config_latent),
    OPTIONAL(seed, config_latent),
    OPTIONAL(variance, config_latent),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t reconstruction[] = {
    OPTIONAL(tolerance, config_reconstruction),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t flow[] = {
    REQUIRED(froude, config_flow),
    OPTIONAL(gravity, config_flow),
    OPTIONAL(density, config_flow),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t solver[] = {
    OPTIONAL(formulation, config_solver),  OPTIONAL(refine, config_solver),
    OPTIONAL(elements_u, config_solver),   OPTIONAL(elements_v, config_solver),
    OPTIONAL(degree, config_solver),       OPTIONAL(line_term, config_solver),
    OPTIONAL(cutoff_angle, config_solver), OPTIONAL(cutoff_factor, config_solver),
    OPTIONAL(stem_limit, config_solver),   OPTIONAL(stern_length, config_solver),
    OPTIONAL(stern_blend, config_solver),  OPTIONAL(spectrum_limit, config_solver),
    OPTIONAL(tolerance, config_solver),    CYAML_FIELD_END,
};

static const cyaml_schema_field_t constraints[] = {
    OPTIONAL(displacement, config_constraints), OPTIONAL(breadth, config_constraints),
    OPTIONAL(entrance, config_constraints),     OPTIONAL(pressure, config_constraints),
    OPTIONAL(speeds, config_constraints),       CYAML_FIELD_END,
};

static const cyaml_schema_field_t search[] = {
    OPTIONAL(initial, config_search), OPTIONAL(iterations, config_search),
    OPTIONAL(design, config_search),  OPTIONAL(strategy, config_search),
    OPTIONAL(seed, config_search),    CYAML_FIELD_END,
};

static const cyaml_schema_value_t froude_entry = {
    CYAML_VALUE_STRING(CYAML_FLAG_POINTER, char *, 1, CYAML_UNLIMITED),
};

static const cyaml_schema_field_t verification[] = {
    OPTIONAL(refine, config_verification),
    CYAML_FIELD_SEQUENCE("froude", CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL,
                         struct config_verification, froude, &froude_entry, 0, CONFIG_FROUDE_MOST),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t waves[] = {
    OPTIONAL(along, config_waves),
    OPTIONAL(across, config_waves),
    CYAML_FIELD_END,
};

static const cyaml_schema_field_t fields[] = {
    OPTIONAL(name, config_file),
    REQUIRED(hull, config_file),
    REQUIRED(shape, config_file),
    SECTION(grid, grid),
    SECTION(latent, latent),
    SECTION(reconstruction, reconstruction),
    CYAML_FIELD_MAPPING("flow", CYAML_FLAG_DEFAULT, struct config_file, flow, flow),
    SECTION(solver, solver),
    SECTION(constraints, constraints),
    SECTION(search, search),
    SECTION(verification, verification),
    SECTION(waves, waves),
    CYAML_FIELD_END,
};

static const cyaml_schema_value_t schema = {
    CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct config_file, fields),
};

bool config_file_load(const char *path, struct config_file **file)
{
    void *data;
    bool ok = cli_yaml_load(path, &schema, &data);
    *file = data;
    return ok;
}

void config_file_free(struct config_file *file)
{
    cli_yaml_free(&schema, file);
}
