#include "cli.h"
#include "reduce.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: galv reduce --hull GRID.csv --shape SHAPE.yaml (--samples X.csv | --random N) "
    "[OPTION]...\n"
    "\n"
    "Samples the modification on the points of the grid and finds the directions of greatest\n"
    "geometric variance.\n"
    "\n"
    "  --hull FILE        grid of points, CSV with the columns x,y,z and perhaps i,j, metres\n"
    "  --shape FILE       the modification, YAML\n"
    "  --samples FILE     parameter vectors, CSV with one column per parameter, in order\n"
    "  --random N         N uniform draws within the bounds of the modification instead\n"
    "  --seed S           of the uniform draws and of the randomised method (default 1)\n"
    "  --variance V       share of the variance to retain, in (0, 1] (default 0.95)\n"
    "  --modes M          keep M modes instead\n"
    "  --spectrum K       report at least K eigenvalues (default 64)\n"
    "  --centre           subtract the mean of the samples\n"
    "  --weights KIND     equal (default), or area: of the cells around each grid point\n"
    "  --method NAME      auto (default), covariance, gram or randomised\n"
    "  --workspace MIB    memory for matrices and blocks of samples (default 512)\n"
    "  --threads N        threads (default: as the environment says)\n"
    "  --json             print one JSON object\n";

enum {
    HULL = 256,
    SHAPE,
    SAMPLES,
    RANDOM,
    SEED,
    VARIANCE,
    MODES,
    SPECTRUM,
    CENTRE,
    WEIGHTS,
    METHOD,
    WORKSPACE,
    THREADS,
    JSON,
    HELP,
    VERSION
};

static const struct option table[] = {
    {"hull", required_argument, NULL, HULL},
    {"shape", required_argument, NULL, SHAPE},
    {"samples", required_argument, NULL, SAMPLES},
    {"random", required_argument, NULL, RANDOM},
    {"seed", required_argument, NULL, SEED},
    {"variance", required_argument, NULL, VARIANCE},
    {"modes", required_argument, NULL, MODES},
    {"spectrum", required_argument, NULL, SPECTRUM},
    {"centre", no_argument, NULL, CENTRE},
    {"weights", required_argument, NULL, WEIGHTS},
    {"method", required_argument, NULL, METHOD},
    {"workspace", required_argument, NULL, WORKSPACE},
    {"threads", required_argument, NULL, THREADS},
    {"json", no_argument, NULL, JSON},
    {"help", no_argument, NULL, HELP},
    {"version", no_argument, NULL, VERSION},
    {NULL, 0, NULL, 0},
};

static int parse_count(const char *option, size_t *out, size_t least, size_t most)
{
    size_t value;
    if (!cli_parse_size(optarg, &value) || value < least || value > most)
        return cli_usage("--%s '%s': expected a whole number from %zu to %zu", option, optarg,
                         least, most);
    *out = value;
    return -1;
}

static int parse_method(galv_method *method)
{
    static const char *const names[] = {"auto", "covariance", "gram", "randomised"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(optarg, names[i]) == 0) {
            *method = (galv_method)i;
            return -1;
        }
    return cli_usage("--method '%s': expected auto, covariance, gram or randomised", optarg);
}

static int parse_weights(bool *area)
{
    *area = strcmp(optarg, "area") == 0;
    if (*area || strcmp(optarg, "equal") == 0)
        return -1;
    return cli_usage("--weights '%s': expected equal or area", optarg);
}

static int parse_variance(double *variance)
{
    if (!cli_parse_double(optarg, variance) || !(*variance > 0 && *variance <= 1))
        return cli_usage("--variance '%s': expected a number above 0, at most 1", optarg);
    return -1;
}

static int parse_option(int code, struct reduce_options *options)
{
    size_t value = 0;
    int result = -1;
    switch (code) {
    case HULL:
        options->hull = optarg;
        return -1;
    case SHAPE:
        options->shape = optarg;
        return -1;
    case SAMPLES:
        options->samples = optarg;
        return -1;
    case RANDOM:
        return parse_count("random", &options->random, 1, 1000000000);
    case SEED:
        if ((result = parse_count("seed", &value, 0, SIZE_MAX)) == -1)
            options->seed = options->build.seed = value;
        return result;
    case VARIANCE:
        return parse_variance(&options->build.variance);
    case MODES:
        return parse_count("modes", &options->build.modes, 1, 1000000);
    case SPECTRUM:
        return parse_count("spectrum", &options->build.spectrum, 1, 1000000);
    case CENTRE:
        options->build.centre = true;
        return -1;
    case WEIGHTS:
        return parse_weights(&options->area_weights);
    case METHOD:
        return parse_method(&options->build.method);
    case WORKSPACE:
        if ((result = parse_count("workspace", &value, 1, 1 << 24)) == -1)
            options->build.workspace = value << 20;
        return result;
    case THREADS:
        if ((result = parse_count("threads", &value, 1, 4096)) == -1)
            options->threads = (int)value;
        return result;
    case JSON:
        options->json = true;
        return -1;
    case HELP:
        return cli_print(help);
    case VERSION:
        return cli_version();
    default:
        return cli_usage("unknown or incomplete option");
    }
}

int reduce_parse(int argc, char **argv, struct reduce_options *options)
{
    *options = (struct reduce_options){.seed = 1};
    galv_options_init(&options->build);
    opterr = 0;
    for (int code; (code = getopt_long(argc, argv, "", table, NULL)) != -1;) {
        if (code == '?')
            return cli_usage("unknown or incomplete option '%s'", argv[optind - 1]);
        int result = parse_option(code, options);
        if (result != -1)
            return result;
    }
    if (optind < argc)
        return cli_usage("unexpected argument '%s'", argv[optind]);
    if (!options->hull || !options->shape)
        return cli_usage("--hull and --shape are required");
    if (!options->samples == !options->random)
        return cli_usage("give either --samples or --random");
    return -1;
}
