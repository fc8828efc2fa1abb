/* Preloaded into the program under test: the Nth allocation, write or read of the process fails, once.
 * PETZVAL_FAULT is "malloc:N", "write:N" or "read:N" (of regular files); without it calls are counted. With
 * PETZVAL_FAULT_COUNT, the counts are written to that file at the end. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum { ALLOCATION, WRITE, READ, KINDS };
static const char* const names[KINDS] = {"malloc", "write", "read"};
static atomic_long counts[KINDS];
static long failing[KINDS];
static int failing_errno[KINDS] = {ENOMEM, ENOSPC, EIO};

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

__attribute__((constructor)) static void read_environment(void) {
    const char* fault = getenv("PETZVAL_FAULT");
    for (int kind = 0; fault && kind < KINDS; ++kind) {
        const size_t length = strlen(names[kind]);
        if (strncmp(fault, names[kind], length) == 0 && fault[length] == ':')
            failing[kind] = atol(fault + length + 1);
        atomic_store(&counts[kind], 0);
    }
}

__attribute__((destructor)) static void write_counts(void) {
    const char* path = getenv("PETZVAL_FAULT_COUNT");
    FILE* file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    for (int kind = 0; kind < KINDS; ++kind) fprintf(file, "%s %ld\n", names[kind], (long)counts[kind]);
    fclose(file);
}

static int fails(int kind) {
    if (atomic_fetch_add(&counts[kind], 1) + 1 != failing[kind]) return 0;
    errno = failing_errno[kind];
    return 1;
}

void* malloc(size_t size) { return fails(ALLOCATION) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails(ALLOCATION) ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return fails(ALLOCATION) ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) {
    return fails(ALLOCATION) ? NULL : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** to, size_t alignment, size_t size) {
    void* const made = memalign(alignment, size);
    if (made) *to = made;
    return made ? 0 : ENOMEM;
}

/* Standard output and error are not files of the shot. */
static int is_file(int file) {
    struct stat about;
    return file > 2 && fstat(file, &about) == 0 && S_ISREG(about.st_mode);
}

#define REAL(name) __typeof__(&name) real = (__typeof__(&name))dlsym(RTLD_NEXT, #name)
ssize_t write(int file, const void* from, size_t size) {
    REAL(write);
    return is_file(file) && fails(WRITE) ? -1 : real(file, from, size);
}
ssize_t pwrite64(int file, const void* from, size_t size, off64_t at) {
    REAL(pwrite64);
    return is_file(file) && fails(WRITE) ? -1 : real(file, from, size, at);
}
ssize_t pwrite(int file, const void* from, size_t size, off_t at) {
    REAL(pwrite);
    return is_file(file) && fails(WRITE) ? -1 : real(file, from, size, at);
}
int fsync(int file) {
    REAL(fsync);
    return fails(WRITE) ? -1 : real(file);
}
int rename(const char* from, const char* to) {
    REAL(rename);
    return fails(WRITE) ? -1 : real(from, to);
}
ssize_t writev(int file, const struct iovec* from, int count) {
    REAL(writev);
    return is_file(file) && fails(WRITE) ? -1 : real(file, from, count);
}
ssize_t read(int file, void* to, size_t size) {
    REAL(read);
    return is_file(file) && fails(READ) ? -1 : real(file, to, size);
}
ssize_t pread64(int file, void* to, size_t size, off64_t at) {
    REAL(pread64);
    return is_file(file) && fails(READ) ? -1 : real(file, to, size, at);
}
ssize_t pread(int file, void* to, size_t size, off_t at) {
    REAL(pread);
    return is_file(file) && fails(READ) ? -1 : real(file, to, size, at);
}
ssize_t readv(int file, const struct iovec* to, int count) {
    REAL(readv);
    return is_file(file) && fails(READ) ? -1 : real(file, to, count);
}
