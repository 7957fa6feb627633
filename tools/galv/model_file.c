#include "model_file.h"

#include "cli.h"
#include "h5.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 1 };

/* No array of a model file is longer. */
#define MOST_NUMBERS ((size_t)1 << 40)

static const char *const methods[] = {"auto",       "covariance", "gram",
                                      "randomised", "factored",   "parameters"};

const char *method_name(galv_method method)
{
    return methods[method];
}

/* The field that a file spells out. */
static bool is_method(const galv_field *field)
{
    return strcmp(field->name, "method") == 0;
}

static bool write_field(hid_t h5, const galv_field *field)
{
    double number = galv_field_number(field);
    if (!field->values)
        return true;
    if (is_method(field))
        return h5_write_text(h5, field->name, method_name((galv_method)number));
    if (field->dimensions)
        return h5_write_array(h5, field->name, field->rows,
                              field->dimensions == 2 ? field->columns : 0, field->values);
    return field->type == GALV_TYPE_DOUBLE ? h5_write_number(h5, field->name, number)
                                           : h5_write_count(h5, field->name, (size_t)number);
}

static bool write_model(hid_t h5, const galv_model *model)
{
    bool ok = true;
    for (size_t i = 0; i < galv_model_field_count() && ok; i++) {
        galv_field field = galv_model_field(model, i);
        ok = write_field(h5, &field);
    }
    return ok;
}

/* The table of what each parameter does: for sines n rows of order (3), phase (3), direction; for a
 * lattice n rows of control point (3), direction; for control points n rows of how far each point
 * of the grid goes with them, direction. */
static size_t table_columns(const struct shape_definition *shape)
{
    return 1 + (shape->kind == SHAPE_SINES ? 6 : shape->kind == SHAPE_LATTICE ? 3 : shape->npoints);
}

static void put_row(const struct shape_definition *shape, size_t i, double *row)
{
    for (size_t j = 0; j < 3 && shape->kind != SHAPE_CONTROL_POINTS; j++) {
        if (shape->kind == SHAPE_SINES) {
            row[j] = shape->functions[i].order[j];
            row[3 + j] = shape->functions[i].phase[j];
        } else {
            row[j] = (double)shape->moves[i].index[j];
        }
    }
    int direction =
        shape->kind == SHAPE_SINES ? shape->functions[i].direction : shape->moves[i].direction;
    for (size_t p = 0; p < shape->npoints; p++)
        row[p] = shape->fields[3 * (i * shape->npoints + p) + (size_t)direction];
    row[table_columns(shape) - 1] = direction;
}

static bool write_table(hid_t h5, const struct shape_definition *shape)
{
    size_t columns = table_columns(shape);
    double *table = malloc(shape->n * columns * sizeof *table);
    for (size_t i = 0; table && i < shape->n; i++)
        put_row(shape, i, table + i * columns);
    bool ok = table && h5_write_array(h5, "table", shape->n, columns, table);
    free(table);
    return ok;
}

static bool write_shape(hid_t h5, const struct shape_definition *shape)
{
    if (!shape->n)
        return h5_write_text(h5, "kind", "snapshots") && h5_write_count(h5, "parameters", 0);
    double lattice[6] = {0};
    for (int j = 0; j < 3; j++) {
        lattice[j] = (double)shape->count[j];
        lattice[3 + j] = shape->degree[j];
    }
    return h5_write_text(h5, "kind", shape_kind_name(shape->kind)) &&
           h5_write_text(h5, "combination", shape_combination_name(shape->combination)) &&
           h5_write_count(h5, "parameters", shape->n) &&
           h5_write_array(h5, "box_origin", 3, 0, shape->box.origin) &&
           h5_write_array(h5, "box_length", 3, 0, shape->box.length) &&
           h5_write_array(h5, "lower", shape->n, 0, shape->lower) &&
           h5_write_array(h5, "upper", shape->n, 0, shape->upper) &&
           h5_write_array(h5, "lattice", 6, 0, lattice) && write_table(h5, shape);
}

