/* Text files: read whole, written beside the target and renamed onto it, numbers always with a
 * decimal point whatever the locale of the program. */
#ifndef NURBS_TEXTFILE_H
#define NURBS_TEXTFILE_H

#include <nurbs/status.h>

#include <locale.h>
#include <stdio.h>

/* The thread's numeric locale set to "C" until restored. */
typedef struct numeric_locale {
    locale_t plain, before;
} numeric_locale;
void numeric_locale_set(numeric_locale *scope);
void numeric_locale_restore(numeric_locale *scope);

/* Fills *text with the whole file, without a byte order mark, and a terminating zero (caller frees)
 * and *length. Refuses what is too large to be a hull. */
nurbs_status textfile_read(const char *path, char **text, size_t *length);

/* Written beside PATH, or beside what the link PATH leads to; a device or FIFO is written as it is.
 */
typedef struct outfile {
    FILE *stream;
    char *path, *temporary;
    numeric_locale locale;
} outfile;
nurbs_status outfile_open(outfile *file, const char *path);
/* Makes the file appear, or removes every trace of it and tells why. */
nurbs_status outfile_commit(outfile *file);
void outfile_abandon(outfile *file);

#endif
