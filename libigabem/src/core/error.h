/* How libigabem reports a failure: return igabem_fail(code, "patch %zu: knot %zu decreases", p, k).
 */
#ifndef IGABEM_ERROR_H
#define IGABEM_ERROR_H

#include <igabem/status.h>

__attribute__((format(printf, 2, 3))) igabem_status igabem_fail(igabem_status code,
                                                                const char *format, ...);

/* What a LAPACKE call's info != 0 means while doing `what`: no memory for its own work arrays, or a
 * matrix that is singular or holds NaN. */
igabem_status igabem_fail_lapack(const char *what, int info);

#endif
