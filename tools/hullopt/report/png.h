/* A picture of palette colours as a data URI, so that a raster can stand inside an SVG. */
#ifndef HULLOPT_PNG_H
#define HULLOPT_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Writes "data:image/png;base64,..." of width x height indices, rows from the top, into a palette
 * of 256 colours. Pixels are stored uncompressed. */
bool png_data_uri(FILE *out, size_t width, size_t height, const unsigned char *pixels,
                  const unsigned char palette[256][3]);

#endif
