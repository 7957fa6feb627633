/* Rows of tests/data/kelvin_reference.csv. */
#ifndef TESTS_KELVIN_REFERENCE_H
#define TESTS_KELVIN_REFERENCE_H

#include <stdio.h>
#include <stdlib.h>

enum { KELVIN_MOST_ROWS = 256 };

struct kelvin_row {
    double X, Y, Z, local[4], wave[4]; /* value and derivatives in X, Y, Z */
};

/* Fills rows, returns their number, 0 if the file cannot be read. */
static inline size_t kelvin_read_rows(struct kelvin_row *rows)
{
    FILE *file = fopen(TEST_DATA_DIR "/kelvin_reference.csv", "r");
    char line[1024];
    size_t n = 0;
    while (file && n < KELVIN_MOST_ROWS && fgets(line, sizeof line, file)) {
        struct kelvin_row *r = &rows[n];
        n += sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &r->X, &r->Y, &r->Z,
                    &r->local[0], &r->local[1], &r->local[2], &r->local[3], &r->wave[0],
                    &r->wave[1], &r->wave[2], &r->wave[3]) == 11;
    }
    if (file)
        fclose(file);
    return n;
}

#endif
