/* Inner loops compiled for several x86-64 levels, the fastest the machine has being chosen when the
 * library is loaded. Elsewhere, and under sanitizers, the loops are compiled once. */
#ifndef GALV_SIMD_H
#define GALV_SIMD_H

#include <stdbool.h>

#if defined(__x86_64__) && defined(__linux__) && !defined(ISOHULL_NO_MULTIVERSION) &&              \
    defined(__GNUC__) && !defined(__clang__)
#define GALV_SIMD __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define GALV_SIMD
#endif

/* For kernels that want another shape, not only other instructions, with 32 registers of 512 bits:
 * marks the one for them; galv_simd_wide() says whether this machine has them. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(ISOHULL_NO_MULTIVERSION)
#define GALV_SIMD_WIDE __attribute__((target("avx512f,fma")))
static inline bool galv_simd_wide(void)
{
    return __builtin_cpu_supports("avx512f");
}
#else
#define GALV_SIMD_WIDE
static inline bool galv_simd_wide(void)
{
    return false;
}
#endif

/* A helper must be inlined to be compiled with the level of the loop that calls it. */
#define GALV_SIMD_INLINE static inline __attribute__((always_inline))

#endif
