#include "serve/http.h"

#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>

struct http {
    struct MHD_Daemon *daemon;
    size_t n;
    const struct served *models;
};

/* The body of a request as it arrives. */
struct upload {
    char *bytes;
    size_t size;
    bool is_long;
};

static void forget(void *user_data, struct MHD_Connection *connection, void **context,
                   enum MHD_RequestTerminationCode why)
{
    struct upload *upload = *context;
    (void)user_data, (void)connection, (void)why;
    if (upload)
        free(upload->bytes);
    free(upload);
}

/* False when there is no memory. Of a body that is too long the rest is read and thrown away: the
 * caller then hears why. */
static bool receive(struct upload *upload, const char *data, size_t size)
{
    upload->is_long = upload->is_long || size > HTTP_BODY - upload->size;
    if (upload->is_long)
        return true;
    char *bytes = realloc(upload->bytes, upload->size + size);
    if (!bytes)
        return false;
    memcpy(bytes + upload->size, data, size);
    upload->bytes = bytes;
    upload->size += size;
    return true;
}

/* The text is taken. */
static enum MHD_Result respond(struct MHD_Connection *connection, unsigned status, char *text)
{
    static char none[] = "{\"error\":{\"type\":\"InvalidOutput\",\"message\":\"out of memory\"}}";
    struct MHD_Response *response =
        text ? MHD_create_response_from_buffer(strlen(text), text, MHD_RESPMEM_MUST_FREE)
             : MHD_create_response_from_buffer(sizeof none - 1, none, MHD_RESPMEM_PERSISTENT);
    if (!response) {
        free(text);
        return MHD_NO;
    }
    enum MHD_Result result = MHD_NO;
    if (MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, "application/json") ==
        MHD_YES)
        result = MHD_queue_response(connection, status, response);
    MHD_destroy_response(response);
    return result;
}

static enum MHD_Result answer(const struct http *http, struct MHD_Connection *connection,
                              const char *method, const char *path, const struct upload *upload)
{
    char *text;
    unsigned status;
    if (upload->is_long)
        status =
            protocol_refuse(MHD_HTTP_CONTENT_TOO_LARGE, "the request is longer than 1 MiB", &text);
    else
        status = protocol_answer(http->n, http->models, method, path, upload->size,
                                 upload->bytes ? upload->bytes : "", &text);
    return respond(connection, status, text);
}

/* Called for the head of a request, each part of its body, and its end. */
static enum MHD_Result handle(void *user_data, struct MHD_Connection *connection, const char *path,
                              const char *method, const char *version, const char *data,
                              size_t *size, void **context)
{
    (void)version;
    struct upload *upload = *context;
    if (!upload) {
        *context = calloc(1, sizeof *upload);
        return *context ? MHD_YES : MHD_NO;
    }
    if (*size == 0)
        return answer(user_data, connection, method, path, upload);
    bool ok = receive(upload, data, *size);
    *size = 0;
    return ok ? MHD_YES : MHD_NO;
}

struct http *http_start(const char *address, uint16_t port, size_t n, const struct served *models,
                        char *sentence)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons(port)};
    struct http *http = malloc(sizeof *http);
    if (!http) {
        snprintf(sentence, SERVED_SENTENCE, "out of memory");
        return NULL;
    }
    *http = (struct http){.n = n, .models = models};
    if (inet_pton(AF_INET, address, &at.sin_addr) != 1) {
        snprintf(sentence, SERVED_SENTENCE, "'%s' is no IPv4 address such as 127.0.0.1", address);
        free(http);
        return NULL;
    }
    errno = 0;
    http->daemon = MHD_start_daemon(MHD_USE_AUTO_INTERNAL_THREAD | MHD_USE_THREAD_PER_CONNECTION,
                                    port, NULL, NULL, handle, http, MHD_OPTION_SOCK_ADDR, &at,
                                    MHD_OPTION_CONNECTION_LIMIT, (unsigned)HTTP_CONNECTIONS,
                                    MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)HTTP_SECONDS,
                                    MHD_OPTION_NOTIFY_COMPLETED, forget, NULL, MHD_OPTION_END);
    if (!http->daemon) {
        snprintf(sentence, SERVED_SENTENCE, "port %u of %s: %s", port, address,
                 errno ? strerror(errno) : "cannot be had");
        free(http);
        return NULL;
    }
    return http;
}

uint16_t http_port(const struct http *http)
{
    const union MHD_DaemonInfo *info = MHD_get_daemon_info(http->daemon, MHD_DAEMON_INFO_BIND_PORT);
    return info ? info->port : 0;
}

void http_stop(struct http *http)
{
    if (http)
        MHD_stop_daemon(http->daemon);
    free(http);
}
