#include "kelvin/kelvin_simd.h"

#ifdef KELVIN_X86
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512bw,avx512vl,fma"))),    \
                             apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl,fma")
#endif
#define KELVIN_WAVE_KERNEL kelvin_wave_avx512
#include "kelvin/kelvin_wave_integral.h"
#if defined(__clang__)
#pragma clang attribute pop
#endif
#endif
