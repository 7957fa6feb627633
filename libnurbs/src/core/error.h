/* How libnurbs reports a failure: return nurbs_fail(code, "patch %zu: knot %zu decreases", p, k).
 */
#ifndef NURBS_ERROR_H
#define NURBS_ERROR_H

#include <nurbs/status.h>

__attribute__((format(printf, 2, 3))) nurbs_status nurbs_fail(nurbs_status code, const char *format,
                                                              ...);

/* The last failure again, with the object that it concerns before its sentence: "where: sentence".
 */
nurbs_status nurbs_fail_in(nurbs_status code, const char *where);

#endif
