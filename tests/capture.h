/* Runs code with stderr in a file, to read the sentence that a failure prints. */
#ifndef TESTS_CAPTURE_H
#define TESTS_CAPTURE_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct capture {
    FILE *file;
    int saved;
};

static inline void capture_begin(struct capture *capture)
{
    capture->file = tmpfile();
    fflush(stderr);
    capture->saved = dup(STDERR_FILENO);
    dup2(fileno(capture->file), STDERR_FILENO);
}

/* Fills text with what was printed, as a string. */
static inline void capture_end(struct capture *capture, char *text, size_t size)
{
    fflush(stderr);
    dup2(capture->saved, STDERR_FILENO);
    close(capture->saved);
    rewind(capture->file);
    size_t n = fread(text, 1, size - 1, capture->file);
    text[n] = '\0';
    fclose(capture->file);
}

/* One sentence: exactly one line. */
static inline int capture_is_sentence(const char *text)
{
    const char *end = strchr(text, '\n');
    return end && end[1] == '\0' && end - text > 10;
}

#endif
