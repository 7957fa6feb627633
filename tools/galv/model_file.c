#include "model_file.h"

#include "cli.h"
#include "h5.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 1 };

/* No array of a model file is longer. */
#define MOST_NUMBERS ((size_t)1 << 40)

static const char *const methods[] = {"auto", "covariance", "gram", "randomised", "factored"};

const char *method_name(galv_method method)
{
    return methods[method];
}

static bool write_model(hid_t h5, const galv_model *model)
{
    galv_model_data d = galv_model_view(model);
    return h5_write_count(h5, "samples", d.samples) && h5_write_count(h5, "points", d.points) &&
           h5_write_count(h5, "coordinates", d.coordinates) &&
           h5_write_count(h5, "active", d.active) &&
           h5_write_count(h5, "parameters", d.parameters) && h5_write_count(h5, "modes", d.modes) &&
           h5_write_count(h5, "spectrum", d.spectrum) && h5_write_count(h5, "kept", d.kept) &&
           h5_write_count(h5, "passes", d.passes) && h5_write_count(h5, "centred", d.centred) &&
           h5_write_text(h5, "method", method_name(d.method)) &&
           h5_write_number(h5, "retained", d.retained) &&
           h5_write_number(h5, "retained_geometry", d.retained_geometry) &&
           h5_write_number(h5, "trace", d.trace) &&
           h5_write_number(h5, "trace_geometry", d.trace_geometry) &&
           h5_write_number(h5, "truncation", d.truncation) &&
           h5_write_number(h5, "retained_error", d.confidence.retained_error) &&
           h5_write_number(h5, "subspace_angle", d.confidence.angle) &&
           h5_write_array(h5, "eigenvalues", d.spectrum, 0, d.eigenvalues) &&
           h5_write_array(h5, "residuals", d.spectrum, 0, d.residuals) &&
           h5_write_array(h5, "mse", d.spectrum, 0, d.mse) &&
           h5_write_array(h5, "vectors", d.kept, d.coordinates, d.vectors) &&
           h5_write_array(h5, "mean", d.coordinates, 0, d.mean) &&
           h5_write_array(h5, "parent", d.points, 3, d.parent) &&
           (!d.weights || h5_write_array(h5, "weights", d.coordinates, 0, d.weights)) &&
           h5_write_array(h5, "latent", d.samples, d.modes, d.latent) &&
           h5_write_array(h5, "lower", d.modes, 0, d.lower) &&
           h5_write_array(h5, "upper", d.modes, 0, d.upper) &&
           h5_write_array(h5, "regression", d.parameters, 1 + d.modes, d.regression);
}

/* The table of what each parameter does: for sines n rows of order (3), phase (3), direction; for a
 * lattice n rows of control point (3), direction. */
static bool write_table(hid_t h5, const struct shape_definition *shape)
{
    size_t columns = shape->kind == SHAPE_SINES ? 7 : 4;
    double *table = malloc(shape->n * columns * sizeof *table);
    for (size_t i = 0; table && i < shape->n; i++)
        for (size_t j = 0; j < 3; j++) {
            double *row = table + i * columns;
            if (shape->kind == SHAPE_SINES) {
                row[j] = shape->functions[i].order[j];
                row[3 + j] = shape->functions[i].phase[j];
                row[6] = shape->functions[i].direction;
            } else {
                row[j] = (double)shape->moves[i].index[j];
                row[3] = shape->moves[i].direction;
            }
        }
    bool ok = table && h5_write_array(h5, "table", shape->n, columns, table);
    free(table);
    return ok;
}

static bool write_shape(hid_t h5, const struct shape_definition *shape)
{
    double lattice[6] = {0};
    for (int j = 0; j < 3; j++) {
        lattice[j] = (double)shape->count[j];
        lattice[3 + j] = shape->degree[j];
    }
    return h5_write_text(h5, "kind", shape->kind == SHAPE_SINES ? "sines" : "lattice") &&
           h5_write_text(h5, "combination",
                         shape->combination == GALV_COMBINATION_RECURSIVE ? "recursive"
                                                                          : "linear") &&
           h5_write_count(h5, "parameters", shape->n) &&
           h5_write_array(h5, "box_origin", 3, 0, shape->box.origin) &&
           h5_write_array(h5, "box_length", 3, 0, shape->box.length) &&
           h5_write_array(h5, "lower", shape->n, 0, shape->lower) &&
           h5_write_array(h5, "upper", shape->n, 0, shape->upper) &&
           h5_write_array(h5, "lattice", 6, 0, lattice) && write_table(h5, shape);
}

