/* A short fingerprint of a file's bytes: says that an input is the one of an earlier session, not
 * that nobody forged it. */
#ifndef HULLOPT_DIGEST_H
#define HULLOPT_DIGEST_H

#include <stdbool.h>

enum { DIGEST_SIZE = 17 };

/* FNV-1a, 64 bits, as hexadecimal text. false with errno when the file cannot be read. */
bool digest_file(const char *path, char digest[DIGEST_SIZE]);

#endif
