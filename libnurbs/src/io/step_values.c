/* What instances of a STEP file hold. */
#include "core/error.h"
#include "core/vector.h"
#include "io/step.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t step_find(const step_file *file, size_t id)
{
    size_t low = 0, high = file->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (file->instance[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < file->count && file->instance[low].id == id ? low : file->count;
}

static bool named(const step_record *record, const char *name)
{
    return strlen(name) == record->length && memcmp(record->name, name, record->length) == 0;
}

const step_record *step_record_of(const step_file *file, size_t instance, const char *name)
{
    const step_instance *i = &file->instance[instance];
    for (size_t k = 0; k < i->count; k++)
        if (named(&file->record[i->first + k], name))
            return &file->record[i->first + k];
    return NULL;
}

const char *step_name(const step_file *file, size_t instance, char text[64])
{
    const step_record *record = &file->record[file->instance[instance].first];
    size_t n = record->length < 63 ? record->length : 63;
    memcpy(text, record->name, n);
    text[n] = '\0';
    return text;
}

nurbs_status step_refuse(const step_file *file, size_t instance, const char *format, ...)
{
    char what[400], name[64];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s:%zu: #%zu %s: %s", file->path,
                      file->instance[instance].line, file->instance[instance].id,
                      step_name(file, instance, name), what);
}

const step_node *step_child(const step_file *file, const step_node *list, size_t k)
{
    const step_node *node = list->first ? &file->node[list->first] : NULL;
    while (node && k-- > 0)
        node = step_next(file, node);
    return node;
}

const step_node *step_next(const step_file *file, const step_node *node)
{
    return node->next ? &file->node[node->next] : NULL;
}

const step_node *step_parameter(const step_file *file, const step_record *record, size_t k)
{
    return step_child(file, &file->node[record->list], k);
}

nurbs_status step_number(const step_file *file, size_t instance, const step_node *node,
                         double *value)
{
    if (node && node->kind == STEP_TYPED)
        node = step_child(file, node, 0);
    if (!node || node->kind != STEP_NUMBER)
        return step_refuse(file, instance, "a value is missing or no number");
    *value = node->number;
    return NURBS_OK;
}

nurbs_status step_size(const step_file *file, size_t instance, const step_node *node, size_t most,
                       size_t *value)
{
    double number = 0;
    nurbs_status status = step_number(file, instance, node, &number);
    if (status == NURBS_OK && !(number >= 0 && number <= (double)most && number == floor(number)))
        return step_refuse(file, instance, "%g, expected an integer from 0 to %zu", number, most);
    *value = status == NURBS_OK ? (size_t)number : 0;
    return status;
}

nurbs_status step_reference(const step_file *file, size_t instance, const step_node *node,
                            size_t *index)
{
    if (!node || node->kind != STEP_REFERENCE)
        return step_refuse(file, instance, "a reference #number is missing");
    *index = step_find(file, node->id);
    if (*index == file->count)
        return step_refuse(file, instance, "it refers to #%zu, which is not there", node->id);
    return NURBS_OK;
}

nurbs_status step_list(const step_file *file, size_t instance, const step_node *node)
{
    return node && node->kind == STEP_LIST ? NURBS_OK
                                           : step_refuse(file, instance, "a list is missing");
}

bool step_flag(const step_node *node, bool missing)
{
    if (!node || node->kind != STEP_ENUM || node->length != 1)
        return missing;
    return node->text[0] == 'T' || (node->text[0] != 'F' && missing);
}

static size_t put_utf8(unsigned long code, char out[4])
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t n = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t k = n; k-- > 1; code >>= 6)
        out[k] = (char)(0x80 | (code & 0x3f));
    out[0] = (char)((0xf00u >> n & 0xf0u) | code);
    return n;
}

static unsigned long hex(const char *at, size_t n)
{
    char digits[9] = "";
    memcpy(digits, at, n);
    return strtoul(digits, NULL, 16);
}

/* A directive at `at`: its code, and how many characters it takes; 0: none. Inside \X2\ ...
 * \X0\ and \X4\ ... every `width` digits are a code. */
