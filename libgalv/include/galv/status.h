/**
 * @file status.h
 * Status codes and error texts of libgalv.
 *
 * Every call that can fail returns a galv_status: 0 on success, negative for an error, positive
 * when it finished for a reason worth telling. The sentence that names what was wrong (which
 * argument, line, value, and what was expected) is kept per thread for galv_last_error(). The
 * library never prints and never exits.
 */
#ifndef GALV_STATUS_H
#define GALV_STATUS_H

#include <stddef.h>

#if defined(_WIN32)
#define GALV_API
#else
#define GALV_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The one list of codes: X(name, value, text). */
#define GALV_STATUS_LIST(X)                                                                        \
    X(GALV_OK, 0, "success")                                                                       \
    X(GALV_ERROR_ARGUMENT, -1, "invalid argument")                                                 \
    X(GALV_ERROR_MEMORY, -2, "out of memory")                                                      \
    X(GALV_ERROR_FILE, -3, "file cannot be read or written")                                       \
    X(GALV_ERROR_FORMAT, -4, "malformed file")                                                     \
    X(GALV_ERROR_GEOMETRY, -5, "unusable geometry")                                                \
    X(GALV_ERROR_NUMERIC, -6, "numerical failure")                                                 \
    X(GALV_ERROR_CANCELLED, -7, "cancelled by the caller")

/** What a call returns: 0 for success, negative for an error. */
typedef enum galv_status {
#define GALV_STATUS_ENUM(name, value, text) name = value,
    GALV_STATUS_LIST(GALV_STATUS_ENUM)
#undef GALV_STATUS_ENUM
} galv_status;

/** Short text of a code ("invalid argument"); "unknown status" for anything else. */
GALV_API const char *galv_status_string(galv_status status);

/** Detail of the last failure in this thread; "" before the first. Borrowed: valid until the next
 * failing call of this thread. */
GALV_API const char *galv_last_error(void);

/** Version of the library, "major.minor.patch". */
GALV_API const char *galv_version(void);

#ifdef __cplusplus
}
#endif

#endif
