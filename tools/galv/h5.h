/* Arrays and attributes of HDF5 files, in the few forms that model files use. All calls return
 * false on failure and print nothing, but for h5_open(). */
#ifndef GALV_TOOL_H5_H
#define GALV_TOOL_H5_H

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>

/* A file for reading; negative, with why printed, for what is none. */
hid_t h5_open(const char *path);

/* Datasets of doubles of 1 or 2 dimensions; columns 0: one dimension. */
bool h5_write_array(hid_t place, const char *name, size_t rows, size_t columns,
                    const double *values);
/* Reads a dataset whose sizes must be as given. */
bool h5_read_array(hid_t place, const char *name, size_t rows, size_t columns, double *values);
/* A new array with the dataset's numbers; NULL when it is missing, has not that many dimensions, is
 * empty, or claims more than the file can hold. */
double *h5_load_array(hid_t place, const char *name, int dimensions, size_t *rows, size_t *columns);

bool h5_write_number(hid_t place, const char *name, double value);
bool h5_read_number(hid_t place, const char *name, double *value);
bool h5_write_count(hid_t place, const char *name, size_t value);
bool h5_read_count(hid_t place, const char *name, size_t *value);
bool h5_write_text(hid_t place, const char *name, const char *text);
/* Fixed or variable length strings that fit into size bytes. */
bool h5_read_text(hid_t place, const char *name, char *text, size_t size);

#endif
