/* How libnurbs reports a failure: return nurbs_fail(code, "patch %zu: knot %zu decreases", p, k).
 */
#ifndef NURBS_ERROR_H
#define NURBS_ERROR_H

#include <nurbs/status.h>

__attribute__((format(printf, 2, 3))) nurbs_status nurbs_fail(nurbs_status code, const char *format,
                                                              ...);

/* The first line of a public function: what it must be given, as NURBS_NEED(curve && copy). */
#define NURBS_NEED(pointers)                                                                       \
    do {                                                                                           \
        if (!(pointers))                                                                           \
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: NULL given, expected %s", __func__,       \
                              #pointers);                                                          \
    } while (0)

/* The last failure again, with the object that it concerns before its sentence: "where: sentence".
 */
nurbs_status nurbs_fail_in(nurbs_status code, const char *where);

#endif
