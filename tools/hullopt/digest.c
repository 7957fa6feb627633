#include "digest.h"

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>

bool digest_file(const char *path, char digest[DIGEST_SIZE])
{
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return false;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    unsigned char block[65536];
    size_t n;
    while ((n = fread(block, 1, sizeof block, stream)) > 0)
        for (size_t i = 0; i < n; i++)
            hash = (hash ^ block[i]) * UINT64_C(0x100000001b3);
    bool ok = !ferror(stream);
    fclose(stream);
    snprintf(digest, DIGEST_SIZE, "%016" PRIx64, hash);
    return ok;
}
