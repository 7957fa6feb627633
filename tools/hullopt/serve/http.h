/* HTTP for the protocol: as many connections and as long requests as are stated here, no more. */
#ifndef HULLOPT_HTTP_H
#define HULLOPT_HTTP_H

#include "serve/protocol.h"

#include <stdint.h>

enum {
    HTTP_CONNECTIONS = 64,   /* at once; later ones are closed */
    HTTP_BODY = 1024 * 1024, /* bytes of a request */
    HTTP_SECONDS = 60        /* that a caller may be silent */
};

struct http;

/* Serves models at an IPv4 address and port; port 0 is any that is free. Borrows the models. NULL
 * with a sentence[SERVED_SENTENCE] when the address cannot be had. */
struct http *http_start(const char *address, uint16_t port, size_t n, const struct served *models,
                        char *sentence);
uint16_t http_port(const struct http *http);
/* Waits for the requests being answered. */
void http_stop(struct http *http);

#endif
