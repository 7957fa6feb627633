/* Exact changes of patches, one after the other in the order given. */
#include "constants.h"
#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The values of an operation NAME[:VALUE...]; directions come first, as u or v. */
typedef struct operation {
    const char *text;
    int direction;
    size_t count;
    double *value;
} operation;

typedef struct operator
{
    const char *name;
    bool directed; /* its first value is u or v */
    size_t least, most;
    nurbs_status (*surface)(const operation *op, const nurbs_surface *in, nurbs_surface **out);
    nurbs_status (*patches)(const operation *op, const nurbs_patches *in, nurbs_patches **out);
}
operator;

static nurbs_status reverse(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    return nurbs_surface_reverse(in, op->direction, out);
}

static nurbs_status swap(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    (void)op;
    return nurbs_surface_swap(in, out);
}

static nurbs_status elevate(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    return nurbs_surface_elevate(in, op->direction, (int)op->value[0], out);
}

static nurbs_status insert(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    return nurbs_surface_insert(in, op->direction, op->count, op->value, out);
}

static nurbs_status refine(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    return nurbs_surface_refine(in, (int)op->value[0], out);
}

static nurbs_status bezier(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    (void)op;
    return nurbs_surface_to_bezier(in, out);
}

static nurbs_status part(const operation *op, const nurbs_surface *in, nurbs_surface **out)
{
    return nurbs_surface_part(in, op->direction, op->value[0], op->value[1], out);
}

/* Both halves of every patch. */
static nurbs_status split(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    nurbs_status status = start_patches(in, out);
    for (size_t k = 0; k < nurbs_patches_count(in) && status == NURBS_OK; k++) {
        nurbs_surface *half[2] = {NULL, NULL};
        status = nurbs_surface_split(nurbs_patches_get(in, k), op->direction, op->value[0],
                                     &half[0], &half[1]);
        for (int e = 0; e < 2; e++) {
            if (status == NURBS_OK)
                status = nurbs_patches_add(*out, half[e]);
            nurbs_surface_free(half[e]);
        }
    }
    return status;
}

static nurbs_status scale(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    double matrix[9] = {0};
    for (size_t c = 0; c < 3; c++)
        matrix[4 * c] = op->value[op->count == 3 ? c : 0];
    return nurbs_patches_transform(in, matrix, NULL, out);
}

static nurbs_status move(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    return nurbs_patches_transform(in, NULL, op->value, out);
}

/* Rodrigues' formula: degrees about the axis x, y, z. */
static nurbs_status turn(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    double a = op->value[0] * PI / 180, c = cos(a), s = sin(a), n[3],
           length = hypot(hypot(op->value[1], op->value[2]), op->value[3]);
    for (int k = 0; k < 3; k++)
        n[k] = op->value[1 + k] / length;
    const double matrix[9] = {c + n[0] * n[0] * (1 - c),        n[0] * n[1] * (1 - c) - n[2] * s,
                              n[0] * n[2] * (1 - c) + n[1] * s, n[1] * n[0] * (1 - c) + n[2] * s,
                              c + n[1] * n[1] * (1 - c),        n[1] * n[2] * (1 - c) - n[0] * s,
                              n[2] * n[0] * (1 - c) - n[1] * s, n[2] * n[1] * (1 - c) + n[0] * s,
                              c + n[2] * n[2] * (1 - c)};
    return nurbs_patches_transform(in, matrix, NULL, out);
}

static nurbs_status mirror(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    return nurbs_patches_mirror(in, (int)op->value[0], out);
}

static nurbs_status orient(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    return nurbs_patches_orient(in, op->value[0], out, NULL);
}

static nurbs_status only(const operation *op, const nurbs_patches *in, nurbs_patches **out)
{
    nurbs_status status = start_patches(in, out);
    const nurbs_surface *surface = nurbs_patches_get(in, (size_t)op->value[0]);
    if (status != NURBS_OK || !surface)
        return status;
    return add_with_parameters(surface, in, (size_t)op->value[0], *out);
}

static const operator operators[] = {
    {"reverse", true, 0, 0, reverse, NULL}, {"swap", false, 0, 0, swap, NULL},
    {"elevate", true, 1, 1, elevate, NULL}, {"insert", true, 1, 1000, insert, NULL},
    {"refine", false, 1, 1, refine, NULL},  {"bezier", false, 0, 0, bezier, NULL},
    {"part", true, 2, 2, part, NULL},       {"split", true, 1, 1, NULL, split},
    {"scale", false, 1, 3, NULL, scale},    {"move", false, 3, 3, NULL, move},
    {"turn", false, 4, 4, NULL, turn},      {"mirror", false, 1, 1, NULL, mirror},
    {"orient", false, 1, 1, NULL, orient},  {"patch", false, 1, 1, NULL, only},
};

static const operator* find_operator(const char *text)
{
    for (size_t k = 0; k < sizeof operators / sizeof operators[0]; k++) {
        size_t length = strlen(operators[k].name);
        if (strncmp(text, operators[k].name, length) == 0 &&
            (text[length] == '\0' || text[length] == ':'))
            return &operators[k];
    }
    return NULL;
}