static bool write_all(hid_t h5, const struct model_file *file)
{
    hid_t untimed = H5Pcreate(H5P_GROUP_CREATE), shape = -1;
    if (untimed >= 0 && H5Pset_obj_track_times(untimed, false) >= 0)
        shape = H5Gcreate2(h5, "shape", H5P_DEFAULT, untimed, H5P_DEFAULT);
    bool ok = shape >= 0 && h5_write_text(h5, "format", "galv-model") &&
              h5_write_count(h5, "version", VERSION) && write_model(h5, file->model) &&
              write_shape(shape, &file->shape) && h5_write_count(h5, "sections", file->sections) &&
              h5_write_count(h5, "girth", file->girth) && h5_write_text(h5, "hull", file->hull) &&
              h5_write_count(h5, "uniform", file->uniform) &&
              h5_write_count(h5, "seed", file->seed) && h5_write_count(h5, "drawn", file->drawn) &&
              h5_write_count(h5, "moments", file->moments) &&
              h5_write_count(h5, "moment_order", file->set.order) &&
              h5_write_count(h5, "section_order", file->set.section_order) &&
              h5_write_count(h5, "section_first", file->set.section_first) &&
              h5_write_count(h5, "section_stride", file->set.section_stride) &&
              h5_write_count(h5, "rows", file->rows);
    if (shape >= 0)
        H5Gclose(shape);
    if (untimed >= 0)
        H5Pclose(untimed);
    return ok;
}

static uint32_t turn(uint32_t x, int bits)
{
    return x << bits | x >> (32 - bits);
}

/* Checksum of the first 44 bytes of a file of superblock 2 (HDF5 File Format Specification 3.0,
 * II.A): Jenkins, lookup3, hashlittle(). */
static uint32_t superblock_checksum(const unsigned char *bytes)
{
    enum { WORDS = 11 };
    static const int mixing[6] = {4, 6, 8, 16, 19, 4}, last[7] = {14, 11, 25, 16, 4, 14, 24};
    uint32_t word[WORDS + 1] = {0}, s[3];
    for (int i = 0; i < 4 * WORDS; i++)
        word[i / 4] |= (uint32_t)bytes[i] << 8 * (i % 4);
    for (int k = 0; k < 3; k++)
        s[k] = 0xdeadbeef + 4 * WORDS;
    for (int i = 0; i < 12; i += 3) {
        for (int k = 0; k < 3; k++)
            s[k] += word[i + k];
        for (int k = 0; k < 6 && i < 9; k++) { /* a -= c; a ^= c turned; c += b, and round */
            uint32_t *a = &s[k % 3], *b = &s[(k + 1) % 3], *c = &s[(k + 2) % 3];
            *a = (*a - *c) ^ turn(*c, mixing[k]);
            *c += *b;
        }
    }
    for (int k = 0; k < 7; k++) { /* c ^= b; c -= b turned; a, b, c in turn */
        uint32_t *c = &s[(k + 2) % 3], *b = &s[(k + 1) % 3];
        *c = (*c ^ *b) - turn(*b, last[k]);
    }
    return s[2];
}

/* The image tells that it is open no more; HDF5 clears that flag, and leaves the checksum of the
 * open file. */
static bool seal(unsigned char *image, size_t size)
{
    enum { VERSION_AT = 8, FLAGS_AT = 11, CHECKSUM_AT = 44, LENGTH = 48 };
    if (size < LENGTH || image[VERSION_AT] != 2)
        return false;
    uint32_t sum = superblock_checksum(image);
    for (int k = 0; k < 4; k++)
        image[CHECKSUM_AT + k] = (unsigned char)(sum >> 8 * k);
    return image[FLAGS_AT] == 0;
}

/* The file as bytes, made in memory: HDF5 has no way back from a disk that is full. NULL: not made.
 */
