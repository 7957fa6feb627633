#include "particulars.h"

#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINE = 12 /* divisions of a knot span for section areas */ };

static void add(struct particulars *p, const char *key, double value, const char *unit,
                const char *text)
{
    if (p->count < PARTICULARS_MOST)
        p->item[p->count++] = (struct particular){key, unit, text, value};
}

/* Parameters that divide every knot span of one direction in FINE parts. Creates *at. */
static size_t fine_parameters(const nurbs_surface *surface, int d, double **at)
{
    size_t size = nurbs_surface_size(surface, d), n = 0;
    size_t degree = (size_t)nurbs_surface_degree(surface, d);
    const double *knots = nurbs_surface_knots(surface, d);
    *at = malloc((size * FINE + 1) * sizeof **at);
    if (!*at)
        return 0;
    for (size_t s = degree; s < size; s++)
        for (int i = 0; knots[s + 1] > knots[s] && i < FINE; i++)
            (*at)[n++] = knots[s] + (knots[s + 1] - knots[s]) * i / FINE;
    (*at)[n++] = knots[size];
    return n;
}

/* Where the plane x = station meets an edge of a triangle. */
static int crossing(const double a[3], const double b[3], double station, double yz[2])
{
    if ((a[0] <= station) == (b[0] <= station))
        return 0;
    double s = (station - a[0]) / (b[0] - a[0]);
    yz[0] = a[1] + s * (b[1] - a[1]);
    yz[1] = a[2] + s * (b[2] - a[2]);
    return 1;
}

/* Adds the signed area y dz that the section through one triangle bounds with the centre plane; the
 * sign follows the orientation of the triangle, so that overhangs subtract. */
static void slice(const double a[3], const double b[3], const double c[3], size_t n,
                  const double *x, double *area)
{
    double low = fmin(a[0], fmin(b[0], c[0])), high = fmax(a[0], fmax(b[0], c[0]));
    /* The section of a surface with normal n runs along n x e_x = (0, n_z, -n_y): dz ~ n_y. */
    double ny = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
    for (size_t i = 0; i < n; i++) {
        if (x[i] < low || x[i] > high)
            continue;
        double p[3][2];
        int k = crossing(a, b, x[i], p[0]);
        k += crossing(b, c, x[i], p[k]);
        if (k < 2)
            k += crossing(c, a, x[i], p[k]);
        if (k == 2)
            area[i] += 0.5 * fabs(p[0][1] - p[1][1]) * (p[0][0] + p[1][0]) * (ny > 0 ? 1.0 : -1.0);
    }
}

