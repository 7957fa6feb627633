#include "fields.h"

#include <ctype.h>
#include <string.h>

/* Length of what stands between the braces at text[0], if they close on the same line. */
static bool in_braces(const char *text, size_t left, size_t *length)
{
    const char *close = memchr(text, '}', left), *line = memchr(text, '\n', left);
    *length = close ? (size_t)(close - text) - 1 : 0;
    return close && (!line || close < line);
}

static bool is_word(const char *text, size_t length)
{
    bool word = length > 0 && (isalpha((unsigned char)*text) || *text == '_');
    for (size_t i = 0; i < length && word; i++)
        word = isalnum((unsigned char)text[i]) || strchr("_.-", text[i]);
    return word;
}

void fields_write(const char *text, size_t length, fields_value value, void *user_data, FILE *out)
{
    for (size_t i = 0; i < length; i++) {
        size_t inside;
        if (text[i] == '{' && i + 1 < length && text[i + 1] == '{')
            fputc(text[++i], out);
        else if (text[i] == '{' && in_braces(text + i, length - i, &inside) &&
                 value(user_data, text + i + 1, inside, out))
            i += inside + 1;
        else
            fputc(text[i], out);
    }
}

const char *fields_unknown(const char *text, size_t length, fields_value value, void *user_data,
                           size_t *field)
{
    for (size_t i = 0; i < length; i++) {
        size_t inside;
        if (text[i] == '{' && i + 1 < length && text[i + 1] == '{') {
            i++;
        } else if (text[i] == '{' && (i == 0 || text[i - 1] != '$') &&
                   in_braces(text + i, length - i, &inside) && is_word(text + i + 1, inside) &&
                   !value(user_data, text + i + 1, inside, NULL)) {
            *field = inside + 2;
            return text + i;
        }
    }
    return NULL;
}
