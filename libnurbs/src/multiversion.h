/* NURBS_MULTIVERSION: compiles a function once per instruction set; the loader picks the best one
 * of this machine. Elsewhere the baseline version is the only one. */
#ifndef NURBS_MULTIVERSION_H
#define NURBS_MULTIVERSION_H

#if defined(__x86_64__) && defined(__linux__) && !defined(ISOHULL_NO_MULTIVERSION)
#define NURBS_MULTIVERSION __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define NURBS_MULTIVERSION
#endif

#define NURBS_INLINE static inline __attribute__((always_inline))

#endif
