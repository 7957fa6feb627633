/* Named numbers and texts. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const bayesopt_attribute *find(size_t n, const bayesopt_attribute *attributes,
                                      const char *name)
{
    for (size_t i = 0; attributes && name && i < n; i++)
        if (strcmp(attributes[i].name, name) == 0)
            return &attributes[i];
    return NULL;
}

double bayesopt_attribute_number(size_t n, const bayesopt_attribute *attributes, const char *name)
{
    const bayesopt_attribute *found = find(n, attributes, name);
    return found && !found->text ? found->number : NAN;
}

const char *bayesopt_attribute_text(size_t n, const bayesopt_attribute *attributes,
                                    const char *name)
{
    const bayesopt_attribute *found = find(n, attributes, name);
    return found && found->text ? found->text : "";
}

bayesopt_status attributes_check(size_t n, const bayesopt_attribute *attributes)
{
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    if (n && !attributes)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu attributes, but their list is NULL", n);
    for (size_t i = 0; i < n; i++) {
        if (!attributes[i].name || !*attributes[i].name)
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "attribute %zu has no name", i);
        if (find(i, attributes, attributes[i].name))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "two attributes are called '%s'",
                                 attributes[i].name);
    }
    return BAYESOPT_OK;
}

bool attributes_append(struct attributes *list, const bayesopt_attribute *a)
{
    bayesopt_attribute *more = realloc(list->items, (list->n + 1) * sizeof *more);
    if (!more)
        return false;
    list->items = more;
    char *name = strdup(a->name), *text = a->text ? strdup(a->text) : NULL;
    if (!name || (a->text && !text)) {
        free(name);
        free(text);
        return false;
    }
    more[list->n++] =
        (bayesopt_attribute){.name = name, .number = text ? NAN : a->number, .text = text};
    return true;
}

bool attributes_copy(struct attributes *list, size_t n, const bayesopt_attribute *from)
{
    for (size_t i = 0; i < n; i++)
        if (!attributes_append(list, &from[i]))
            return false;
    return true;
}

void attributes_free(struct attributes *list)
{
    for (size_t i = 0; i < list->n; i++) {
        free((char *)list->items[i].name);
        free((char *)list->items[i].text);
    }
    free(list->items);
    *list = (struct attributes){0};
}
