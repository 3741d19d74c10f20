#pragma once
#include <dlfcn.h>
#include <stdarg.h>
#include <stddef.h>

/* The real syscall(), for a library that has one of its own. */
static long kernel(long number, ...) {
    static long (*real)(long, ...) = NULL;
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, "syscall");
    va_list more;
    va_start(more, number);
    long a[6];
    for (int i = 0; i < 6; ++i) a[i] = va_arg(more, long);
    va_end(more);
    return real(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}
