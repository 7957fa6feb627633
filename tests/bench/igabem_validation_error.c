/* What a result says of its own discretisation error, beside a twice finer mesh. */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SPEEDS = 3, MESHES = 4, REFERENCE = MESHES, ALL };
static const int elements[ALL][2] = {{12, 4}, {16, 6}, {24, 8}, {32, 10}, {64, 20}};

struct tally {
    int within, below, above;
};

static void count(double error, double estimate, struct tally *tally)
{
    tally->within += estimate <= 3.0 * error && estimate >= error / 3.0;
    tally->below += estimate < error / 3.0;
    tally->above += estimate > 3.0 * error;
}

static void rows(const char *name, igabem_hull *hull, const double froude[SPEEDS],
                 struct tally *tally)
{
    igabem_forces forces[ALL][SPEEDS];
    for (int m = 0; m < ALL; m++) {
        igabem_options options[SPEEDS];
        for (int k = 0; k < SPEEDS; k++) {
            options[k] = at_froude(froude[k]);
            options[k].elements_u = elements[m][0];
            options[k].elements_v = elements[m][1];
        }
        solve_all(hull, SPEEDS, options, forces[m]);
    }
    for (int k = 0; k < SPEEDS; k++) {
        double best = forces[REFERENCE][k].cw;
        printf("| %s, Fr %.2f |", name, froude[k]);
        for (int m = 0; m < MESHES; m++) {
            double error = forces[m][k].cw / best - 1.0;
            double estimate = forces[m][k].cw_error / forces[m][k].cw;
            printf(" %+.2g (%.2g) |", 100.0 * error, 100.0 * estimate);
            count(fabs(error), estimate, tally);
        }
        printf("\n");
    }
    igabem_hull_free(hull);
}

static igabem_hull *series60(void)
{
    nurbs_hull *file;
    igabem_hull *hull;
    if (nurbs_hull_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", NULL, &file)) {
        fprintf(stderr, "igabem_validation: %s\n", nurbs_last_error());
        exit(EXIT_FAILURE);
    }
    if (igabem_hull_from(file, &hull)) {
        fprintf(stderr, "igabem_validation: %s\n", igabem_last_error());
        exit(EXIT_FAILURE);
    }
    nurbs_hull_free(file);
    return hull;
}

void error_section(const char *file)
{
    struct tally tally = {0, 0, 0};
    printf("## Estimated discretisation error\n\n"
           "Error of C_w in per cent, against 64 x 20 elements of the same formulation, and in "
           "brackets what the result says of itself\n(`igabem_forces.cw_error`). Wigley and "
           "Series 60 neumann-kelvin, 5415 neumann-kelvin-stern.\n\n| body |");
    for (int m = 0; m < MESHES; m++)
        printf(" %d x %d |", elements[m][0], elements[m][1]);
    printf("\n|---|---|---|---|---|\n");
    rows("Wigley", wigley(0.1, 0.0625, 1, 1), (const double[]){0.25, 0.30, 0.40}, &tally);
    rows("5415", hull_file(file, 1e-4), (const double[]){0.25, 0.30, 0.40}, &tally);
    rows("Series 60", series60(), (const double[]){0.22, 0.28, 0.34}, &tally);
    rows("spheroid, L/D 6, axis at L/8", ellipsoid(1.0, 1.0 / 6, 1.0 / 6, 0.125, 1, 1),
         (const double[]){0.30, 0.35, 0.50}, &tally);
    printf(
        "\nOf %d estimates %d are within a factor of 3 of the error, %d are below a third of it, "
        "%d above three times it.\n\n",
        tally.within + tally.below + tally.above, tally.within, tally.below, tally.above);
}
