/* A library for LD_PRELOAD that lets one system call of the program under test fail: the n-th of those that write,
 * sync, rename, open, remove or start something. It counts the calls of one process only, the first that loads it and
 * has the name in VIBROTROUGH_FAULT_PROGRAM; what that process starts is left alone.
 *
 *   VIBROTROUGH_FAULT_PROGRAM   name of the process (comm)
 *   VIBROTROUGH_FAULT_BELOW     only calls whose file lies below this folder count; unset: all
 *   VIBROTROUGH_FAULT_NAMED     only calls whose file has this text in its path count; unset: all
 *   VIBROTROUGH_FAULT_AT        number of the call that fails, from 1; 0: none
 *   VIBROTROUGH_FAULT_ERROR     errno of the failure, or "short": a write that writes one byte only, or "kill": SIGKILL at
 *                               the call, or "torn": SIGKILL when a write has written half
 *   VIBROTROUGH_FAULT_COUNT     file that receives one line per call: its kind and its file
 */
#define _GNU_SOURCE
#include "kernel_call.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int is_watched = -1, count_file = -1;
static long calls, fails_at;
static int error = EIO, is_short, is_kill, is_torn;
static const char *below, *named;
static pid_t watched;

static void read_settings(void) {
    char name[64] = "";
    int const comm = (int)kernel(SYS_openat, AT_FDCWD, "/proc/self/comm", O_RDONLY, 0);
    ssize_t const length = comm < 0 ? 0 : kernel(SYS_read, comm, name, sizeof name - 1);
    if (comm >= 0) kernel(SYS_close, comm);
    if (length > 0) name[length - 1] = '\0';
    char const* const wanted = getenv("VIBROTROUGH_FAULT_PROGRAM");
    is_watched = wanted != NULL && strcmp(name, wanted) == 0;
    if (!is_watched) return;
    watched = getpid();
    below = getenv("VIBROTROUGH_FAULT_BELOW");
    named = getenv("VIBROTROUGH_FAULT_NAMED");
    char const* const at = getenv("VIBROTROUGH_FAULT_AT");
    fails_at = at == NULL ? 0 : strtol(at, NULL, 10);
    char const* const kind = getenv("VIBROTROUGH_FAULT_ERROR");
    is_short = kind != NULL && strcmp(kind, "short") == 0;
    is_kill = kind != NULL && strcmp(kind, "kill") == 0;
    is_torn = kind != NULL && strcmp(kind, "torn") == 0;
    if (kind != NULL && !is_short && !is_kill && !is_torn) error = (int)strtol(kind, NULL, 10);
    char const* const path = getenv("VIBROTROUGH_FAULT_COUNT");
    if (path != NULL) count_file = (int)kernel(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    /* Children are not watched: the library need not be loaded there. */
    unsetenv("LD_PRELOAD");
}

/* Whether this call is to fail. */
static int is_due(char const* kind, char const* file) {
    if (is_watched < 0) read_settings();
    if (!is_watched || getpid() != watched) return 0;
    if (below != NULL && file != NULL && strncmp(file, below, strlen(below)) != 0) return 0;
    if (named != NULL && (file == NULL || strstr(file, named) == NULL)) return 0;
    long const number = __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
    if (count_file >= 0) {
        char line[PATH_MAX + 40];
        int const length = snprintf(line, sizeof line, "%ld %s %s\n", number, kind, file == NULL ? "" : file);
        kernel(SYS_write, count_file, line, (size_t)length);
    }
    if (number == fails_at && is_kill) kernel(SYS_kill, watched, SIGKILL);
    return number == fails_at;
}

static char const* path_of(int descriptor, char* place) {
    char link[40];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    ssize_t const length = kernel(SYS_readlinkat, AT_FDCWD, link, place, PATH_MAX - 1);
    place[length < 0 ? 0 : length] = '\0';
    return place;
}

/* The path of a name in an open folder. */
static char const* path_at(int folder, char const* name, char* place) {
    if (name[0] == '/') return name;
    char parent[PATH_MAX];
    if (folder == AT_FDCWD) {
        if (getcwd(parent, sizeof parent) == NULL) parent[0] = '\0';
    } else {
        path_of(folder, parent);
    }
    /* The longest path that matters fits. */
    snprintf(place, PATH_MAX + NAME_MAX, "%s/%s", parent, name);
    return place;
}

#define REAL(result, name, ...)                                       \
    static result (*real)(__VA_ARGS__) = NULL;                        \
    if (real == NULL) *(void**)&real = dlsym(RTLD_NEXT, name)

static int fail(void) {
    errno = error;
    return -1;
}

/* @param at  place in the file, or -1: where it stands */
static ssize_t written(int descriptor, void const* bytes, size_t length, off_t at) {
    return at < 0 ? kernel(SYS_write, descriptor, bytes, length) : kernel(SYS_pwrite64, descriptor, bytes, length, at);
}

static ssize_t write_at(int descriptor, void const* bytes, size_t length, off_t at) {
    char place[PATH_MAX];
    if (descriptor > 2 && is_due("write", path_of(descriptor, place))) {
        if (is_torn) {
            written(descriptor, bytes, length / 2, at);
            kernel(SYS_kill, watched, SIGKILL);
        }
        if (!is_short) return fail();
        return written(descriptor, bytes, length > 1 ? 1 : length, at);
    }
    return written(descriptor, bytes, length, at);
}

ssize_t write(int descriptor, void const* bytes, size_t length) {
    return write_at(descriptor, bytes, length, -1);
}

/* As HDF5 writes. */
ssize_t pwrite(int descriptor, void const* bytes, size_t length, off_t at) {
    return write_at(descriptor, bytes, length, at);
}

int fsync(int descriptor) {
    char place[PATH_MAX];
    if (is_due("fsync", path_of(descriptor, place))) return fail();
    return (int)kernel(SYS_fsync, descriptor);
}

int renameat(int from_folder, char const* from, int to_folder, char const* to) {
    char place[PATH_MAX + NAME_MAX + 2];
    if (is_due("rename", path_at(to_folder, to, place))) return fail();
    return (int)kernel(SYS_renameat2, from_folder, from, to_folder, to, 0);
}

int rename(char const* from, char const* to) {
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

int unlinkat(int folder, char const* name, int flags) {
    char place[PATH_MAX + NAME_MAX + 2];
    if (is_due("unlink", path_at(folder, name, place))) return fail();
    return (int)kernel(SYS_unlinkat, folder, name, flags);
}

int unlink(char const* name) {
    return unlinkat(AT_FDCWD, name, 0);
}

int rmdir(char const* name) {
    return unlinkat(AT_FDCWD, name, AT_REMOVEDIR);
}

int remove(char const* name) {
    int const removed = unlink(name);
    return removed != 0 && errno == EISDIR ? rmdir(name) : removed;
}

int mkdirat(int folder, char const* name, mode_t mode) {
    char place[PATH_MAX + NAME_MAX + 2];
    if (is_due("mkdir", path_at(folder, name, place))) return fail();
    return (int)kernel(SYS_mkdirat, folder, name, mode);
}

int mkdir(char const* name, mode_t mode) {
    return mkdirat(AT_FDCWD, name, mode);
}

int linkat(int from_folder, char const* from, int to_folder, char const* to, int flags) {
    char place[PATH_MAX + NAME_MAX + 2];
    if (is_due("link", path_at(to_folder, to, place))) return fail();
    return (int)kernel(SYS_linkat, from_folder, from, to_folder, to, flags);
}

int link(char const* from, char const* to) {
    return linkat(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int openat(int folder, char const* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t const mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    char place[PATH_MAX + NAME_MAX + 2];
    if (is_due("open", path_at(folder, name, place))) return fail();
    return (int)kernel(SYS_openat, folder, name, flags, mode);
}

int open(char const* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t const mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return openat(AT_FDCWD, name, flags, mode);
}

int open64(char const* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t const mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return openat(AT_FDCWD, name, flags, mode);
}

int openat64(int folder, char const* name, int flags, ...) {
    va_list more;
    va_start(more, flags);
    mode_t const mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return openat(folder, name, flags, mode);
}

pid_t fork(void) {
    REAL(pid_t, "fork", void);
    if (is_due("fork", NULL)) return fail();
    return real();
}

/* The child of a real vfork() would return into a frame that this function has left. */
pid_t vfork(void) {
    return fork();
}

int posix_spawnp(pid_t* child, char const* program, posix_spawn_file_actions_t const* actions,
                 posix_spawnattr_t const* attributes, char* const words[], char* const environment[]) {
    REAL(int, "posix_spawnp", pid_t*, char const*, posix_spawn_file_actions_t const*, posix_spawnattr_t const*,
         char* const[], char* const[]);
    if (is_due("fork", NULL)) return error;
    return real(child, program, actions, attributes, words, environment);
}
