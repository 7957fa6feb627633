/* Functions compiled for several x86-64 levels and chosen when the library is loaded. */
#ifndef BAYESOPT_CLONES_H
#define BAYESOPT_CLONES_H

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
    !defined(ISOHULL_NO_MULTIVERSION)
#define BAYESOPT_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BAYESOPT_CLONES
#endif

#endif
