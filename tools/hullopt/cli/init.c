#include "cli.h"
#include "cli/commands.h"
#include "json_result.h"
#include "text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Names in a file are relative to its folder: one of here, for a file that may be elsewhere. */
static char *name_from(const char *file, const char *path)
{
    char here[4096] = "", name[8192];
    bool elsewhere = file && strchr(file, '/') && *path != '/' && getcwd(here, sizeof here);
    snprintf(name, sizeof name, "%s%s%s", here, elsewhere ? "/" : "", path);
    return strdup(name);
}

/* The text itself, or where it is. */
static bool print_json(const struct config *config, const char *path)
{
    char *text = NULL;
    size_t size;
    FILE *out = path ? NULL : text_open(&text, &size);
    if (out)
        settings_template(&CONFIG, config, out);
    bool ok = path || (out && text_close(out, &text)) || cli_refuse("out of memory");
    ok = ok && json_result_print(json_pack("{s:s}", path ? "file" : "text", path ? path : text),
                                 JSON_INDENT(2)) == CLI_OK;
    free(text);
    return ok;
}

static bool print_template(const struct config *config)
{
    settings_template(&CONFIG, config, stdout);
    return cli_printed() == CLI_OK;
}

static bool write_template(const struct config *config, const char *path)
{
    struct cli_file file;
    if (access(path, F_OK) == 0)
        return cli_refuse("%s exists; remove it or choose another name", path);
    if (!cli_file_open(&file, path))
        return cli_refuse("%s: cannot be written: %s", path, strerror(errno));
    settings_template(&CONFIG, config, file.stream);
    return cli_file_commit(&file) || cli_refuse("%s: cannot be written: %s", path, strerror(errno));
}

int init_command(const struct options *options)
{
    struct config config = {.path = NULL};
    igabem_options_init(&config.solver);
    settings_start(&CONFIG, &config);
    config.hull = name_from(options->out, options->path ? options->path : "hull.json");
    config.shape = name_from(options->out, options->shape ? options->shape : "shape.yaml");
    config.solver.froude = options->froude;
    bool ok = (config.hull && config.shape) || cli_refuse("out of memory");
    ok = ok && (!options->out || write_template(&config, options->out)) &&
         (options->json   ? print_json(&config, options->out)
          : !options->out ? print_template(&config)
                          : true);
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}
