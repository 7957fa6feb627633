#include "cli.h"
#include "reduce.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: galv reduce --hull HULL --shape SHAPE.yaml (--samples X.csv | --random N) "
    "[OPTION]...\n"
    "\n"
    "Samples the modification on the points of the grid and finds the directions of greatest\n"
    "geometric variance.\n"
    "\n"
    "  --hull FILE        grid of points, CSV with the columns x,y,z and perhaps i,j, metres; or "
    "a\n"
    "                     NURBS hull, JSON, sampled at its design grid\n"
    "  --grid SxG         sections x girth points to sample a NURBS hull at instead\n"
    "  --shape FILE       the modification, YAML\n"
    "  --samples FILE     parameter vectors, CSV with one column per parameter, in order\n"
    "  --random N         N uniform draws within the bounds of the modification instead\n"
    "  --seed S           of the uniform draws and of the randomised method (default 1)\n"
    "  --variance V       share of the variance to retain, in (0, 1] (default 0.95)\n"
    "  --modes M          keep M modes instead\n"
    "  --spectrum K       report at least K eigenvalues (default 64)\n"
    "  --centre           subtract the mean of the samples\n"
    "  --weights KIND     equal (default), or area: of the cells around each grid point\n"
    "  --moments ORDER    append the geometric moments of the hull up to ORDER (0: volume)\n"
    "  --section-moments ORDER:FIRST:STRIDE\n"
    "                     append those of sections FIRST (1 is the first), FIRST + STRIDE, ... "
    "too\n"
    "  --rows FILE        append other quantities, CSV with one line per sample and one column "
    "per\n"
    "                     quantity, as changes from the parent\n"
    "  --moment-share W   variance of all that is appended relative to that of the points "
    "(default\n"
    "                     0.5); each quantity is given the same part of it\n"
    "  --method NAME      auto (default), covariance, gram, randomised or factored (linear "
    "shapes)\n"
    "  --workspace MIB    memory for matrices and blocks of samples (default 512)\n"
    "  -o, --output FILE  write the model, HDF5\n"
    "  --threads N        threads (default: as the environment says)\n"
    "  --json             print one JSON object\n";

enum {
    HULL = 256,
    GRID,
    MOMENTS,
    SECTION_MOMENTS,
    ROWS,
    SHARE,
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
    {"grid", required_argument, NULL, GRID},
    {"moments", required_argument, NULL, MOMENTS},
    {"section-moments", required_argument, NULL, SECTION_MOMENTS},
    {"rows", required_argument, NULL, ROWS},
    {"moment-share", required_argument, NULL, SHARE},
    {"output", required_argument, NULL, 'o'},
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
    static const char *const names[] = {"auto", "covariance", "gram", "randomised", "factored"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(optarg, names[i]) == 0) {
            *method = (galv_method)i;
            return -1;
        }
    return cli_usage("--method '%s': expected auto, covariance, gram, randomised or "
                     "factored",
                     optarg);
}

static int parse_weights(bool *area)
{
    *area = strcmp(optarg, "area") == 0;
    if (*area || strcmp(optarg, "equal") == 0)
        return -1;
    return cli_usage("--weights '%s': expected equal or area", optarg);
}

static int parse_grid(struct reduce_options *options)
{
    char *cross = strchr(optarg, 'x');
    if (cross) {
        *cross = '\0';
        bool ok = cli_parse_size(optarg, &options->sections) &&
                  cli_parse_size(cross + 1, &options->girth);
        *cross = 'x';
        if (ok && options->sections >= 2 && options->girth >= 2 && options->sections <= 100000 &&
            options->girth <= 100000)
            return -1;
    }
    return cli_usage("--grid '%s': expected SECTIONSxGIRTH, such as 90x25", optarg);
}

static int parse_share(double *share)
{
    if (!cli_parse_double(optarg, share) || !(*share > 0))
        return cli_usage("--moment-share '%s': expected a number above 0", optarg);
    return -1;
}

/* Whole numbers divided by colons; cuts the argument up. */
static int parse_section_moments(galv_moment_set *set)
{
    size_t part[3] = {0, 0, 0}, n = 0;
    char *state = NULL;
    for (char *word = strtok_r(optarg, ":", &state); word; word = strtok_r(NULL, ":", &state))
        if (n >= 3 || !cli_parse_size(word, &part[n++]))
            n = 4;
    if (n != 3 || part[0] > 8 || part[1] < 1 || part[2] < 1)
        return cli_usage("--section-moments: expected ORDER:FIRST:STRIDE, such as 1:5:10, ORDER at "
                         "most 8");
    set->section_order = (unsigned)part[0];
    set->section_first = part[1] - 1;
    set->section_stride = part[2];
    return -1;
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
    case GRID:
        return parse_grid(options);
    case MOMENTS:
        options->moments = true;
        if ((result = parse_count("moments", &value, 0, 8)) == -1)
            options->set.order = (unsigned)value;
        return result;
    case SECTION_MOMENTS:
        options->moments = true;
        return parse_section_moments(&options->set);
    case ROWS:
        options->rows = optarg;
        return -1;
    case SHARE:
        return parse_share(&options->share);
    case 'o':
        options->output = optarg;
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
    *options = (struct reduce_options){.seed = 1, .share = 0.5};
    galv_options_init(&options->build);
    opterr = 0;
    for (int code; (code = getopt_long(argc, argv, "o:", table, NULL)) != -1;) {
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
