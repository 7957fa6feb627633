#include "result.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Characters of a line that a sentence quotes. */
enum { QUOTED = 100 };

static bool is_blank(char c)
{
    return c && isspace((unsigned char)c);
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t count_digits(const char *at)
{
    size_t n = 0;
    while (is_digit(at[n]))
        n++;
    return n;
}

/* nan, inf and infinity with or without a sign. */
static bool parse_special(const char *word, double *value)
{
    const char *name = word + (*word == '+' || *word == '-');
    if (strcasecmp(name, "nan") == 0)
        *value = NAN;
    else if (strcasecmp(name, "inf") == 0 || strcasecmp(name, "infinity") == 0)
        *value = *word == '-' ? -INFINITY : INFINITY;
    else
        return false;
    return true;
}

/* A whole word as a number, Fortran's exponents included. */
static bool parse_word(const char *word, double *value)
{
    char plain[80];
    const char *at = word + (*word == '+' || *word == '-');
    size_t whole = count_digits(at), fraction = 0;
    bool point = at[whole] == '.';
    if (parse_special(word, value))
        return true;
    if (strlen(word) > sizeof plain - 2)
        return false;
    if (point)
        fraction = count_digits(at + whole + 1);
    if (!whole && !fraction)
        return false;
    at += whole + point + fraction;
    int mantissa = (int)(at - word);
    bool letter = *at && strchr("eEdDqQ", *at), sign = false;
    at += letter;
    sign = *at == '+' || *at == '-';
    size_t exponent = count_digits(at + sign);
    /* Only exponents of three digits lose their letter. */
    bool has_exponent = letter ? exponent > 0 : sign && point && exponent == 3;
    if ((letter || sign) && !has_exponent)
        return false;
    if (at[has_exponent ? sign + exponent : 0])
        return false;
    snprintf(plain, sizeof plain, "%.*s%s%s", mantissa, word, has_exponent ? "e" : "",
             has_exponent ? at : "");
    *value = strtod(plain, NULL);
    return true;
}

/* The word at *at as a number, quotes and an opening bracket before it skipped; *at goes behind it.
 * A comma with a digit behind it separates the numbers of a list and spoils a single one: "1,5". */
static bool read_number(const char **at, const char *end, bool list, double *value)
{
    char word[80];
    const char *start = *at;
    while (start < end && (is_blank(*start) || strchr("\"'[(", *start)))
        start++;
    const char *stop = start;
    while (stop < end && !is_blank(*stop) && !strchr("|;])}", *stop) &&
           !(*stop == ',' && (list || !isalnum((unsigned char)stop[1]))))
        stop++;
    size_t length = (size_t)(stop - start);
    while (length && strchr("\"',", start[length - 1]))
        length--;
    *at = stop;
    if (!length || length >= sizeof word)
        return false;
    memcpy(word, start, length);
    word[length] = '\0';
    return parse_word(word, value);
}

/* Whether a word at a place is meant as a number, well formed or not. */
static bool looks_like_number(const char *at, const char *end)
{
    double value;
    const char *word = at;
    while (at < end && strchr("\"'[(+-.", *at))
        at++;
    return (at < end && is_digit(*at)) || read_number(&word, end, true, &value);
}

/* Exactly n numbers from a place on, up to the end of the line or of the bracket. */
static bool read_list(const char *at, const char *end, size_t n, double *values)
{
    double more;
    while (at < end && is_blank(*at))
        at++;
    bool bracket = at < end && (*at == '[' || *at == '(');
    if (bracket) /* which may go on over lines */
        end = at + strcspn(at, "])");
    for (size_t i = 0; i < n; i++) {
        at += strspn(at, " \t\r\n,;|");
        if (at >= end || !read_number(&at, end, n > 1, &values[i]))
            return false;
    }
    if (n == 1)
        return true;
    at += strspn(at, " \t\r\n,;|\"'");
    return at >= end || !read_number(&at, end, true, &more);
}

/* Behind a unit in brackets. What begins with a number and has no sign behind it is no unit but the
 * value: "df [1, 2]". */
static const char *skip_unit(const char *at, const char *end)
{
    const char *open = at;
    while (open < end && is_blank(*open))
        open++;
    if (open >= end || (*open != '[' && *open != '('))
        return at;
    const char *close = memchr(open, *open == '[' ? ']' : ')', (size_t)(end - open));
    if (!close)
        return at;
    const char *behind = close + 1;
    while (behind < end && is_blank(*behind))
        behind++;
    bool sign = behind < end && strchr("=:|", *behind);
    return sign || !looks_like_number(open, end) ? close + 1 : at;
}

/* Where the value of a key begins, or NULL if the line does not state it. behind: just after the
 * key. */
static const char *statement(const char *behind, const char *end)
{
    const char *at = behind;
    if (at < end && (*at == '"' || *at == '\''))
        at++;
    at = skip_unit(at, end);
    const char *signs = at;
    bool strong = false;
    while (at < end && (is_blank(*at) || strchr("=:|,", *at))) {
        strong = strong || strchr("=:|", *at);
        at++;
    }
    /* Else it is a longer word, or a heading. */
    bool stated = at > signs && at < end && (strong || looks_like_number(at, end));
    return stated ? at : NULL;
}

static int quoted(const char *line, const char *end)
{
    size_t length = (size_t)(end - line);
    while (length && is_blank(line[length - 1]))
        length--;
    return (int)(length < QUOTED ? length : QUOTED);
}

static bool same(size_t n, const double *a, const double *b)
{
    for (size_t i = 0; i < n; i++)
        if (a[i] != b[i] && !(isnan(a[i]) && isnan(b[i])))
            return false;
    return true;
}

/* The next statement of a key from *at on, which goes behind the key; NULL: no more. */
static const char *next_statement(const char **at, const char *text, const char *key,
                                  const char **line, const char **end)
{
    size_t length = strlen(key);
    for (const char *p = *at; (p = strstr(p, key)) != NULL; p += length) {
        if (p > text && !is_blank(p[-1]) && !strchr("|,;{([\"'", p[-1]))
            continue;
        for (*line = p; *line > text && (*line)[-1] != '\n';)
            --*line;
        *line += strspn(*line, " \t");
        *end = p + strcspn(p, "\n");
        const char *value = statement(p + length, *end);
        if (value) {
            *at = p + length;
            return value;
        }
    }
    return NULL;
}

bool result_find(const char *text, const char *key, enum result_match match, size_t n,
                 double *values, char *reason, size_t size)
{
    const char *at = text, *value, *line, *end, *first = NULL, *first_end = NULL;
    double *read = malloc((n ? n : 1) * sizeof *read);
    bool ok = read != NULL;
    snprintf(reason, size, "%s", ok ? "" : "out of memory");
    while (ok && (value = next_statement(&at, text, key, &line, &end)) != NULL) {
        if (first && match == RESULT_FIRST)
            break;
        bool good = read_list(value, end, n, read);
        /* Only the last of several matters when that is asked for. */
        if (good && first && match == RESULT_EQUAL && !same(n, read, values)) {
            snprintf(reason, size, "%s differs between '%.*s' and '%.*s'", key,
                     quoted(first, first_end), first, quoted(line, end), line);
            ok = false;
        } else if (good) {
            reason[0] = '\0';
            memcpy(values, read, n * sizeof *read);
        } else if (n == 1) {
            snprintf(reason, size, "no number after %s in '%.*s'", key, quoted(line, end), line);
        } else {
            snprintf(reason, size, "not %zu numbers after %s in '%.*s'", n, key, quoted(line, end),
                     line);
        }
        ok = ok && (good || match == RESULT_LAST);
        if (!first || match == RESULT_LAST) {
            first = line;
            first_end = end;
        }
    }
    free(read);
    if (ok && !first && n == 1)
        snprintf(reason, size, "no number after %s in the output", key);
    else if (ok && !first)
        snprintf(reason, size, "not %zu numbers after %s in the output", n, key);
    return !*reason;
}

const char *result_last_line(const char *text, size_t *length)
{
    const char *end = text + strlen(text);
    while (end > text && is_blank(end[-1]))
        end--;
    const char *line = end;
    while (line > text && line[-1] != '\n')
        line--;
    while (line < end && is_blank(*line))
        line++;
    *length = (size_t)(end - line);
    return line;
}

bool result_last(const char *text, double *value, char *reason, size_t size)
{
    size_t length;
    const char *line = result_last_line(text, &length), *end = line + length;
    const char *stop = end;
    while (stop > line && (is_blank(stop[-1]) || strchr("|]})\"'", stop[-1])))
        stop--;
    const char *word = stop;
    while (word > line && !is_blank(word[-1]) && !strchr("=:|[{(\"'", word[-1]))
        word--;
    if (word < stop && read_number(&word, stop, false, value) && word == stop)
        return true;
    if (length)
        snprintf(reason, size, "no number at the end of the last line, '%.*s'", quoted(line, end),
                 line);
    else
        snprintf(reason, size, "no number: the output is empty");
    return false;
}
