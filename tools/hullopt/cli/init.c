#include "cli.h"
#include "cli/commands.h"

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

static bool write_template(const struct config *config, const char *path)
{
    struct cli_file file;
    if (!path) {
        settings_template(&CONFIG, config, stdout);
        return cli_printed() == CLI_OK;
    }
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
    ok = ok && write_template(&config, options->out);
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}
