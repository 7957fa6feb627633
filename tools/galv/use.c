#include "use.h"

#include "cli.h"

#include <getopt.h>
#include <stdint.h>
#include <string.h>

enum {
    HULL = 256,
    PARAMETERS,
    LATENT,
    MODES,
    FRAMES,
    SCALE,
    RANDOM,
    SEED,
    SAMPLES,
    VARIANCE,
    THREADS,
    JSON,
    HELP,
    VERSION
};

static const struct option table[] = {
    {"hull", required_argument, NULL, HULL},
    {"parameters", required_argument, NULL, PARAMETERS},
    {"latent", required_argument, NULL, LATENT},
    {"output", required_argument, NULL, 'o'},
    {"modes", required_argument, NULL, MODES},
    {"frames", required_argument, NULL, FRAMES},
    {"scale", required_argument, NULL, SCALE},
    {"random", required_argument, NULL, RANDOM},
    {"seed", required_argument, NULL, SEED},
    {"samples", required_argument, NULL, SAMPLES},
    {"variance", required_argument, NULL, VARIANCE},
    {"threads", required_argument, NULL, THREADS},
    {"json", no_argument, NULL, JSON},
    {"help", no_argument, NULL, HELP},
    {"version", no_argument, NULL, VERSION},
    {NULL, 0, NULL, 0},
};

static unsigned option_bit(int code)
{
    switch (code) {
    case HULL:
        return USE_HULL;
    case PARAMETERS:
        return USE_PARAMETERS;
    case LATENT:
        return USE_LATENT;
    case 'o':
        return USE_OUTPUT;
    case MODES:
        return USE_MODES;
    case FRAMES:
    case SCALE:
        return USE_FRAMES;
    case RANDOM:
    case SEED:
    case SAMPLES:
    case VARIANCE:
        return USE_SAMPLES;
    default:
        return 0;
    }
}

static int set_number(int code, struct use *use)
{
    size_t value = 0;
    if (code == SCALE)
        return cli_parse_double(optarg, &use->scale) && use->scale > 0
                   ? -1
                   : cli_usage("--scale '%s': expected a number above 0", optarg);
    if (code == VARIANCE)
        return cli_parse_double(optarg, &use->variance) && use->variance > 0 && use->variance <= 1
                   ? -1
                   : cli_usage("--variance '%s': expected a number above 0, at most 1", optarg);
    size_t least = code == SEED ? 0 : 1;
    size_t most = code == SEED      ? SIZE_MAX
                  : code == RANDOM  ? 1000000000
                  : code == THREADS ? 4096
                                    : 1000;
    if (!cli_parse_size(optarg, &value) || value < least || value > most)
        return cli_usage("'%s': expected a whole number from %zu to %zu", optarg, least, most);
    if (code == THREADS)
        cli_set_threads((int)value);
    else
        *(code == MODES    ? &use->modes
          : code == FRAMES ? &use->frames
          : code == SEED   ? &use->seed
                           : &use->random) = value;
    use->seed_given = use->seed_given || code == SEED;
    return -1;
}

static int set_option(int code, const char *help, struct use *use)
{
    switch (code) {
    case HULL:
        use->hull = optarg;
        return -1;
    case PARAMETERS:
        use->parameters = optarg;
        return -1;
    case LATENT:
        use->latent = optarg;
        return -1;
    case 'o':
        use->output = optarg;
        return -1;
    case SAMPLES:
        use->samples = optarg;
        return -1;
    case JSON:
        use->json = true;
        return -1;
    case HELP:
        return cli_print(help);
    case VERSION:
        return cli_version();
    default:
        return set_number(code, use);
    }
}

int use_start(int argc, char **argv, const char *help, unsigned allowed, struct use *use)
{
    *use = (struct use){.scale = 1};
    opterr = 0;
    for (int code; (code = getopt_long(argc, argv, "o:", table, NULL)) != -1;) {
        if (code == '?')
            return cli_usage("unknown or incomplete option '%s'", argv[optind - 1]);
        if (option_bit(code) & ~allowed)
            return cli_usage("this command takes no such option: '%s'", argv[optind - 1]);
        int result = set_option(code, help, use);
        if (result != -1)
            return result;
    }
    if (optind >= argc)
        return cli_usage("a model file is missing");
    if (optind + 1 < argc)
        return cli_usage("unexpected argument '%s'", argv[optind + 1]);
    return model_file_read(argv[optind], &use->file) ? -1 : CLI_FAILED;
}

void use_free(struct use *use)
{
    model_file_free(&use->file);
}