static void *file_image(const struct model_file *file, size_t *size)
{
    enum { STEP = 1 << 20 };
    void *image = NULL;
    hid_t how = H5Pcreate(H5P_FILE_ACCESS), untimed = H5Pcreate(H5P_FILE_CREATE), h5 = -1;
    /* From 1.8 on the format has checksums of all but the numbers: a damaged file of an older one
     * makes HDF5 1.10 read beyond its memory. */
    if (how >= 0 && untimed >= 0 && H5Pset_fapl_core(how, STEP, false) >= 0 &&
        H5Pset_libver_bounds(how, H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0 &&
        H5Pset_obj_track_times(untimed, false) >= 0)
        h5 = H5Fcreate("model", H5F_ACC_TRUNC, untimed, how);
    ssize_t n = -1;
    if (h5 >= 0 && write_all(h5, file) && H5Fflush(h5, H5F_SCOPE_LOCAL) >= 0)
        n = H5Fget_file_image(h5, NULL, 0);
    if (n > 0) {
        *size = (size_t)n;
        image = cli_needed(malloc(*size));
        if (H5Fget_file_image(h5, image, *size) != n || !seal(image, *size)) {
            free(image);
            image = NULL;
        }
    }
    if (h5 >= 0)
        H5Fclose(h5);
    if (how >= 0)
        H5Pclose(how);
    if (untimed >= 0)
        H5Pclose(untimed);
    return image;
}

bool model_file_write(const char *path, const struct model_file *file)
{
    struct cli_file out;
    size_t size = 0;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    void *image = file_image(file, &size);
    if (!image)
        return cli_refuse("%s: HDF5 cannot make the file: is memory short?", path);
    if (!cli_file_open(&out, path)) {
        free(image);
        return cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    }
    bool written = fwrite(image, 1, size, out.stream) == size;
    int reason = errno;
    free(image);
    if (!written) {
        cli_file_abandon(&out);
        return cli_refuse("%s: cannot be written: %s", path, strerror(reason));
    }
    return cli_file_commit(&out) || cli_refuse("%s: cannot be written: %s", path, strerror(errno));
}

/* Where reading stopped, for the message. */
struct reader {
    hid_t h5;
    const char *wrong;
};

static bool count(struct reader *r, const char *name, size_t *value)
{
    if (!r->wrong && !h5_read_count(r->h5, name, value))
        r->wrong = name;
    return !r->wrong;
}

/* A new array, registered in *slot. */
static const double *array(struct reader *r, const char *name, size_t rows, size_t columns,
                           double **slot)
{
    size_t found_rows, found_columns;
    *slot = NULL;
    if (r->wrong)
        return NULL;
    *slot = h5_load_array(r->h5, name, columns ? 2 : 1, &found_rows, &found_columns);
    if (!*slot || found_rows != rows || found_columns != (columns ? columns : 1))
        r->wrong = name;
    return *slot;
}

/* The method by its name, as a number of the model. */
static bool read_method(hid_t h5, const char *name, double *number)
{
    char text[32];
    if (!h5_read_text(h5, name, text, sizeof text))
        return false;
    for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++)
        if (strcmp(text, methods[i]) == 0) {
            *number = (double)i;
            return true;
        }
    return false;
}

/* Numbers go to *number, arrays are new: *slot. What the file does not have stays absent. */
static void read_field(hid_t h5, galv_field *field, double *number, double **slot)
{
    if (field->dimensions) {
        field->values = *slot =
            h5_load_array(h5, field->name, field->dimensions, &field->rows, &field->columns);
    } else if (is_method(field) ? read_method(h5, field->name, number)
                                : h5_read_number(h5, field->name, number)) {
        field->type = GALV_TYPE_DOUBLE;
        field->values = number;
    }
}

