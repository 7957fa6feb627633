/* How libgalv reports a failure: return galv_fail(code, "patch %zu: knot %zu decreases", p, k). */
#ifndef GALV_ERROR_H
#define GALV_ERROR_H

#include <galv/status.h>

__attribute__((format(printf, 2, 3))) galv_status galv_fail(galv_status code, const char *format,
                                                            ...);

/* What a call of LAPACKE that returned info means: GALV_OK for 0. `doing` is what it was for. */
galv_status galv_lapack(int info, const char *doing);

#endif
