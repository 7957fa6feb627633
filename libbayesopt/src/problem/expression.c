/* Expressions: recursive descent into a list of operations on a stack. */
#include "core/constants.h"
#include "core/error.h"

#include <bayesopt/expression.h>

#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A text of this length has fewer operations than characters, and each is at most one deep. */
enum { MOST_TEXT = 4096, MOST_DEPTH = 50, MOST_STACK = 2 * MOST_DEPTH + 16 };

enum code { NUMBER, VARIABLE, NEGATE, ADD, SUBTRACT, MULTIPLY, DIVIDE, POWER, FUNCTION };

struct operation {
    enum code code;
    double number;
    size_t index; /* of a variable, of a function */
};

struct bayesopt_expression {
    size_t n;
    struct operation *operations;
    bayesopt_relation relation;
    bool turned; /* the right side minus the left one */
};

static double minimum(double a, double b)
{
    return isnan(a) || isnan(b) ? (double)NAN : fmin(a, b);
}

static double maximum(double a, double b)
{
    return isnan(a) || isnan(b) ? (double)NAN : fmax(a, b);
}

static const struct {
    const char *name;
    double (*one)(double);
    double (*two)(double, double); /* of two or more, one after the other */
} functions[] = {
    {"abs", fabs, NULL},    {"sqrt", sqrt, NULL},   {"exp", exp, NULL},   {"log", log, NULL},
    {"log10", log10, NULL}, {"sin", sin, NULL},     {"cos", cos, NULL},   {"tan", tan, NULL},
    {"asin", asin, NULL},   {"acos", acos, NULL},   {"atan", atan, NULL}, {"floor", floor, NULL},
    {"min", NULL, minimum}, {"max", NULL, maximum},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

struct parser {
    const char *at;
    size_t n;
    const char *const *names;
    bayesopt_expression *expression;
    size_t room, depth;
    bayesopt_status status;
};

static void fail(struct parser *p, const char *expected)
{
    if (!p->status)
        p->status =
            bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "at '%.40s': expected %s", p->at, expected);
}

static void emit(struct parser *p, enum code code, double number, size_t index)
{
    bayesopt_expression *e = p->expression;
    if (p->status)
        return;
    if (e->n == p->room) {
        size_t room = p->room ? 2 * p->room : 16;
        struct operation *more = realloc(e->operations, room * sizeof *more);
        if (!more) {
            p->status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
            return;
        }
        e->operations = more;
        p->room = room;
    }
    e->operations[e->n++] = (struct operation){code, number, index};
}

static void skip(struct parser *p)
{
    while (isspace((unsigned char)*p->at))
        p->at++;
}

static bool take(struct parser *p, const char *word)
{
    skip(p);
    size_t length = strlen(word);
    if (strncmp(p->at, word, length) != 0)
        return false;
    p->at += length;
    return true;
}

static void parse_sum(struct parser *p);

/* The operands of a function, its opening bracket taken. */
static void parse_operands(struct parser *p, size_t f)
{
    size_t count = 1;
    parse_sum(p);
    for (; !p->status && take(p, ","); count++) {
        parse_sum(p);
        if (functions[f].two)
            emit(p, FUNCTION, 0, f);
    }
    if (!p->status && (functions[f].two ? count < 2 : count > 1))
        fail(p, functions[f].two ? "two or more operands" : "one operand");
    if (!take(p, ")"))
        fail(p, "')'");
    if (functions[f].one)
        emit(p, FUNCTION, 0, f);
}

static void parse_name(struct parser *p)
{
    size_t length = 0;
    while (isalnum((unsigned char)p->at[length]) || p->at[length] == '_' || p->at[length] == '.')
        length++;
    for (size_t j = 0; j < p->n; j++)
        if (strlen(p->names[j]) == length && strncmp(p->names[j], p->at, length) == 0) {
            p->at += length;
            emit(p, VARIABLE, 0, j);
            return;
        }
    if (length == 2 && strncmp(p->at, "pi", 2) == 0) {
        p->at += length;
        emit(p, NUMBER, PI, 0);
        return;
    }
    for (size_t f = 0; f < FUNCTIONS; f++)
        if (strlen(functions[f].name) == length && strncmp(functions[f].name, p->at, length) == 0) {
            p->at += length;
            if (take(p, "("))
                parse_operands(p, f);
            else
                fail(p, "'(' after a function");
            return;
        }
    fail(p, "a variable's name, pi or a function");
}

static void parse_number(struct parser *p)
{
    char *end;
    double value = strtod(p->at, &end);
    /* strtod() also takes hexadecimal numbers, and "1e5" of a name that begins so. */
    bool hexadecimal = p->at[0] == '0' && tolower((unsigned char)p->at[1]) == 'x';
    if (hexadecimal || end == p->at || !isfinite(value) || isalpha((unsigned char)*end) ||
        *end == '_') {
        fail(p, "a number");
        return;
    }
    p->at = end;
    emit(p, NUMBER, value, 0);
}

static void parse_power(struct parser *p);

static void parse_primary(struct parser *p)
{
    skip(p);
    if (p->status)
        return;
    if (++p->depth > MOST_DEPTH) {
        fail(p, "fewer brackets within each other");
    } else if (take(p, "(")) {
        parse_sum(p);
        if (!take(p, ")"))
            fail(p, "')'");
    } else if (isdigit((unsigned char)*p->at) || *p->at == '.') {
        parse_number(p);
    } else if (isalpha((unsigned char)*p->at) || *p->at == '_') {
        parse_name(p);
    } else {
        fail(p, "a number, a name or '('");
    }
    p->depth--;
}

