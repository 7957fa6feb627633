/* usage: opener LIBRARY SYMBOL: opens a library by its path and finds one of its functions. */
#include <dlfcn.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    void *library = dlopen(argv[1], RTLD_NOW);
    if (!library || !dlsym(library, argv[2])) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    return dlclose(library) != 0;
}
