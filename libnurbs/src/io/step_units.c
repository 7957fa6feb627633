/* Units of STEP files. */
#include "core/error.h"
#include "io/step_assembly.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_NESTED = 32 };

/* SI_UNIT(prefix, name), or CONVERSION_BASED_UNIT(name, measure with unit). */
static nurbs_status unit_factor(const step_file *file, size_t unit, int depth, double *factor)
{
    static const struct {
        const char *name;
        double factor;
    } prefixes[] = {{"EXA", 1e18},  {"PETA", 1e15},  {"TERA", 1e12},   {"GIGA", 1e9},
                    {"MEGA", 1e6},  {"KILO", 1e3},   {"HECTO", 1e2},   {"DECA", 1e1},
                    {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3},  {"MICRO", 1e-6},
                    {"NANO", 1e-9}, {"PICO", 1e-12}, {"FEMTO", 1e-15}, {"ATTO", 1e-18}};
    const step_record *si = step_record_of(file, unit, "SI_UNIT"),
                      *based = step_record_of(file, unit, "CONVERSION_BASED_UNIT");
    *factor = 1;
    if (si) {
        /* A derived first attribute (dimensions, *) stands before the prefix in a simple instance.
         */
        const step_node *prefix = step_parameter(file, si, file->instance[unit].count > 1 ? 0 : 1);
        if (!prefix || prefix->kind != STEP_ENUM)
            return NURBS_OK;
        for (size_t k = 0; k < sizeof prefixes / sizeof *prefixes; k++)
            if (strlen(prefixes[k].name) == prefix->length &&
                memcmp(prefixes[k].name, prefix->text, prefix->length) == 0) {
                *factor = prefixes[k].factor;
                return NURBS_OK;
            }
        return step_refuse(file, unit, "unknown prefix .%.*s.", (int)prefix->length, prefix->text);
    }
    if (!based || depth > MOST_NESTED)
        return step_refuse(file, unit, "is no unit that is known");
    size_t measure, base;
    double value, inner;
    nurbs_status status = step_reference(
        file, unit, step_parameter(file, based, file->instance[unit].count > 1 ? 1 : 2), &measure);
    if (status != NURBS_OK)
        return status;
    const step_record *m = step_record_of(file, measure, "MEASURE_WITH_UNIT");
    if (!m)
        m = &file->record[file->instance[measure].first];
    status = step_number(file, measure, step_parameter(file, m, 0), &value);
    if (status == NURBS_OK)
        status = step_reference(file, measure, step_parameter(file, m, 1), &base);
    if (status == NURBS_OK)
        status = unit_factor(file, base, depth + 1, &inner);
    if (status == NURBS_OK && !(value > 0))
        return step_refuse(file, measure, "%g of a unit, expected > 0", value);
    *factor = status == NURBS_OK ? value * inner : 1;
    return status;
}

/* The units of a representation's context; a context without units leaves those of before. */
nurbs_status step_set_units(step_file *file, size_t context)
{
    const step_record *record = step_record_of(file, context, "GLOBAL_UNIT_ASSIGNED_CONTEXT");
    if (!record)
        return NURBS_OK;
    /* In a simple instance the attributes of the context itself stand before. */
    const step_node *list = step_parameter(file, record, file->instance[context].count > 1 ? 0 : 2);
    nurbs_status status = step_list(file, context, list);
    for (const step_node *node = status == NURBS_OK ? step_child(file, list, 0) : NULL;
         node && status == NURBS_OK; node = step_next(file, node)) {
        size_t unit;
        status = step_reference(file, context, node, &unit);
        if (status == NURBS_OK && step_record_of(file, unit, "LENGTH_UNIT"))
            status = unit_factor(file, unit, 0, &file->metres);
        else if (status == NURBS_OK && step_record_of(file, unit, "PLANE_ANGLE_UNIT"))
            status = unit_factor(file, unit, 0, &file->radians);
    }
    return status;
}

/* A representation has a name, a list of items and a context. */
const step_record *step_representation(const step_file *file, size_t instance)
{
    const step_instance *i = &file->instance[instance];
    for (size_t k = 0; k < i->count; k++) {
        const step_record *record = &file->record[i->first + k];
        static const char end[] = "REPRESENTATION";
        size_t n = sizeof end - 1;
        if (record->length < n || memcmp(record->name + record->length - n, end, n) != 0)
            continue;
        const step_node *items = step_parameter(file, record, 1),
                        *context = step_parameter(file, record, 2);
        if (items && items->kind == STEP_LIST && context && context->kind == STEP_REFERENCE)
            return record;
    }
    return NULL;
}

nurbs_status step_use_units_of(step_file *file, size_t instance)
{
    const step_record *record = step_representation(file, instance);
    size_t context;
    if (!record)
        return NURBS_OK;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 2), &context);
    return status == NURBS_OK ? step_set_units(file, context) : status;
}
