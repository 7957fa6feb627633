/**
 * @file status.h
 * Status codes and error texts of libnurbs.
 *
 * Every call that can fail returns a nurbs_status: 0 on success, negative for an error, positive
 * when it finished for a reason worth telling. The sentence that names what was wrong (which
 * argument, line, value, and what was expected) is kept per thread for nurbs_last_error(). The
 * library never prints and never exits.
 */
#ifndef NURBS_STATUS_H
#define NURBS_STATUS_H

#include <stddef.h>

#if defined(_WIN32)
#define NURBS_API
#else
#define NURBS_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The one list of codes: X(name, value, text). */
#define NURBS_STATUS_LIST(X)                                                                       \
    X(NURBS_OK, 0, "success")                                                                      \
    X(NURBS_ERROR_ARGUMENT, -1, "invalid argument")                                                \
    X(NURBS_ERROR_MEMORY, -2, "out of memory")                                                     \
    X(NURBS_ERROR_FILE, -3, "file cannot be read or written")                                      \
    X(NURBS_ERROR_FORMAT, -4, "malformed file")                                                    \
    X(NURBS_ERROR_GEOMETRY, -5, "unusable geometry")                                               \
    X(NURBS_ERROR_NUMERIC, -6, "numerical failure")                                                \
    X(NURBS_ERROR_CANCELLED, -7, "cancelled by the caller")

/** What a call returns: 0 for success, negative for an error. */
typedef enum nurbs_status {
#define NURBS_STATUS_ENUM(name, value, text) name = value,
    NURBS_STATUS_LIST(NURBS_STATUS_ENUM)
#undef NURBS_STATUS_ENUM
} nurbs_status;

/** Short text of a code ("invalid argument"); "unknown status" for anything else. */
NURBS_API const char *nurbs_status_string(nurbs_status status);

/** Detail of the last failure in this thread; "" before the first. Borrowed: valid until the next
 * failing call of this thread. */
NURBS_API const char *nurbs_last_error(void);

/** Version of the library, "major.minor.patch". */
NURBS_API const char *nurbs_version(void);

#ifdef __cplusplus
}
#endif

#endif
