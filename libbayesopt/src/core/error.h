/* How libbayesopt reports a failure: return bayesopt_fail(code, "patch %zu: knot %zu decreases", p,
 * k). */
#ifndef BAYESOPT_ERROR_H
#define BAYESOPT_ERROR_H

#include <bayesopt/status.h>

__attribute__((format(printf, 2, 3))) bayesopt_status bayesopt_fail(bayesopt_status code,
                                                                    const char *format, ...);

/* A parameter of a public call that may not be NULL: answered by a status. */
#define NEED(parameter)                                                                            \
    do {                                                                                           \
        if (!(parameter))                                                                          \
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%s: %s is NULL", __func__, #parameter); \
    } while (0)

/* A count that may not exceed one of the limits of status.h. */
#define NEED_MOST(count, most)                                                                     \
    do {                                                                                           \
        if ((count) > (size_t)(most))                                                              \
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%s: %s is %zu, expected at most %zu",   \
                                 __func__, #count, (size_t)(count), (size_t)(most));               \
    } while (0)

#endif
