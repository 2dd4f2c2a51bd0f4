/* Makes one call of a program to the disk fail, for bench/bench_attacks.py:

       cc -shared -fPIC -O1 -o failing.so failing.c -ldl
       FAIL_AT=17 FAIL_ERRNO=28 LD_PRELOAD=./failing.so PROGRAM ...

   Counted are calls that write, cut, sync, close or rename a regular file, or sync a folder. FAIL_AT: which of
   them fails, once; 0 = none. FAIL_EVERY: each k-th does. FAIL_ERRNO: with what (5 = EIO, 28 = ENOSPC), or -1: a
   write that writes half and says so. FAIL_READ=1: files that were only read are closed with an error, too.
   FAIL_LOCKS=1: flock fails with ENOLCK. FAIL_COUNT: a file that gets the number of calls at the end. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static int counted;

static int number_in(const char* name) {
    const char* text = getenv(name);
    return text ? atoi(text) : 0;
}

/* Whether this call is the one. */
static int is_chosen(void) {
    const int number = __atomic_add_fetch(&counted, 1, __ATOMIC_SEQ_CST), every = number_in("FAIL_EVERY");
    return number == number_in("FAIL_AT") || (every > 0 && number % every == 0);
}

static int fails(int file, int with_folders) {
    struct stat state;
    if (syscall(SYS_fstat, file, &state) != 0) return 0;
    if (!S_ISREG(state.st_mode) && !(with_folders && S_ISDIR(state.st_mode))) return 0;
    return is_chosen();
}

static int refused(void) {
    const int error = number_in("FAIL_ERRNO");
    errno = error > 0 ? error : EIO;
    return -1;
}

static int is_half(size_t bytes) { return number_in("FAIL_ERRNO") < 0 && bytes > 1; }

ssize_t write(int file, const void* data, size_t bytes) {
    if (!fails(file, 0)) return syscall(SYS_write, file, data, bytes);
    return is_half(bytes) ? syscall(SYS_write, file, data, bytes / 2) : refused();
}

ssize_t pwrite64(int file, const void* data, size_t bytes, off64_t at) {
    if (!fails(file, 0)) return syscall(SYS_pwrite64, file, data, bytes, at);
    return is_half(bytes) ? syscall(SYS_pwrite64, file, data, bytes / 2, at) : refused();
}

ssize_t pwrite(int file, const void* data, size_t bytes, off_t at) { return pwrite64(file, data, bytes, at); }

ssize_t writev(int file, const struct iovec* parts, int n) {
    return fails(file, 0) ? refused() : syscall(SYS_writev, file, parts, n);
}

int fsync(int file) { return fails(file, 1) ? refused() : (int)syscall(SYS_fsync, file); }

int fdatasync(int file) { return fails(file, 1) ? refused() : (int)syscall(SYS_fdatasync, file); }

int ftruncate64(int file, off64_t size) {
    return fails(file, 0) ? refused() : (int)syscall(SYS_ftruncate, file, size);
}

int ftruncate(int file, off_t size) { return ftruncate64(file, size); }

/* It is closed all the same, as Linux does. */
int close(int file) {
    const int flags = (int)syscall(SYS_fcntl, file, F_GETFL);
    const int failed = flags >= 0 && ((flags & O_ACCMODE) != O_RDONLY || number_in("FAIL_READ")) && fails(file, 0);
    const int result = (int)syscall(SYS_close, file);
    return failed ? refused() : result;
}

int rename(const char* from, const char* to) {
    return is_chosen() ? refused() : (int)syscall(SYS_rename, from, to);
}

int renameat(int at, const char* from, int there, const char* to) {
    return is_chosen() ? refused() : (int)syscall(SYS_renameat2, at, from, there, to, 0);
}

int renameat2(int at, const char* from, int there, const char* to, unsigned flags) {
    return is_chosen() ? refused() : (int)syscall(SYS_renameat2, at, from, there, to, flags);
}

int flock(int file, int operation) {
    if (!number_in("FAIL_LOCKS")) return (int)syscall(SYS_flock, file, operation);
    errno = ENOLCK;
    return -1;
}

__attribute__((destructor)) static void tell(void) {
    const char* name = getenv("FAIL_COUNT");
    if (!name) return;
    char text[32];
    const int n = snprintf(text, sizeof text, "%d\n", counted);
    const int file = (int)syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    syscall(SYS_write, file, text, n);
    syscall(SYS_close, file);
}
