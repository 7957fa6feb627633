/* How libigabem reports a failure: return igabem_fail(code, "patch %zu: knot %zu decreases", p, k).
 */
#ifndef IGABEM_ERROR_H
#define IGABEM_ERROR_H

#include <igabem/status.h>

__attribute__((format(printf, 2, 3))) igabem_status igabem_fail(igabem_status code,
                                                                const char *format, ...);

#endif
