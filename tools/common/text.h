/* A stream that writes into memory. */
#ifndef TOOLS_TEXT_H
#define TOOLS_TEXT_H

#include <stddef.h>
#include <stdio.h>

/* As open_memstream(), whose stream in glibc loses what it has no memory for without a word:
 * ferror() tells it here. NULL: out of memory. */
FILE *text_open(char **text, size_t *length);

/* Closes the stream: the text, to be freed by the caller. NULL, and *text freed: it is not whole.
 */
char *text_close(FILE *stream, char **text);

#endif