static bool read_model(hid_t h5, galv_model **model)
{
    size_t n = galv_model_field_count();
    galv_field *fields = cli_needed(calloc(n, sizeof *fields));
    double *numbers = cli_needed(calloc(n, sizeof *numbers));
    double **slots = cli_needed(calloc(n, sizeof *slots));
    bool ok = fields && numbers && slots;
    for (size_t i = 0; i < n && ok; i++) {
        fields[i] = galv_model_field(NULL, i);
        read_field(h5, &fields[i], &numbers[i], &slots[i]);
    }
    ok = ok && galv_model_restore(n, fields, model) == GALV_OK;
    for (size_t i = 0; i < n && slots; i++)
        free(slots[i]);
    free(slots);
    free(numbers);
    free(fields);
    return ok;
}

/* A whole number in 0..most. */
static bool index_from(double value, double most, size_t *out)
{
    if (!(value >= 0 && value <= most) || value != floor(value))
        return false;
    *out = (size_t)value;
    return true;
}

/* False: a row that no parameter has. */
static bool take_row(const double *row, size_t i, struct shape_definition *shape)
{
    size_t axis = 0;
    bool ok = index_from(row[table_columns(shape) - 1], 2, &axis);
    for (int j = 0; j < 3 && ok && shape->kind != SHAPE_CONTROL_POINTS; j++) {
        if (shape->kind == SHAPE_SINES) {
            shape->functions[i].order[j] = row[j];
            shape->functions[i].phase[j] = row[3 + j];
        } else {
            ok = index_from(row[j], 1000, &shape->moves[i].index[j]);
        }
    }
    for (size_t p = 0; p < shape->npoints && ok; p++)
        shape->fields[3 * (i * shape->npoints + p) + axis] = row[p];
    if (shape->kind == SHAPE_SINES)
        shape->functions[i].direction = (int)axis;
    else
        shape->moves[i].direction = (int)axis;
    return ok;
}

static bool read_table(struct reader *r, struct shape_definition *shape)
{
    size_t columns = table_columns(shape);
    double *table;
    if (!array(r, "table", shape->n, columns, &table))
        return false;
    for (size_t i = 0; i < shape->n && !r->wrong; i++)
        if (!take_row(table + i * columns, i, shape))
            r->wrong = "table";
    free(table);
    return !r->wrong;
}

static bool read_shape(struct reader *r, const galv_model *model, struct shape_definition *shape)
{
    char kind[16] = "", combination[16] = "";
    size_t n = 0, index;
    double lattice[6];
    if (!h5_read_text(r->h5, "kind", kind, sizeof kind) || !count(r, "parameters", &n) ||
        n != galv_model_parameters(model)) {
        r->wrong = "shape";
        return false;
    }
    if (!n && strcmp(kind, "snapshots") == 0)
        return true;
    enum shape_kind which = SHAPE_SINES;
    while (which < SHAPE_KINDS && strcmp(kind, shape_kind_name(which)) != 0)
        which++;
    if (which == SHAPE_KINDS) {
        r->wrong = "shape (kind)";
        return false;
    }
    if (!shape_definition_allocate(which, n, galv_model_points(model), shape)) {
        r->wrong = "shape (out of memory)";
        return false;
    }
    if (!h5_read_text(r->h5, "combination", combination, sizeof combination) ||
        !shape_combination_find(combination, &shape->combination)) {
        r->wrong = "shape (combination)";
        return false;
    }
    if (!h5_read_array(r->h5, "box_origin", 3, 0, shape->box.origin) ||
        !h5_read_array(r->h5, "box_length", 3, 0, shape->box.length) ||
        !h5_read_array(r->h5, "lower", n, 0, shape->lower) ||
        !h5_read_array(r->h5, "upper", n, 0, shape->upper) ||
        !h5_read_array(r->h5, "lattice", 6, 0, lattice))
        r->wrong = "shape";
    for (int j = 0; j < 3 && !r->wrong; j++)
        if (!index_from(lattice[j], 1000, &shape->count[j]) ||
            !index_from(lattice[3 + j], 1000, &index))
            r->wrong = "lattice";
        else
            shape->degree[j] = (int)index;
    return !r->wrong && read_table(r, shape);
}

