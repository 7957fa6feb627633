/**
 * @file status.h
 * Status codes and error texts of libigabem.
 *
 * Every call that can fail returns a igabem_status: 0 on success, negative for an error, positive
 * when it finished for a reason worth telling. The sentence that names what was wrong (which
 * argument, line, value, and what was expected) is kept per thread for igabem_last_error(). The
 * library never prints and never exits.
 */
#ifndef IGABEM_STATUS_H
#define IGABEM_STATUS_H

#include <stddef.h>

#if defined(_WIN32)
#define IGABEM_API
#else
#define IGABEM_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The one list of codes: X(name, value, text). */
#define IGABEM_STATUS_LIST(X)                                                                      \
    X(IGABEM_OK, 0, "success")                                                                     \
    X(IGABEM_ERROR_ARGUMENT, -1, "invalid argument")                                               \
    X(IGABEM_ERROR_MEMORY, -2, "out of memory")                                                    \
    X(IGABEM_ERROR_FILE, -3, "file cannot be read or written")                                     \
    X(IGABEM_ERROR_FORMAT, -4, "malformed file")                                                   \
    X(IGABEM_ERROR_GEOMETRY, -5, "unusable geometry")                                              \
    X(IGABEM_ERROR_NUMERIC, -6, "numerical failure")                                               \
    X(IGABEM_ERROR_CANCELLED, -7, "cancelled by the caller")

/** What a call returns: 0 for success, negative for an error. */
typedef enum igabem_status {
#define IGABEM_STATUS_ENUM(name, value, text) name = value,
    IGABEM_STATUS_LIST(IGABEM_STATUS_ENUM)
#undef IGABEM_STATUS_ENUM
} igabem_status;

/** Short text of a code ("invalid argument"); "unknown status" for anything else. */
IGABEM_API const char *igabem_status_string(igabem_status status);

/** Detail of the last failure in this thread; "" before the first. Borrowed: valid until the next
 * failing call of this thread. */
IGABEM_API const char *igabem_last_error(void);

/** Version of the library, "major.minor.patch". */
IGABEM_API const char *igabem_version(void);

#ifdef __cplusplus
}
#endif

#endif
