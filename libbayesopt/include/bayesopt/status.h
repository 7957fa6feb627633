/**
 * @file status.h
 * Status codes and error texts of libbayesopt.
 *
 * Every call that can fail returns a bayesopt_status: 0 on success, negative for an error, positive
 * when it finished for a reason worth telling. The sentence that names what was wrong (which
 * argument, line, value, and what was expected) is kept per thread for bayesopt_last_error(). The
 * library never prints and never exits.
 */
#ifndef BAYESOPT_STATUS_H
#define BAYESOPT_STATUS_H

#include <stddef.h>

#if defined(_WIN32)
#define BAYESOPT_API
#else
#define BAYESOPT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What is refused as too much, with BAYESOPT_ERROR_ARGUMENT. What exact inference can bear is
 * less: about 1000 points, see docs/bayesopt.md. */
enum {
    BAYESOPT_MOST_VARIABLES = 1000,   /**< d */
    BAYESOPT_MOST_POINTS = 1000000,   /**< n of a design, of a batch, of the data of a regression */
    BAYESOPT_MOST_CONSTRAINTS = 1000, /**< of outcome, input and linear constraints, each */
    BAYESOPT_MOST_VALUES = 1000000,   /**< of an integer or categorical variable */
};

/** The one list of codes: X(name, value, text). */
#define BAYESOPT_STATUS_LIST(X)                                                                    \
    X(BAYESOPT_OK, 0, "success")                                                                   \
    X(BAYESOPT_ERROR_ARGUMENT, -1, "invalid argument")                                             \
    X(BAYESOPT_ERROR_MEMORY, -2, "out of memory")                                                  \
    X(BAYESOPT_ERROR_FILE, -3, "file cannot be read or written")                                   \
    X(BAYESOPT_ERROR_FORMAT, -4, "malformed file")                                                 \
    X(BAYESOPT_ERROR_NUMERIC, -6, "numerical failure")                                             \
    X(BAYESOPT_ERROR_CANCELLED, -7, "cancelled by the caller")                                     \
    X(BAYESOPT_ERROR_INFEASIBLE, -8, "no point satisfies the input constraints")                   \
    X(BAYESOPT_STOP_BUDGET, 1, "the budget of evaluations is spent")                               \
    X(BAYESOPT_STOP_NO_IMPROVEMENT, 2, "no improvement for long")                                  \
    X(BAYESOPT_STOP_EXPECTED_IMPROVEMENT, 3, "the expected improvement is small")                  \
    X(BAYESOPT_NONE_FEASIBLE, 4, "no evaluation satisfies the outcome constraints")                \
    X(BAYESOPT_STOP_EXHAUSTED, 5, "every point that the variables allow has been asked")

/** What a call returns: 0 for success, negative for an error. */
typedef enum bayesopt_status {
#define BAYESOPT_STATUS_ENUM(name, value, text) name = value,
    BAYESOPT_STATUS_LIST(BAYESOPT_STATUS_ENUM)
#undef BAYESOPT_STATUS_ENUM
} bayesopt_status;

/** Short text of a code ("invalid argument"); "unknown status" for anything else. */
BAYESOPT_API const char *bayesopt_status_string(bayesopt_status status);

/** Detail of the last failure in this thread; "" before the first. Borrowed: valid until the next
 * failing call of this thread. */
BAYESOPT_API const char *bayesopt_last_error(void);

/** Version of the library, "major.minor.patch". */
BAYESOPT_API const char *bayesopt_version(void);

#ifdef __cplusplus
}
#endif

#endif
