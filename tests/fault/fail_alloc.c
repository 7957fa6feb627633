/* Preloaded (LD_PRELOAD) into a program, makes its k-th allocation fail:
 *
 * - FAULT_AT=k: malloc, calloc, realloc, posix_memalign, aligned_alloc and strdup are counted from
 *   the start of main(); the k-th answers as if memory had run out, those after it do their work
 *   again. 0 or unset: none.
 * - FAULT_DISTINCT=1 counts only the first of those that the same twelve calls lead to.
 * - FAULT_UNDER=FUNCTION counts only those that this public function leads to.
 * - FAULT_TRACE=1 prints the calls that led to it on standard error.
 * - FAULT_COUNT=FILE receives the number of allocations when the program ends.
 *
 * Allocations by libraries that end the program when memory runs out (GLib and what draws with it,
 * libgomp), or that go on with what they did not get (HDF5 1.10), are let through: what happens
 * there is theirs. Needs glibc. */
#include "start.h"

#include <errno.h>
#include <execinfo.h>
#include <link.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);

static const char *const own_rules[] = {"libhdf5",       "libgomp",      "libglib",  "libgobject",
                                        "libgio",        "librsvg",      "libcairo", "libpango",
                                        "libgdk_pixbuf", "libfontconfig"};
enum { MOST_RANGES = 64 };
static struct {
    uintptr_t from, to;
} let_through[MOST_RANGES];
static size_t ranges;
static bool distinct;
static struct {
    uintptr_t from, to; /* 0, 0: anywhere */
} under;

static bool is_under(void)
{
    void *calls[60];
    for (int n = backtrace(calls, 60), k = 0; k < n; k++)
        if ((uintptr_t)calls[k] >= under.from && (uintptr_t)calls[k] < under.to)
            return true;
    return false;
}

/* Whether the calls that lead here led here before; a table that fills up forgets none. */
static bool seen(void)
{
    enum { DEPTH = 15, OWN = 3, SLOTS = 1 << 16 };
    static atomic_ulong slots[SLOTS];
    void *calls[DEPTH];
    unsigned long hash = 14695981039346656037u; /* FNV-1a */
    for (int n = backtrace(calls, DEPTH), k = OWN; k < n; k++)
        hash = (hash ^ (uintptr_t)calls[k]) * 1099511628211u;
    hash += hash == 0;
    for (unsigned long k = hash >> 20, tries = 0; tries < SLOTS; k++, tries++) {
        unsigned long there = 0;
        if (atomic_compare_exchange_strong(&slots[k % SLOTS], &there, hash))
            return false;
        if (there == hash)
            return true;
    }
    return false;
}

static bool fails(const void *caller)
{
    if (!atomic_load_explicit(&armed, memory_order_relaxed))
        return false;
    for (size_t k = 0; k < ranges; k++)
        if ((uintptr_t)caller >= let_through[k].from && (uintptr_t)caller < let_through[k].to)
            return false;
    if (under.to && !is_under())
        return false;
    if (distinct && seen())
        return false;
    if (atomic_fetch_add(&count, 1) + 1 != fault_at)
        return false;
    trace();
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size)
{
    return fails(__builtin_return_address(0)) ? NULL : __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    return fails(__builtin_return_address(0)) ? NULL : __libc_calloc(n, size);
}

void *realloc(void *old, size_t size)
{
    return fails(__builtin_return_address(0)) ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return fails(__builtin_return_address(0)) ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    void *made = fails(__builtin_return_address(0)) ? NULL : __libc_memalign(alignment, size);
    if (!made)
        return ENOMEM;
    *memory = made;
    return 0;
}

/* Here, so that it is known who asked. */
char *strdup(const char *text)
{
    size_t size = strlen(text) + 1;
    void *made = fails(__builtin_return_address(0)) ? NULL : __libc_malloc(size);
    return made ? memcpy(made, text, size) : NULL;
}

static int note_module(struct dl_phdr_info *info, size_t size, void *data)
{
    (void)size;
    (void)data;
    bool wanted = false;
    for (size_t k = 0; k < sizeof own_rules / sizeof *own_rules; k++)
        wanted = wanted || strstr(info->dlpi_name, own_rules[k]);
    for (size_t k = 0; wanted && k < info->dlpi_phnum && ranges < MOST_RANGES; k++)
        if (info->dlpi_phdr[k].p_type == PT_LOAD && (info->dlpi_phdr[k].p_flags & PF_X)) {
            let_through[ranges].from = info->dlpi_addr + info->dlpi_phdr[k].p_vaddr;
            let_through[ranges].to = let_through[ranges].from + info->dlpi_phdr[k].p_memsz;
            ranges++;
        }
    return 0;
}

static void find_under(const char *name)
{
    ElfW(Sym) *symbol = NULL;
    Dl_info info;
    void *start = dlsym(RTLD_DEFAULT, name);
    if (!start || !dladdr1(start, &info, (void **)&symbol, RTLD_DL_SYMENT) || !symbol) {
        fprintf(stderr, "FAULT_UNDER=%s: no such function\n", name);
        _exit(99);
    }
    under.from = (uintptr_t)start;
    under.to = under.from + symbol->st_size;
}

static void prepare(void)
{
    const char *name = getenv("FAULT_UNDER");
    if (name)
        find_under(name);
    distinct = getenv("FAULT_DISTINCT");
    dl_iterate_phdr(note_module, NULL);
    unsetenv("LD_PRELOAD"); /* what the program starts is not under test */
}
