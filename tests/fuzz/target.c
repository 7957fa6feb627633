#include "target.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static char file[4096];

static const struct reader *chosen(void)
{
    const char *name = getenv("FUZZ_READER");
    for (const struct reader *r = READERS; name && r->name; r++)
        if (strcmp(r->name, name) == 0)
            return r;
    fprintf(stderr, "FUZZ_READER is one of");
    for (const struct reader *r = READERS; r->name; r++)
        fprintf(stderr, " %s", r->name);
    fprintf(stderr, "\n");
    exit(2);
}

static void forget(void)
{
    unlink(file);
}

void demand(bool holds, const char *promise)
{
    if (holds)
        return;
    fprintf(stderr, "broken: %s\n", promise);
    abort();
}

void demand_finite(size_t n, const double *values, const char *what)
{
    for (size_t i = 0; values && i < n; i++)
        demand(isfinite(values[i]), what);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    static const struct reader *reader;
    if (!reader) {
        const char *folder = getenv("TMPDIR");
        reader = chosen();
        snprintf(file, sizeof file, "%s/fuzz_%ld%s", folder ? folder : "/tmp", (long)getpid(),
                 reader->extension ? reader->extension : "");
        atexit(forget);
    }
    if (reader->extension) {
        FILE *stream = fopen(file, "wb");
        demand(stream && fwrite(bytes, 1, n, stream) == n && fclose(stream) == 0,
               "the input can be written");
    }
    reader->read(file, n, bytes);
    return 0;
}

#ifndef WITH_LIBFUZZER
int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        FILE *stream = fopen(argv[i], "rb");
        uint8_t *bytes = NULL;
        size_t n = 0, room = 0, got = 1;
        while (stream && got) {
            room = n + 65536;
            bytes = realloc(bytes, room);
            demand(bytes != NULL, "there is memory");
            got = fread(bytes + n, 1, room - n, stream);
            n += got;
        }
        if (!stream || ferror(stream)) {
            perror(argv[i]);
            return 2;
        }
        fclose(stream);
        LLVMFuzzerTestOneInput(bytes, n);
        free(bytes);
        printf("%s: answered\n", argv[i]);
    }
    return 0;
}
#endif
