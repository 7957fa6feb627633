/**
 * @file expression.h
 * Small arithmetic on named variables, as a text: conditions that points must satisfy.
 *
 * Numbers, names (letters, digits, '_' and '.', not beginning with a digit), + - * / ^ with their
 * usual precedence (^ binds to the right and stronger than a sign), parentheses, the constant pi
 * and the functions abs, sqrt, exp, log, log10, sin, cos, tan, asin, acos, atan, floor, min and max
 * (of two or more). At most one comparison <=, >=, <, > or == between two such expressions; < means
 * the same as <=, since a boundary has no volume.
 */
#ifndef BAYESOPT_EXPRESSION_H
#define BAYESOPT_EXPRESSION_H

#include <bayesopt/status.h>

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How an expression is meant. */
typedef enum bayesopt_relation {
    BAYESOPT_RELATION_NONE,  /**< a value */
    BAYESOPT_RELATION_LEAST, /**< an inequality, which holds where the value is not positive */
    BAYESOPT_RELATION_EQUAL, /**< an equality, which holds where the value is 0 */
} bayesopt_relation;

/** A text made ready to be evaluated. */
typedef struct bayesopt_expression bayesopt_expression;

/**
 * Creates an expression; release it with bayesopt_expression_free().
 * @param text   at most 4096 characters, brackets at most 50 deep
 * @param n      number of names, 0 to 1000
 * @param names  [n] what the variables are called
 * @return BAYESOPT_ERROR_ARGUMENT with the place at fault: "at 'b <= 2': expected ..."
 */
BAYESOPT_API bayesopt_status bayesopt_expression_create(const char *text, size_t n,
                                                        const char *const *names,
                                                        bayesopt_expression **expression);
/** Frees an expression; takes NULL. */
BAYESOPT_API void bayesopt_expression_free(bayesopt_expression *expression);

/** The value at values [n]: of a comparison the left side minus the right one, with the sign that
 * bayesopt_relation states. NAN where it has none (the root of a negative number). */
BAYESOPT_API double bayesopt_expression_value(const bayesopt_expression *expression,
                                              const double *values);

/** What the comparison in it says; BAYESOPT_RELATION_NONE without one. */
BAYESOPT_API bayesopt_relation bayesopt_expression_relation(const bayesopt_expression *expression);

/** Whether variable j stands in it. */
BAYESOPT_API bool bayesopt_expression_uses(const bayesopt_expression *expression, size_t j);

#ifdef __cplusplus
}
#endif

#endif
