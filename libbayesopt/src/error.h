/* How libbayesopt reports a failure: return bayesopt_fail(code, "patch %zu: knot %zu decreases", p,
 * k). */
#ifndef BAYESOPT_ERROR_H
#define BAYESOPT_ERROR_H

#include <bayesopt/status.h>

__attribute__((format(printf, 2, 3))) bayesopt_status bayesopt_fail(bayesopt_status code,
                                                                    const char *format, ...);

#endif