static bool write_all(hid_t h5, const struct model_file *file)
{
    hid_t shape = H5Gcreate2(h5, "shape", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
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
    return ok;
}

/* The library writes to the name of the temporary file; committing flushes, renames and syncs it.
 */
bool model_file_write(const char *path, const struct model_file *file)
{
    struct cli_file out;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    if (!cli_file_open(&out, path)) {
        cli_fail("%s: %s", path, strerror(errno));
        return false;
    }
    hid_t h5 = H5Fcreate(out.temporary, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    bool ok = h5 >= 0 && write_all(h5, file);
    if (h5 >= 0)
        ok = H5Fclose(h5) >= 0 && ok;
    if (!ok) {
        cli_file_abandon(&out);
        cli_fail("%s: cannot be written as HDF5", path);
        return false;
    }
    if (!cli_file_commit(&out)) {
        cli_fail("%s: %s", path, strerror(errno));
        return false;
    }
    return true;
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

static void number(struct reader *r, const char *name, double *value)
{
    if (!r->wrong && !h5_read_number(r->h5, name, value))
        r->wrong = name;
}

/* A new array, registered in *slot. */
static const double *array(struct reader *r, const char *name, size_t rows, size_t columns,
                           double **slot)
{
    size_t n = rows * (columns ? columns : 1);
    *slot = NULL;
    if (r->wrong)
        return NULL;
    if (columns && rows > MOST_NUMBERS / columns) {
        r->wrong = name;
        return NULL;
    }
    /* A file cannot make us reserve more than it holds. */
    hid_t set = H5Dopen2(r->h5, name, H5P_DEFAULT);
    hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    bool fits = space >= 0 && H5Sget_simple_extent_npoints(space) == (hssize_t)n && n > 0;
    if (space >= 0)
        H5Sclose(space);
    if (set >= 0)
        H5Dclose(set);
    if (fits)
        *slot = malloc(n * sizeof **slot);
    if (!*slot || !h5_read_array(r->h5, name, rows, columns, *slot))
        r->wrong = name;
    return *slot;
}

enum { ARRAYS = 11 };

static void read_sizes(struct reader *r, galv_model_data *d)
{
    size_t centred = 0;
    count(r, "samples", &d->samples);
    count(r, "points", &d->points);
    count(r, "coordinates", &d->coordinates);
    count(r, "active", &d->active);
    count(r, "parameters", &d->parameters);
    count(r, "modes", &d->modes);
    count(r, "spectrum", &d->spectrum);
    count(r, "kept", &d->kept);
    count(r, "passes", &d->passes);
    count(r, "centred", &centred);
    d->centred = centred != 0;
    number(r, "retained", &d->retained);
    number(r, "retained_geometry", &d->retained_geometry);
    number(r, "trace", &d->trace);
    number(r, "trace_geometry", &d->trace_geometry);
    number(r, "truncation", &d->truncation);
    number(r, "retained_error", &d->confidence.retained_error);
    number(r, "subspace_angle", &d->confidence.angle);
    if (!r->wrong &&
        (d->samples > MOST_NUMBERS || d->points > MOST_NUMBERS || d->coordinates > MOST_NUMBERS ||
         d->parameters > MOST_NUMBERS || d->kept > MOST_NUMBERS || d->spectrum > MOST_NUMBERS ||
         d->modes > (size_t)1 << 20))
        r->wrong = "sizes";
}

static void read_method(struct reader *r, galv_model_data *d)
{
    char text[32];
    if (!r->wrong && !h5_read_text(r->h5, "method", text, sizeof text))
        r->wrong = "method";
    for (size_t i = 0; !r->wrong && i < sizeof methods / sizeof methods[0]; i++)
        if (strcmp(text, methods[i]) == 0) {
            d->method = (galv_method)i;
            return;
        }
    r->wrong = "method";
}

static bool read_model(struct reader *r, galv_model **model)
{
    galv_model_data d = {.samples = 0};
    double *slot[ARRAYS] = {NULL};
    read_sizes(r, &d);
    read_method(r, &d);
    d.eigenvalues = array(r, "eigenvalues", d.spectrum, 0, &slot[0]);
    d.residuals = array(r, "residuals", d.spectrum, 0, &slot[1]);
    d.mse = array(r, "mse", d.spectrum, 0, &slot[2]);
    d.vectors = array(r, "vectors", d.kept, d.coordinates, &slot[3]);
    d.mean = array(r, "mean", d.coordinates, 0, &slot[4]);
    d.parent = array(r, "parent", d.points, 3, &slot[5]);
    if (!r->wrong && h5_exists(r->h5, "weights"))
        d.weights = array(r, "weights", d.coordinates, 0, &slot[6]);
    d.latent = array(r, "latent", d.samples, d.modes, &slot[7]);
    d.lower = array(r, "lower", d.modes, 0, &slot[8]);
    d.upper = array(r, "upper", d.modes, 0, &slot[9]);
    d.regression = array(r, "regression", d.parameters, 1 + d.modes, &slot[10]);
    galv_status status = r->wrong ? GALV_ERROR_FORMAT : galv_model_restore(&d, model);
    for (int i = 0; i < ARRAYS; i++)
        free(slot[i]);
    return status == GALV_OK;
}

/* A whole number in 0..most. */
static bool index_from(double value, double most, size_t *out)
{
    if (!(value >= 0 && value <= most) || value != floor(value))
        return false;
    *out = (size_t)value;
    return true;
}

static bool read_table(struct reader *r, struct shape_definition *shape)
{
    size_t columns = shape->kind == SHAPE_SINES ? 7 : 4, axis = 0;
    double *table;
    if (!array(r, "table", shape->n, columns, &table))
        return false;
    for (size_t i = 0; i < shape->n && !r->wrong; i++) {
        const double *row = table + i * columns;
        bool ok = index_from(row[columns - 1], 2, &axis);
        for (int j = 0; j < 3 && ok; j++) {
            if (shape->kind == SHAPE_SINES) {
                shape->functions[i].order[j] = row[j];
                shape->functions[i].phase[j] = row[3 + j];
            } else {
                ok = index_from(row[j], 1000, &shape->moves[i].index[j]);
            }
        }
        if (!ok)
            r->wrong = "table";
        else if (shape->kind == SHAPE_SINES)
            shape->functions[i].direction = (int)axis;
        else
            shape->moves[i].direction = (int)axis;
    }
    free(table);
    return !r->wrong;
}

static bool read_shape(struct reader *r, size_t parameters, struct shape_definition *shape)
{
    char kind[16] = "", combination[16] = "";
    size_t n = 0, index;
    double lattice[6];
    if (!h5_read_text(r->h5, "kind", kind, sizeof kind) ||
        !h5_read_text(r->h5, "combination", combination, sizeof combination) ||
        !count(r, "parameters", &n) || n != parameters) {
        r->wrong = "shape";
        return false;
    }
    enum shape_kind which = strcmp(kind, "lattice") == 0 ? SHAPE_LATTICE : SHAPE_SINES;
    if (!shape_definition_allocate(which, n, shape)) {
        r->wrong = "shape (out of memory)";
        return false;
    }
    shape->combination =
        strcmp(combination, "linear") == 0 ? GALV_COMBINATION_LINEAR : GALV_COMBINATION_RECURSIVE;
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
    if (!r->wrong &&
        (file->set.order > 8 || file->set.section_order > 8 || file->rows > MOST_NUMBERS ||
         model_file_extra(file, &set).count !=
             galv_model_coordinates(file->model) - 3 * galv_model_points(file->model)))
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
    if (r->wrong || !read_model(r, &file->model))
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
    bool ok = read_shape(&inner, galv_model_parameters(file->model), &file->shape);
    r->wrong = inner.wrong;
    H5Gclose(group);
    return ok;
}

bool model_file_read(const char *path, struct model_file *file)
{
    *file = (struct model_file){.model = NULL};
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    struct reader r = {.h5 = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT)};
    if (r.h5 < 0) {
        cli_fail("%s: not an HDF5 file that can be read", path);
        return false;
    }
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

galv_extra model_file_extra(const struct model_file *file, galv_moment_set *set)
{
    galv_extra extra = {.count = 0};
    *set = file->set;
    if (file->moments)
        extra = galv_moments_extra(set);
    extra.count += file->rows;
    extra.given = file->rows;
    return extra;
}