/* A sign binds weaker than a power: -2^2 is -4, 2^-1 a half. */
static void parse_sign(struct parser *p)
{
    bool negative = false;
    for (;;) {
        if (take(p, "-"))
            negative = !negative;
        else if (!take(p, "+"))
            break;
    }
    parse_power(p);
    if (negative)
        emit(p, NEGATE, 0, 0);
}

static void parse_power(struct parser *p)
{
    parse_primary(p);
    if (p->status || !take(p, "^"))
        return;
    if (++p->depth > MOST_DEPTH)
        fail(p, "fewer powers of powers");
    else
        parse_sign(p);
    emit(p, POWER, 0, 0);
    p->depth--;
}

static void parse_product(struct parser *p)
{
    parse_sign(p);
    while (!p->status) {
        enum code code = take(p, "*") ? MULTIPLY : take(p, "/") ? DIVIDE : NUMBER;
        if (code == NUMBER)
            return;
        parse_sign(p);
        emit(p, code, 0, 0);
    }
}

static void parse_sum(struct parser *p)
{
    if (++p->depth > MOST_DEPTH)
        fail(p, "fewer brackets within each other");
    else
        parse_product(p);
    while (!p->status) {
        enum code code = take(p, "+") ? ADD : take(p, "-") ? SUBTRACT : NUMBER;
        if (code == NUMBER)
            break;
        parse_product(p);
        emit(p, code, 0, 0);
    }
    p->depth--;
}

static void parse_comparison(struct parser *p)
{
    bayesopt_expression *e = p->expression;
    parse_sum(p);
    if (p->status)
        return;
    if (take(p, "==")) {
        e->relation = BAYESOPT_RELATION_EQUAL;
    } else if (take(p, "<=") || take(p, "<")) {
        e->relation = BAYESOPT_RELATION_LEAST;
    } else if (take(p, ">=") || take(p, ">")) {
        e->relation = BAYESOPT_RELATION_LEAST;
        e->turned = true;
    }
    if (e->relation != BAYESOPT_RELATION_NONE) {
        parse_sum(p);
        emit(p, SUBTRACT, 0, 0);
        if (e->turned)
            emit(p, NEGATE, 0, 0);
    }
    skip(p);
    if (*p->at)
        fail(p, "an operator, or the end");
}

bayesopt_status bayesopt_expression_create(const char *text, size_t n, const char *const *names,
                                           bayesopt_expression **out)
{
    NEED(text);
    NEED(out);
    NEED_MOST(n, BAYESOPT_MOST_VARIABLES);
    if (n && !names)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu variables without names", n);
    for (size_t j = 0; j < n; j++)
        NEED(names[j]);
    if (strlen(text) > MOST_TEXT)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu characters, expected at most %d",
                             strlen(text), MOST_TEXT);
    struct parser p = {.at = text, .n = n, .names = names, .expression = calloc(1, sizeof **out)};
    if (!p.expression)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    /* Numbers are read in the C locale whatever the program's is. */
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!c) {
        bayesopt_expression_free(p.expression);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    locale_t before = uselocale(c);
    parse_comparison(&p);
    uselocale(before);
    freelocale(c);
    if (p.status)
        bayesopt_expression_free(p.expression);
    else
        *out = p.expression;
    return p.status;
}

void bayesopt_expression_free(bayesopt_expression *expression)
{
    if (!expression)
        return;
    free(expression->operations);
    free(expression);
}

static double apply(enum code code, double a, double b)
{
    return code == ADD        ? a + b
           : code == SUBTRACT ? a - b
           : code == MULTIPLY ? a * b
           : code == DIVIDE   ? a / b
                              : pow(a, b);
}

double bayesopt_expression_value(const bayesopt_expression *e, const double *values)
{
    double stack[MOST_STACK];
    size_t top = 0;
    if (!e)
        return NAN;
    for (size_t i = 0; i < e->n; i++) {
        const struct operation *o = &e->operations[i];
        bool pushes = o->code == NUMBER || o->code == VARIABLE;
        if ((pushes && top == MOST_STACK) || (o->code == VARIABLE && !values))
            return NAN;
        if (pushes)
            stack[top++] = o->code == NUMBER ? o->number : values[o->index];
        else if (o->code == NEGATE)
            stack[top - 1] = -stack[top - 1];
        else if (o->code == FUNCTION && functions[o->index].one)
            stack[top - 1] = functions[o->index].one(stack[top - 1]);
        else if (o->code == FUNCTION) {
            top--;
            stack[top - 1] = functions[o->index].two(stack[top - 1], stack[top]);
        } else {
            top--;
            stack[top - 1] = apply(o->code, stack[top - 1], stack[top]);
        }
    }
    return top ? stack[0] : (double)NAN;
}

bayesopt_relation bayesopt_expression_relation(const bayesopt_expression *expression)
{
    return expression ? expression->relation : BAYESOPT_RELATION_NONE;
}

bool bayesopt_expression_uses(const bayesopt_expression *e, size_t j)
{
    for (size_t i = 0; e && i < e->n; i++)
        if (e->operations[i].code == VARIABLE && e->operations[i].index == j)
            return true;
    return false;
}
