/* NURBS_MULTIVERSION: compiles a function once per instruction set; the loader picks the best one
 * of this machine. Elsewhere the baseline version is the only one; clang 14 gives the resolvers of
 * equally named static functions one global name, so it is left out. */
#ifndef NURBS_MULTIVERSION_H
#define NURBS_MULTIVERSION_H

#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) &&                            \
    !defined(ISOHULL_NO_MULTIVERSION)
#define NURBS_MULTIVERSION __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define NURBS_MULTIVERSION
#endif

/* Before short loops whose bounds become constants by inlining. */
#ifdef __clang__
#define NURBS_UNROLL _Pragma("clang loop unroll_count(4)")
#else
#define NURBS_UNROLL _Pragma("GCC unroll 4")
#endif

#define NURBS_INLINE static inline __attribute__((always_inline))

#endif