/* What the library cannot tell from the numbers it gets. */
static bool suits(const operator* with, const operation *op)
{
    const double *v = op->value;
    if (op->count < with->least || op->count > with->most)
        return false;
    if (with->surface == elevate || with->surface == refine || with->patches == only)
        return v[0] >= 0 && v[0] <= 1000 && v[0] == floor(v[0]);
    if (with->patches == scale)
        return op->count != 2;
    if (with->patches == turn)
        return v[1] != 0 || v[2] != 0 || v[3] != 0;
    return true;
}

/* Splits "name:u:0.25:0.5" or "move:1,0,0"; "mirror:y" stands for the axis' number. */
static int read_operation(const char *text, const operator* with, operation *op)
{
    const char *at = text + strlen(with->name);
    *op = (operation){.text = text, .value = malloc((strlen(text) + 1) * sizeof(double))};
    if (!op->value)
        return cli_fail("out of memory");
    if (with->directed) {
        if (at[0] != ':' || (at[1] != 'u' && at[1] != 'v'))
            return cli_usage("'%s': expected %s:u or %s:v", text, with->name, with->name);
        op->direction = at[1] == 'v';
        at += 2;
    }
    while (*at == ':' || *at == ',') {
        char number[64];
        size_t length = strcspn(++at, ":,");
        snprintf(number, sizeof number, "%.*s", (int)(length < 63 ? length : 63), at);
        if (with->patches == mirror && length == 1 && strchr("xyz", *at))
            op->value[op->count++] = *at - 'x';
        else if (!cli_parse_double(number, &op->value[op->count++]))
            return cli_usage("'%s': '%s' is not %s", text, number,
                             with->patches == mirror ? "x, y or z" : "a number");
        at += length;
    }
    if (*at || !suits(with, op))
        return cli_usage("'%s': wrong values", text);
    return CLI_OK;
}

/* The surface of every patch changed; parameters of a design grid stay valid only where the
 * parametrisation does, so they are kept for changes of representation alone. */
static nurbs_status each_surface(const operator* with, const operation *op, const nurbs_patches *in,
                                 nurbs_patches **out)
{
    bool keeps = with->surface == elevate || with->surface == insert || with->surface == refine ||
                 with->surface == bezier;
    nurbs_status status = start_patches(in, out);
    for (size_t k = 0; k < nurbs_patches_count(in) && status == NURBS_OK; k++) {
        nurbs_surface *changed = NULL;
        status = with->surface(op, nurbs_patches_get(in, k), &changed);
        if (status == NURBS_OK)
            status = keeps ? add_with_parameters(changed, in, k, *out)
                           : nurbs_patches_add(*out, changed);
        nurbs_surface_free(changed);
    }
    return status;
}

static int apply(const char *text, nurbs_patches **patches)
{
    const operator* with = find_operator(text);
    operation op;
    nurbs_patches *changed = NULL;
    if (!with)
        return cli_usage("unknown operation '%s'", text);
    int code = read_operation(text, with, &op);
    if (code == CLI_OK && (with->surface ? each_surface(with, &op, *patches, &changed)
                                         : with->patches(&op, *patches, &changed)) != NURBS_OK)
        code = cli_fail("%s: %s", text, nurbs_last_error());
    if (code == CLI_OK && nurbs_patches_count(changed) == 0)
        code = cli_fail("%s: no such patch, the file has %zu (counted from 0)", text,
                        nurbs_patches_count(*patches));
    free(op.value);
    if (code != CLI_OK) {
        nurbs_patches_free(changed);
        return code;
    }
    nurbs_patches_free(*patches);
    *patches = changed;
    return CLI_OK;
}

static int run(int argc, char **argv)
{
    bool json = false;
    const char *output = NULL;
    const tool_option options[] = {{"output", OPTION_OUTPUT, &output, 0, 0}};
    const operands wanted = {2, 1000, "one NURBS file and at least one operation"};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, wanted, &json);
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    for (int k = optind + 1; k < argc && code == CLI_OK; k++)
        code = apply(argv[k], &patches);
    if (code == CLI_OK && nurbs_patches_write(patches, output) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:I}", "file", output, "patches",
                                    (json_int_t)nurbs_patches_count(patches)));
    nurbs_patches_free(patches);
    return code;
}

const subcommand edit_command = {
    "edit", "change the representation, orientation or place of patches", run,
    "usage: nurbs edit FILE OPERATION... -o FILE\n"
    "  Operations are applied to all patches in the order given; D is u or v. Exact:\n"
    "  reverse:D  swap        turn a direction round, exchange u and v\n"
    "  elevate:D:N            raise the degree by N\n"
    "  insert:D:A:B:...       insert knots\n"
    "  refine:N               divide every knot span into N parts\n"
    "  bezier                 one Bezier patch a knot span\n"
    "  part:D:A:B             the part with parameters from A to B\n"
    "  split:D:A              both sides of a parameter as patches\n"
    "  patch:K                patch K only, counted from 0\n"
    "  scale:S  scale:X,Y,Z   multiply lengths\n"
    "  move:X,Y,Z             metres\n"
    "  turn:A,X,Y,Z           by A degrees about the axis X,Y,Z through the origin\n"
    "  mirror:x|y|z           add the mirror image: mirror:y makes a ship of a half hull\n"
    "  orient:T               normals outwards on patches whose edges meet within T metres\n"
    "  -o, --output FILE\n"};
