/* IGES files made by the tests, entity by entity. */
#ifndef TESTS_IGES_WRITER_H
#define TESTS_IGES_WRITER_H

#include "check.h"

#include <stdarg.h>
#include <string.h>
#include <unistd.h>

enum { IGES_MOST = 200, IGES_TEXT = 700 };

typedef struct iges_writer {
    size_t count;
    struct {
        int type, form, status, transformation;
        char text[IGES_TEXT];
    } entity[IGES_MOST];
} iges_writer;

/* Directory number of the entity that is added next. */
static inline int iges_next(const iges_writer *w)
{
    return 2 * (int)w->count + 1;
}

/* Adds an entity and returns its directory number; status as the eight digits of the file. */
__attribute__((format(printf, 6, 7))) static inline int iges_add(iges_writer *w, int type, int form,
                                                                 int status, int transformation,
                                                                 const char *format, ...)
{
    int number = iges_next(w);
    CU_ASSERT_TRUE_FATAL(w->count < IGES_MOST);
    w->entity[w->count].type = type;
    w->entity[w->count].form = form;
    w->entity[w->count].status = status;
    w->entity[w->count].transformation = transformation;
    va_list args;
    va_start(args, format);
    vsnprintf(w->entity[w->count++].text, IGES_TEXT, format, args);
    va_end(args);
    return number;
}

/* Records of 64 columns, broken behind commas. */
static inline int iges_lines(FILE *stream, const char *text, int number, int line)
{
    for (const char *at = text; *at; line++) {
        size_t n = strlen(at);
        if (n > 64)
            for (n = 64; n > 1 && at[n - 1] != ','; n--)
                ;
        if (stream)
            fprintf(stream, "%-64.*s%8d%c%7d\n", (int)n, at, number, 'P', line);
        at += n;
    }
    return line;
}

/* `unit` is the pair of global fields, "6,1HM" or "2,2HMM". The path is scratch: unlink it. */
static inline const char *iges_save(const iges_writer *w, const char *unit)
{
    static char path[512];
    char global[80];
    int line = 1;
    snprintf(path, sizeof path, "%s/iges_writer_%ld.igs", check_scratch(), (long)getpid());
    FILE *stream = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    fprintf(stream, "%-72s%c%7d\n", "Made by a test of libnurbs.", 'S', 1);
    fprintf(stream, "%-72s%c%7d\n",
            "1H,,1H;,4Htest,8Htest.igs,4Htest,4Htest,32,38,6,308,15,4Htest,", 'G', 1);
    snprintf(global, sizeof global, "1.0,%s,1,0.01,15H20240101.000000,1E-7,10.0,4Hnone,4Hnone,",
             unit);
    fprintf(stream, "%-72s%c%7d\n", global, 'G', 2);
    fprintf(stream, "%-72s%c%7d\n", "11,0,15H20240101.000000;", 'G', 3);
    for (size_t k = 0; k < w->count; k++) {
        int next = iges_lines(NULL, w->entity[k].text, 0, line);
        fprintf(stream, "%8d%8d%8d%8d%8d%8d%8d%8d%08dD%7d\n", w->entity[k].type, line, 0, 0, 0, 0,
                w->entity[k].transformation, 0, w->entity[k].status, 2 * (int)k + 1);
        fprintf(stream, "%8d%8d%8d%8d%8d%8s%8s%8s%8dD%7d\n", w->entity[k].type, 0, 0, next - line,
                w->entity[k].form, "", "", "", 0, 2 * (int)k + 2);
        line = next;
    }
    int last = line - 1;
    line = 1;
    for (size_t k = 0; k < w->count; k++)
        line = iges_lines(stream, w->entity[k].text, 2 * (int)k + 1, line);
    fprintf(stream, "S%7dG%7dD%7d%c%7d%-40s%c%7d\n", 1, 3, 2 * (int)w->count, 'P', last, "", 'T',
            1);
    fclose(stream);
    return path;
}

#endif