/* A number that files written before there was such a thing do not have. */
static size_t newer_count(struct reader *r, const char *name, size_t otherwise)
{
    size_t value;
    return h5_read_count(r->h5, name, &value) ? value : otherwise;
}

static bool read_appended(struct reader *r, struct model_file *file)
{
    size_t moments = 0, order = 0, section_order = newer_count(r, "section_order", 0);
    count(r, "moments", &moments);
    count(r, "moment_order", &order);
    file->moments = moments != 0;
    file->rows = newer_count(r, "rows", 0);
    file->set = (galv_moment_set){.sections = file->sections,
                                  .girth = file->girth,
                                  .order = order <= 8 ? (unsigned)order : 9,
                                  .section_order = section_order <= 8 ? (unsigned)section_order : 9,
                                  .section_first = newer_count(r, "section_first", 0),
                                  .section_stride = newer_count(r, "section_stride", 0)};
    galv_moment_set set;
    galv_extra extra;
    model_file_extra(file, &set, &extra);
    if (!r->wrong &&
        (file->set.order > 8 || file->set.section_order > 8 || file->rows > MOST_NUMBERS ||
         extra.count != galv_model_coordinates(file->model) - 3 * galv_model_points(file->model)))
        r->wrong = "moments";
    return !r->wrong;
}

static bool read_all(struct reader *r, struct model_file *file)
{
    char format[32] = "";
    size_t version = 0, uniform = 0;
    if (!h5_read_text(r->h5, "format", format, sizeof format) ||
        strcmp(format, "galv-model") != 0) {
        r->wrong = "format";
        return false;
    }
    if (!count(r, "version", &version) || version != VERSION) {
        r->wrong = "version";
        return false;
    }
    count(r, "sections", &file->sections);
    count(r, "girth", &file->girth);
    count(r, "uniform", &uniform);
    count(r, "seed", &file->seed);
    file->uniform = uniform != 0;
    if (!r->wrong && !h5_read_text(r->h5, "hull", file->hull, sizeof file->hull))
        r->wrong = "hull";
    if (r->wrong || !read_model(r->h5, &file->model))
        return false;
    file->drawn = newer_count(r, "drawn", file->uniform ? galv_model_samples(file->model) : 0);
    size_t points = galv_model_points(file->model);
    if (file->sections > points || file->girth > points ||
        (file->girth && file->sections * file->girth != points)) {
        r->wrong = "sections";
        return false;
    }
    if (!read_appended(r, file))
        return false;
    hid_t group = H5Gopen2(r->h5, "shape", H5P_DEFAULT);
    if (group < 0) {
        r->wrong = "shape";
        return false;
    }
    struct reader inner = {.h5 = group};
    bool ok = read_shape(&inner, file->model, &file->shape);
    r->wrong = inner.wrong;
    H5Gclose(group);
    return ok;
}

bool model_file_read(const char *path, struct model_file *file)
{
    *file = (struct model_file){.model = NULL};
    struct reader r = {.h5 = h5_open(path)};
    if (r.h5 < 0)
        return false;
    bool ok = read_all(&r, file);
    H5Fclose(r.h5);
    if (ok)
        return true;
    if (r.wrong)
        cli_fail("%s: '%s' is missing or not what a model file has", path, r.wrong);
    else
        cli_fail("%s: %s", path, galv_last_error());
    model_file_free(file);
    return false;
}

void model_file_free(struct model_file *file)
{
    galv_model_free(file->model);
    shape_definition_free(&file->shape);
    file->model = NULL;
}

void model_file_extra(const struct model_file *file, galv_moment_set *set, galv_extra *extra)
{
    *extra = (galv_extra){.count = 0};
    *set = file->set;
    if (file->moments)
        galv_moments_extra(set, extra);
    extra->count += file->rows;
    extra->given = file->rows;
}
