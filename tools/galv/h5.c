#include "h5.h"

#include "cli.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

hid_t h5_open(const char *path)
{
    struct stat info;
    hid_t h5 = -1;
    /* HDF5 would wait for a FIFO and seeks in what it opens. */
    if (stat(path, &info) != 0) {
        cli_fail("%s: %s", path, strerror(errno));
    } else if (!S_ISREG(info.st_mode)) {
        cli_fail("%s: not a regular file, as HDF5 is", path);
    } else {
        H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
        h5 = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        if (h5 < 0)
            cli_fail("%s: not an HDF5 file that can be read", path);
    }
    return h5;
}

bool h5_write_array(hid_t place, const char *name, size_t rows, size_t columns,
                    const double *values)
{
    hsize_t size[2] = {rows, columns};
    hid_t space = H5Screate_simple(columns ? 2 : 1, size, NULL);
    hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    /* Without times the same input gives the same file. */
    bool ok = how >= 0 && H5Pset_obj_track_times(how, false) >= 0;
    hid_t set =
        ok ? H5Dcreate2(place, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT) : -1;
    ok = set >= 0 && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    if (set >= 0)
        ok = H5Dclose(set) >= 0 && ok;
    if (how >= 0)
        H5Pclose(how);
    H5Sclose(space);
    return ok;
}

bool h5_read_array(hid_t place, const char *name, size_t rows, size_t columns, double *values)
{
    hid_t set = H5Dopen2(place, name, H5P_DEFAULT);
    if (set < 0)
        return false;
    hid_t space = H5Dget_space(set);
    hsize_t size[2] = {0, 0};
    int wanted = columns ? 2 : 1;
    bool ok = H5Sget_simple_extent_ndims(space) == wanted &&
              H5Sget_simple_extent_dims(space, size, NULL) >= 0 && size[0] == rows &&
              (!columns || size[1] == columns) &&
              H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    H5Sclose(space);
    H5Dclose(set);
    return ok;
}

/* Deflate, the compression of HDF5, makes of a byte 1032 at most. */
static const double MOST_EXPANSION = 1032;

static bool file_can_hold(hid_t place, double numbers)
{
    hid_t file = H5Iget_file_id(place);
    hsize_t size = 0;
    bool ok = file >= 0 && H5Fget_filesize(file, &size) >= 0 &&
              numbers * sizeof(double) <= MOST_EXPANSION * (double)size;
    if (file >= 0)
        H5Fclose(file);
    return ok;
}

double *h5_load_array(hid_t place, const char *name, int dimensions, size_t *rows, size_t *columns)
{
    if (H5Lexists(place, name, H5P_DEFAULT) <= 0)
        return NULL;
    hid_t set = H5Dopen2(place, name, H5P_DEFAULT);
    if (set < 0)
        return NULL;
    hid_t space = H5Dget_space(set);
    hsize_t size[2] = {0, 1};
    double *values = NULL;
    if (H5Sget_simple_extent_ndims(space) == dimensions &&
        H5Sget_simple_extent_dims(space, size, NULL) >= 0 && size[0] && size[1] &&
        file_can_hold(place, (double)size[0] * (double)size[1]))
        values = cli_needed(malloc(size[0] * size[1] * sizeof *values));
    if (values && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
        free(values);
        values = NULL;
    }
    *rows = size[0];
    *columns = size[1];
    H5Sclose(space);
    H5Dclose(set);
    return values;
}

static bool write_attribute(hid_t place, const char *name, hid_t stored, hid_t native,
                            const void *value)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(place, name, stored, space, H5P_DEFAULT, H5P_DEFAULT);
    bool ok = attribute >= 0 && H5Awrite(attribute, native, value) >= 0;
    if (attribute >= 0)
        H5Aclose(attribute);
    H5Sclose(space);
    return ok;
}

static bool read_attribute(hid_t place, const char *name, hid_t native, void *value)
{
    if (H5Aexists(place, name) <= 0)
        return false;
    hid_t attribute = H5Aopen(place, name, H5P_DEFAULT);
    hid_t space = H5Aget_space(attribute), type = H5Aget_type(attribute);
    H5T_class_t class = H5Tget_class(type);
    bool ok = H5Sget_simple_extent_npoints(space) == 1 &&
              (class == H5T_FLOAT || class == H5T_INTEGER) &&
              H5Aread(attribute, native, value) >= 0;
    H5Tclose(type);
    H5Sclose(space);
    H5Aclose(attribute);
    return ok;
}

bool h5_write_number(hid_t place, const char *name, double value)
{
    return write_attribute(place, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

bool h5_read_number(hid_t place, const char *name, double *value)
{
    return read_attribute(place, name, H5T_NATIVE_DOUBLE, value);
}

bool h5_write_count(hid_t place, const char *name, size_t value)
{
    uint64_t stored = value;
    return write_attribute(place, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &stored);
}

bool h5_read_count(hid_t place, const char *name, size_t *value)
{
    uint64_t stored;
    if (!read_attribute(place, name, H5T_NATIVE_UINT64, &stored))
        return false;
    *value = stored;
    return true;
}

bool h5_write_text(hid_t place, const char *name, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text) + 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    bool ok = write_attribute(place, name, type, type, text);
    H5Tclose(type);
    return ok;
}

bool h5_read_text(hid_t place, const char *name, char *text, size_t size)
{
    if (H5Aexists(place, name) <= 0)
        return false;
    hid_t attribute = H5Aopen(place, name, H5P_DEFAULT), type = H5Aget_type(attribute);
    bool ok = false;
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0) {
        char *value = NULL;
        ok = H5Aread(attribute, type, &value) >= 0 && value && strlen(value) < size;
        if (ok)
            snprintf(text, size, "%s", value);
        H5free_memory(value);
    } else if (H5Tget_class(type) == H5T_STRING && H5Tget_size(type) < size) {
        memset(text, 0, size);
        ok = H5Aread(attribute, type, text) >= 0;
    }
    H5Tclose(type);
    H5Aclose(attribute);
    return ok;
}
