/* The wave part W, its gradient and its second derivatives. */
#include "core/error.h"
#include "kelvin/kelvin_domain.h"
#include "kelvin/kelvin_simd.h"
#include "kelvin/kelvin_wave_kernel.h"

#include <igabem/kelvin.h>

#include <math.h>

/* By the kernel for this machine. */
static void run(const struct kelvin_wave_call *call)
{
    kelvin_wave_kernel *kernel = kelvin_wave_base;
#ifdef KELVIN_X86
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        kernel = kelvin_wave_avx512;
    else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        kernel = kelvin_wave_avx2;
#endif
    kernel(call);
}

igabem_status igabem_kelvin_wave(size_t n, const double *X, const double *Y, const double *Z,
                                 double *W, double *WX, double *WY, double *WZ)
{
    return igabem_kelvin_wave_filtered(n, X, Y, Z, NULL, W, WX, WY, WZ);
}

void igabem_kelvin_filter_init(igabem_kelvin_filter *filter)
{
    if (filter)
        *filter = (igabem_kelvin_filter){0};
}

igabem_status igabem_kelvin_wave_filtered(size_t n, const double *X, const double *Y,
                                          const double *Z, const igabem_kelvin_filter *filter,
                                          double *W, double *WX, double *WY, double *WZ)
{
    igabem_kelvin_filter none = {0};
    if (!filter)
        filter = &none;
    if (!(filter->cut_off >= 0) || !isfinite(filter->cut_off))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave filter: cut_off is %g, expected finite and >= 0", filter->cut_off);
    if (!(filter->depth >= 0) || !isfinite(filter->depth))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave filter: depth is %g, expected finite and >= 0", filter->depth);
    igabem_status status = kelvin_check_wave_domain("kelvin wave part", n, X, Y, Z);
    if (status != IGABEM_OK)
        return status;
    double e = filter->cut_off > 0 ? 1 / (1 + filter->cut_off * filter->cut_off) : 0;
    const struct kelvin_wave_call call = {.kind =
                                              filter->cut_off > 0 ? KELVIN_FILTERED : KELVIN_PLAIN,
                                          .n = n,
                                          .X = X,
                                          .Y = Y,
                                          .Z = Z,
                                          .depth = filter->depth,
                                          .e2 = e * e,
                                          .to = {W, WX, WY, WZ}};
    run(&call);
    return IGABEM_OK;
}

igabem_status igabem_kelvin_wave_second(size_t n, const double *X, const double *Y, const double *Z,
                                        double *WXX, double *WXY, double *WXZ, double *WYY,
                                        double *WYZ, double *WZZ)
{
    igabem_status status = kelvin_check_wave_domain("kelvin wave part", n, X, Y, Z);
    const struct kelvin_wave_call call = {.kind = KELVIN_SECOND_DERIVATIVES,
                                          .n = n,
                                          .X = X,
                                          .Y = Y,
                                          .Z = Z,
                                          .to = {WXX, WXY, WXZ, WYY, WYZ, WZZ}};
    if (status == IGABEM_OK)
        run(&call);
    return status;
}
