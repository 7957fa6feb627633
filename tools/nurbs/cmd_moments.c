#include "json_result.h"
#include "nurbs_tool.h"

static void print_line(const char *name, const char *unit, double value, double error)
{
    printf("  %-7s %20.12g  +- %.1e %s\n", name, value, error, unit);
}

static void print_moments(const char *path, const nurbs_moments *m, const nurbs_moments *e)
{
    static const char *const first[3] = {"V x", "V y", "V z"};
    static const char *const second[6] = {"V xx", "V yy", "V zz", "V xy", "V yz", "V zx"};
    printf("%s (one side as stored; about the origin)\n", path);
    print_line("area", "m^2", m->area, e->area);
    print_line("volume", "m^3", m->volume, e->volume);
    for (int c = 0; c < 3; c++)
        print_line(first[c], "m^4", m->moment[c], e->moment[c]);
    for (int c = 0; c < 6; c++)
        print_line(second[c], "m^5", m->second[c], e->second[c]);
}

static json_t *pack_moments(const nurbs_moments *m)
{
    return json_pack("{s:f,s:f,s:[f,f,f],s:[f,f,f,f,f,f]}", "area", m->area, "volume", m->volume,
                     "moment", m->moment[0], m->moment[1], m->moment[2], "second", m->second[0],
                     m->second[1], m->second[2], m->second[3], m->second[4], m->second[5]);
}

static int run(int argc, char **argv)
{
    bool json = false;
    int code = parse_options(argc, argv, 0, NULL, one_file, &json);
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    nurbs_moments m, e;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK && nurbs_patches_moments(patches, &m, &e) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK && json) {
        json_t *result = pack_moments(&m);
        json_result_set(result, "file", json_string(argv[optind]));
        json_result_set(result, "error", pack_moments(&e));
        code = print_json(result);
    } else if (code == CLI_OK) {
        print_moments(argv[optind], &m, &e);
    }
    nurbs_patches_free(patches);
    return code;
}

const subcommand moments_command = {
    "moments", "area, volume and moments of a body", run,
    "usage: nurbs moments FILE\n"
    "  Area, and by the divergence theorem volume, first and second moments of volume with\n"
    "  estimated errors. A half hull or wetted hull closes itself: planes y = 0 and z = 0 and\n"
    "  sides along y carry no flux of y. Outward normals give a positive volume; see\n"
    "  'nurbs edit orient'.\n"};