static size_t directive(const char *at, size_t left, size_t *width, unsigned long *code)
{
    *code = 0;
    if (*width && left >= 4 && strncmp(at, "\\X0\\", 4) == 0) {
        *width = 0;
        return 4;
    }
    if (*width && left >= *width) {
        *code = hex(at, *width);
        return *width;
    }
    if (left >= 4 && (strncmp(at, "\\X2\\", 4) == 0 || strncmp(at, "\\X4\\", 4) == 0)) {
        *width = at[2] == '2' ? 4 : 8;
        return 4;
    }
    if (left >= 5 && strncmp(at, "\\X\\", 3) == 0) {
        *code = hex(at + 3, 2);
        return 5;
    }
    if (left >= 4 && strncmp(at, "\\S\\", 3) == 0) {
        *code = 0x80 + (unsigned char)at[3];
        return 4;
    }
    return 0;
}

void step_string(const step_node *node, size_t size, char *text)
{
    size_t used = 0, width = 0;
    text[0] = '\0';
    if (!node || node->kind != STEP_STRING)
        return;
    for (size_t k = 0; k < node->length;) {
        unsigned long code;
        size_t taken = directive(node->text + k, node->length - k, &width, &code);
        if (taken == 0) {
            char c = node->text[k];
            code = (unsigned char)c;
            taken =
                (c == '\'' || c == '\\') && k + 1 < node->length && node->text[k + 1] == c ? 2 : 1;
            if (used + 2 > size)
                break;
            text[used++] = c;
        } else if (code >= 0x20 && code < 0x110000) {
            char bytes[4];
            size_t n = put_utf8(code, bytes);
            if (used + n + 1 > size)
                break;
            memcpy(text + used, bytes, n);
            used += n;
        }
        k += taken;
    }
    text[used] = '\0';
}

/* Up to three numbers of a list; absent ones are zero. */
static nurbs_status triple(const step_file *file, size_t instance, const char *name, double scale,
                           double out[3])
{
    const step_record *record = step_record_of(file, instance, name);
    const step_node *list = record ? step_parameter(file, record, 1) : NULL;
    if (!record)
        return step_refuse(file, instance, "expected a %s", name);
    nurbs_status status = step_list(file, instance, list);
    const step_node *node = status == NURBS_OK ? step_child(file, list, 0) : NULL;
    for (size_t k = 0; k < 3; k++) {
        out[k] = 0;
        if (node && status == NURBS_OK) {
            status = step_number(file, instance, node, &out[k]);
            node = step_next(file, node);
        }
        out[k] *= scale;
    }
    return status;
}

nurbs_status step_point(const step_file *file, size_t instance, double p[3])
{
    return triple(file, instance, "CARTESIAN_POINT", file->metres, p);
}

nurbs_status step_direction(const step_file *file, size_t instance, double d[3])
{
    nurbs_status status = triple(file, instance, "DIRECTION", 1, d);
    if (status == NURBS_OK && !(unit3(d) > 0))
        return step_refuse(file, instance, "has no length");
    return status;
}

/* Direction of an optional parameter. */
static nurbs_status optional_direction(const step_file *file, size_t instance,
                                       const step_node *node, const double missing[3], double d[3])
{
    size_t index;
    memcpy(d, missing, 3 * sizeof *d);
    if (!node || node->kind != STEP_REFERENCE)
        return NURBS_OK;
    nurbs_status status = step_reference(file, instance, node, &index);
    return status == NURBS_OK ? step_direction(file, index, d) : status;
}

nurbs_status step_placement(const step_file *file, size_t instance, double origin[3],
                            double frame[3][3])
{
    static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
    size_t point;
    const step_record *record = step_record_of(file, instance, "AXIS2_PLACEMENT_3D");
    if (!record)
        record = step_record_of(file, instance, "AXIS1_PLACEMENT");
    if (!record)
        return step_refuse(file, instance, "expected an AXIS2_PLACEMENT_3D");
    double reference[3];
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &point);
    if (status == NURBS_OK)
        status = step_point(file, point, origin);
    if (status == NURBS_OK)
        status = optional_direction(file, instance, step_parameter(file, record, 2), z, frame[2]);
    if (status == NURBS_OK)
        status = optional_direction(file, instance, step_parameter(file, record, 3), x, reference);
    if (status == NURBS_OK) {
        perpendicular3(frame[2], reference, frame[0]);
        cross3(frame[2], frame[0], frame[1]);
    }
    return status;
}
