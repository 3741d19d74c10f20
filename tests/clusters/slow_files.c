/* A library for LD_PRELOAD that makes a folder as slow as a file system which many machines share: each operation on something
 * below it waits first. Unlike the kernel's cache it forgets everything at once. Not delayed: closing, fstat and seeking, for which such
 * file systems ask nobody; the engine's fflush.
 *
 *   VIBROTROUGH_SLOW_BELOW   the folder, without links in its path
 *   VIBROTROUGH_SLOW_DELAY   microseconds
 *   VIBROTROUGH_SLOW_LOG     file that receives a line for each operation: number of the process, its kind, its file
 */
#define _GNU_SOURCE
#include "../faults/kernel_call.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/* The absolute path of a name in an open folder, or of the open file itself without a name. */
static void find_path(int folder, char const* name, char* place, size_t size) {
    char link[40] = "/proc/self/cwd", parent[PATH_MAX];
    if (name != NULL && name[0] == '/') {
        snprintf(place, size, "%s", name);
        return;
    }
    if (folder != AT_FDCWD) snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
    long const length = kernel(SYS_readlinkat, AT_FDCWD, link, parent, sizeof parent - 1);
    parent[length < 0 ? 0 : length] = '\0';
    snprintf(place, size, "%s%s%s", parent, name == NULL ? "" : "/", name == NULL ? "" : name);
}

static void wait_for(char const* kind, int folder, char const* name) {
    int const kept = errno;
    char const *const below = getenv("VIBROTROUGH_SLOW_BELOW"), *const delay = getenv("VIBROTROUGH_SLOW_DELAY");
    char place[2 * PATH_MAX];
    if (below == NULL) return;
    find_path(folder, name, place, sizeof place);
    size_t const length = strlen(below);
    if (strncmp(place, below, length) == 0 && (place[length] == '/' || place[length] == '\0')) {
        char const* const log = getenv("VIBROTROUGH_SLOW_LOG");
        if (log != NULL) {
            char line[2 * PATH_MAX + 60];
            int const size = snprintf(line, sizeof line, "%d %s %s\n", getpid(), kind, place);
            long const file = kernel(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
            kernel(SYS_write, file, line, size);
            kernel(SYS_close, file);
        }
        if (delay != NULL) usleep((useconds_t)strtol(delay, NULL, 10));
    }
    errno = kept;
}

#define SLOW(result, function, parameters, arguments, kind, folder, name)         \
    result function parameters {                                                  \
        static result(*real) parameters = NULL;                                   \
        if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, #function);           \
        wait_for(kind, folder, name);                                             \
        return real arguments;                                                    \
    }
#define SLOW_OPEN(function, parameters, arguments, folder)                        \
    int function parameters {                                                     \
        va_list more;                                                             \
        va_start(more, flags);                                                    \
        mode_t const mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0; \
        va_end(more);                                                             \
        wait_for("open", folder, name);                                           \
        return (int)kernel arguments;                                             \
    }

SLOW_OPEN(open, (char const* name, int flags, ...), (SYS_openat, AT_FDCWD, name, flags, mode), AT_FDCWD)
SLOW_OPEN(open64, (char const* name, int flags, ...), (SYS_openat, AT_FDCWD, name, flags, mode), AT_FDCWD)
SLOW_OPEN(openat, (int folder, char const* name, int flags, ...), (SYS_openat, folder, name, flags, mode), folder)
SLOW_OPEN(openat64, (int folder, char const* name, int flags, ...), (SYS_openat, folder, name, flags, mode), folder)

/* openat2 has no function of its own in glibc. */
long syscall(long number, ...) {
    va_list more;
    va_start(more, number);
    long a[6];
    for (int i = 0; i < 6; ++i) a[i] = va_arg(more, long);
    va_end(more);
    if (number == SYS_openat2) wait_for("open", (int)a[0], (char const*)a[1]);
    return kernel(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

SLOW(FILE*, fopen, (char const* name, char const* mode), (name, mode), "open", AT_FDCWD, name)
SLOW(FILE*, fopen64, (char const* name, char const* mode), (name, mode), "open", AT_FDCWD, name)
SLOW(DIR*, opendir, (char const* name), (name), "open", AT_FDCWD, name)
SLOW(DIR*, fdopendir, (int folder), (folder), "list", folder, NULL)
SLOW(int, stat, (char const* name, struct stat* status), (name, status), "stat", AT_FDCWD, name)
SLOW(int, stat64, (char const* name, struct stat64* status), (name, status), "stat", AT_FDCWD, name)
SLOW(int, lstat, (char const* name, struct stat* status), (name, status), "stat", AT_FDCWD, name)
SLOW(int, lstat64, (char const* name, struct stat64* status), (name, status), "stat", AT_FDCWD, name)
SLOW(int, fstatat, (int folder, char const* name, struct stat* status, int flags), (folder, name, status, flags), "stat", folder, name)
SLOW(int, fstatat64, (int folder, char const* name, struct stat64* status, int flags), (folder, name, status, flags), "stat", folder, name)
SLOW(int, access, (char const* name, int mode), (name, mode), "stat", AT_FDCWD, name)
SLOW(ssize_t, readlink, (char const* name, char* place, size_t size), (name, place, size), "stat", AT_FDCWD, name)
SLOW(int, mkdir, (char const* name, mode_t mode), (name, mode), "mkdir", AT_FDCWD, name)
SLOW(int, mkdirat, (int folder, char const* name, mode_t mode), (folder, name, mode), "mkdir", folder, name)
SLOW(int, unlink, (char const* name), (name), "unlink", AT_FDCWD, name)
SLOW(int, rmdir, (char const* name), (name), "unlink", AT_FDCWD, name)
SLOW(int, unlinkat, (int folder, char const* name, int flags), (folder, name, flags), "unlink", folder, name)
SLOW(int, rename, (char const* from, char const* to), (from, to), "rename", AT_FDCWD, to)
SLOW(int, renameat, (int folder, char const* from, int other, char const* to), (folder, from, other, to), "rename", other, to)
SLOW(int, linkat, (int folder, char const* from, int other, char const* to, int flags), (folder, from, other, to, flags), "link", other, to)
SLOW(int, flock, (int file, int kind), (file, kind), "lock", file, NULL)
SLOW(int, fchmod, (int file, mode_t mode), (file, mode), "chmod", file, NULL)
SLOW(int, ftruncate, (int file, off_t size), (file, size), "write", file, NULL)
SLOW(int, fsync, (int file), (file), "sync", file, NULL)
SLOW(ssize_t, read, (int file, void* bytes, size_t size), (file, bytes, size), "read", file, NULL)
SLOW(ssize_t, write, (int file, void const* bytes, size_t size), (file, bytes, size), "write", file, NULL)
SLOW(ssize_t, pread64, (int file, void* bytes, size_t size, off64_t place), (file, bytes, size, place), "read", file, NULL)
SLOW(ssize_t, pwrite64, (int file, void const* bytes, size_t size, off64_t place), (file, bytes, size, place), "write", file, NULL)