static int section_areas(const struct hull_input *input, struct particulars *p)
{
    for (size_t k = 0; k < nurbs_patches_count(input->patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(input->patches, k);
        double *u = NULL, *v = NULL, *xyz = NULL, *part = calloc(p->stations, sizeof *part);
        size_t nu = fine_parameters(surface, 0, &u), nv = fine_parameters(surface, 1, &v);
        int ok = nu && nv && part && (xyz = malloc(nu * nv * 3 * sizeof *xyz)) &&
                 !nurbs_surface_eval_grid(surface, 0, nu, u, nv, v, xyz);
        for (size_t i = 0; ok && i + 1 < nu; i++)
            for (size_t j = 0; j + 1 < nv; j++) {
                const double *a = xyz + 3 * (i * nv + j), *b = a + 3 * nv, *c = b + 3, *d = a + 3;
                slice(a, b, c, p->stations, p->station_x, part);
                slice(a, c, d, p->stations, p->station_x, part);
            }
        /* The sign of the patch's own orientation: the areas of a hull are positive. */
        double total = 0.0;
        for (size_t i = 0; ok && i < p->stations; i++)
            total += part[i];
        for (size_t i = 0; ok && i < p->stations; i++)
            p->station_area[i] += 2.0 * (total < 0 ? -part[i] : part[i]);
        free(u);
        free(v);
        free(xyz);
        free(part);
        if (!ok)
            return cli_fail("section areas: out of memory");
    }
    return CLI_OK;
}

static void add_lengths(struct particulars *p, const igabem_hull_info *info)
{
    const nurbs_hydrostatics *h = &info->hydrostatics;
    int piercing = info->surface_piercing;
    add(p, "length", info->length, "m", "reference length (Lpp)");
    add(p, "waterline_length", piercing ? h->x_fore - h->x_aft : NAN, "m", "Lwl");
    add(p, "x_aft", h->x_aft, "m", "aft end of the waterline");
    add(p, "x_fore", h->x_fore, "m", "fore end of the waterline");
    add(p, "beam", h->beam, "m", "at the waterline");
    add(p, "draft", h->draft, "m", "deepest point");
    add(p, "keel_draft", h->keel_draft, "m", "keel amidships");
}

static void add_areas(struct particulars *p, const igabem_hull_info *info, double density)
{
    const nurbs_hydrostatics *h = &info->hydrostatics;
    add(p, "volume", h->volume, "m^3", "displacement");
    add(p, "mass", density * h->volume, "kg", "displaced");
    add(p, "wetted_area", h->wetted_area, "m^2", "both sides, transom excluded");
    add(p, "waterplane_area", h->waterplane_area, "m^2", "");
    add(p, "transom_area", h->transom_area, "m^2", "immersed, at rest");
    add(p, "transom_ratio", h->section_area_max > 0 ? h->transom_area / h->section_area_max : NAN,
        "", "over the largest section");
    add(p, "section_area_max", h->section_area_max, "m^2", "");
    add(p, "section_area_max_x", h->section_area_max_x, "m", "");
}

static void add_centres(struct particulars *p, const igabem_hull_info *info, double lpp)
{
    const nurbs_hydrostatics *h = &info->hydrostatics;
    double aft = lpp > 0 ? 0.0 : h->x_aft, length = lpp > 0 ? lpp : info->length;
    double middle = aft + 0.5 * length;
    int piercing = info->surface_piercing;
    add(p, "lcb", h->centroid[0], "m", "x of the centre of buoyancy");
    add(p, "lcb_from_fore", aft + length - h->centroid[0], "m", "aft of the fore perpendicular");
    add(p, "lcb_percent", 100.0 * (h->centroid[0] - middle) / length, "%",
        "of the length, forward of midship");
    add(p, "vcb", h->centroid[2], "m", "z of the centre of buoyancy");
    add(p, "kb", h->centroid[2] + h->keel_draft, "m", "above the keel");
    add(p, "lcf", piercing ? h->waterplane_centre : NAN, "m", "x of the centre of flotation");
    add(p, "lcf_from_fore", piercing ? aft + length - h->waterplane_centre : NAN, "m", "");
}

static void add_stability(struct particulars *p, const igabem_hull_info *info, double density,
                          double kg)
{
    const nurbs_hydrostatics *h = &info->hydrostatics;
    if (!info->surface_piercing)
        return;
    double bmt = h->waterplane_inertia_x / h->volume, bml = h->waterplane_inertia_y / h->volume;
    double kb = h->centroid[2] + h->keel_draft;
    add(p, "bmt", bmt, "m", "transverse metacentric radius");
    add(p, "bml", bml, "m", "longitudinal metacentric radius");
    add(p, "kmt", kb + bmt, "m", "");
    add(p, "gmt", kb + bmt - kg, "m", "");
    add(p, "tpc", 1e-5 * density * h->waterplane_area, "t/cm", "tonnes per centimetre immersion");
    double gml = isnan(kg) ? bml : kb + bml - kg;
    add(p, "mtc", 1e-5 * density * h->volume * gml / info->length, "t m/cm",
        "moment to change trim one centimetre");
}

static void add_coefficients(struct particulars *p, const igabem_hull_info *info)
{
    const nurbs_hydrostatics *h = &info->hydrostatics;
    double length = info->surface_piercing ? h->x_fore - h->x_aft : info->length;
    double beam = h->beam, draft = h->keel_draft, area = h->section_area_max;
    if (!(beam > 0) || !(draft > 0) || !info->surface_piercing)
        return;
    add(p, "cb", h->volume / (length * beam * draft), "", "block, on Lwl, B, keel draft");
    add(p, "cm", area / (beam * draft), "", "largest section");
    add(p, "cp", h->volume / (area * length), "", "prismatic");
    add(p, "cwp", h->waterplane_area / (length * beam), "", "waterplane");
    add(p, "cvp", h->volume / (h->waterplane_area * draft), "", "vertical prismatic");
    add(p, "nu_s", info->nu_s, "", "largest |x component| of the waterline normal");
    add(p, "entrance_angle", asin(fmin(1.0, info->nu_s)) * 57.29577951308232, "deg",
        "half angle that belongs to it");
}

int particulars_find(const struct hull_input *input, double density, double kg, size_t stations,
                     struct particulars *p)
{
    igabem_hull_info info;
    *p = (struct particulars){.stations = stations};
    p->station_x = malloc(stations * sizeof(double));
    p->station_area = calloc(stations, sizeof(double));
    if (!p->station_x || !p->station_area)
        return cli_fail("out of memory");
    igabem_hull_get_info(input->hull, &info);
    double lpp = input->lpp, from = info.hydrostatics.x_aft, to = info.hydrostatics.x_fore;
    if (lpp > 0 && info.surface_piercing && lpp <= 1.05 * (to - from)) {
        from = 0.0; /* perpendiculars: 0 aft, lpp fore */
        to = lpp;
        if (info.hydrostatics.x_aft < -0.25 * lpp) { /* a hull about its midship */
            from = -0.5 * lpp;
            to = 0.5 * lpp;
        }
    }
    for (size_t i = 0; i < stations; i++)
        p->station_x[i] = from + (to - from) * (double)i / (double)(stations - 1);
    add_lengths(p, &info);
    add_areas(p, &info, density);
    add_centres(p, &info, from == 0.0 ? lpp : 0.0);
    add_stability(p, &info, density, kg);
    add_coefficients(p, &info);
    add(p, "error", info.hydrostatics.error, "", "relative, of the integrals");
    snprintf(p->note, sizeof p->note, "%s; %s", input->note, hull_stern(&info));
    int code = section_areas(input, p);
    if (code == CLI_OK && info.surface_piercing)
        add(p, "bulb_ratio", p->station_area[stations - 1] / info.hydrostatics.section_area_max, "",
            "section at the fore perpendicular over the largest");
    return code;
}

void particulars_free(struct particulars *particulars)
{
    free(particulars->station_x);
    free(particulars->station_area);
}
