/* Vectors of doubles in portable GNU C, and one function body, or a whole file, compiled for
 * several instruction sets. Sixteen lanes are two registers of AVX-512: two independent chains of
 * operations hide each other's latency. Vectors travel by pointer: passing them by value between
 * functions of different instruction sets has no stable calling convention, even when inlined. */
#ifndef IGABEM_KELVIN_SIMD_H
#define IGABEM_KELVIN_SIMD_H

#include <stdint.h>
#include <string.h>

#if defined(__x86_64__) && defined(__linux__) && !defined(ISOHULL_NO_MULTIVERSION)
#define KELVIN_X86
#if defined(__clang__)
/* clang accepts the level names but builds a resolver that does not test for them. */
#define KELVIN_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define KELVIN_MULTIVERSION                                                                        \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
#else
#define KELVIN_MULTIVERSION
#endif

#define KELVIN_INLINE static inline __attribute__((always_inline))
/* Much code that is called from several places. */
#define KELVIN_OUTLINE static __attribute__((noinline))

enum { KELVIN_OCTET = 8, KELVIN_LANES = 16 };

typedef double kelvin_octet __attribute__((vector_size(64)));
typedef double kelvin_vec __attribute__((vector_size(128)));
typedef uint64_t kelvin_bits __attribute__((vector_size(128)));

#endif
