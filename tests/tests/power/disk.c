/* A disk that can be filled and cut off, preloaded into a program: what the program does to the files of one folder is
   written down in order, and what the disk has no room for is refused. Syncs cost nothing: they are written down, too. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

/* As in tape.rs. */
enum kind { WRITE = 1, SIZE, MAKE, FOLDER, REMOVE, RENAME, SYNC };

/* What the test sets while the program runs: which of the operations that need room are refused, and whether half of the
   first one is still written. The program counts them. */
struct room { uint64_t seen, from, to, half; };

static const char *folder;
static int tape = -1, is_deaf;
static volatile struct room *room;
static pthread_mutex_t one = PTHREAD_MUTEX_INITIALIZER;

__attribute__((constructor)) static void begin(void)
{
    const char *path;
    folder = getenv("ADIT_DISK_FOLDER");
    is_deaf = getenv("ADIT_DISK_DEAF") != NULL;
    if ((path = getenv("ADIT_DISK_TAPE")))
        tape = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if ((path = getenv("ADIT_DISK_ROOM"))) {
        int file = syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC);
        room = mmap(NULL, sizeof *room, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        close(file);
    }
}

/* The name below the folder, "" for itself; NULL where it is elsewhere. */
static const char *inside(const char *path)
{
    size_t length = folder ? strlen(folder) : 0;
    if (!length || strncmp(path, folder, length)) return NULL;
    return path[length] == '/' ? path + length + 1 : path[length] ? NULL : path + length;
}

static const char *name_of(int file, char path[4096])
{
    char link[32];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = syscall(SYS_readlinkat, AT_FDCWD, link, path, 4095);
    path[length < 0 ? 0 : length] = 0;
    return inside(path);
}

static void note(enum kind kind, const char *name, uint64_t at, const void *data, uint64_t length)
{
    uint64_t head[4] = { kind, strlen(name), at, length };
    struct iovec parts[] = { { head, sizeof head }, { (void *)name, head[1] }, { (void *)data, length } };
    int before = errno;
    if (tape >= 0 && syscall(SYS_writev, tape, parts, 3) != (long)(sizeof head + head[1] + length)) abort();
    errno = before;
}

static int is_full(void)
{
    if (!room) return 0;
    uint64_t now = ++room->seen;
    if (now < room->from || now >= room->to) return 0;
    errno = ENOSPC;
    return 1;
}

static ssize_t put(int file, const void *data, size_t length, off_t at, int is_placed)
{
    char path[4096];
    const char *name = name_of(file, path);
    if (!name) return is_placed ? syscall(SYS_pwrite64, file, data, length, at) : syscall(SYS_write, file, data, length);
    pthread_mutex_lock(&one);
    ssize_t done = -1;
    if (is_full() && !(room->half && room->seen == room->from && length > 1))
        goto end;
    if (room && room->half && room->seen == room->from) length /= 2;
    if (!is_placed)
        at = (fcntl(file, F_GETFL) & O_APPEND) ? lseek(file, 0, SEEK_END) : lseek(file, 0, SEEK_CUR);
    done = is_placed ? syscall(SYS_pwrite64, file, data, length, at) : syscall(SYS_write, file, data, length);
    if (done > 0) note(WRITE, name, at, data, done);
end:
    pthread_mutex_unlock(&one);
    return done;
}

ssize_t write(int file, const void *data, size_t length) { return put(file, data, length, 0, 0); }
ssize_t pwrite(int file, const void *data, size_t length, off_t at) { return put(file, data, length, at, 1); }
ssize_t pwrite64(int file, const void *data, size_t length, off_t at) { return put(file, data, length, at, 1); }

static int sized(int file, off_t size)
{
    char path[4096];
    const char *name = name_of(file, path);
    pthread_mutex_lock(&one);
    int done = syscall(SYS_ftruncate, file, size);
    if (!done && name) note(SIZE, name, size, "", 0);
    pthread_mutex_unlock(&one);
    return done;
}

int ftruncate(int file, off_t size) { return sized(file, size); }
int ftruncate64(int file, off_t size) { return sized(file, size); }

static int synced(int file)
{
    char path[4096];
    const char *name = name_of(file, path);
    if (!name) return 0;
    pthread_mutex_lock(&one);
    int done = is_full() ? -1 : 0;
    if (!done && !is_deaf) note(SYNC, name, 0, "", 0);
    pthread_mutex_unlock(&one);
    return done;
}

int fsync(int file) { return synced(file); }
int fdatasync(int file) { return synced(file); }

static int opened(int beside, const char *path, int flags, mode_t mode)
{
    const char *name = inside(path);
    if (!name) return syscall(SYS_openat, beside, path, flags, mode);
    pthread_mutex_lock(&one);
    int is_new = (flags & O_CREAT) && syscall(SYS_faccessat, beside, path, F_OK);
    int file = is_new && is_full() ? -1 : syscall(SYS_openat, beside, path, flags, mode);
    if (file >= 0 && is_new) note(MAKE, name, 0, "", 0);
    if (file >= 0 && (flags & O_TRUNC)) note(SIZE, name, 0, "", 0);
    pthread_mutex_unlock(&one);
    return file;
}

#define OPEN(beside) \
    va_list more; \
    va_start(more, flags); \
    mode_t mode = va_arg(more, mode_t); \
    va_end(more); \
    return opened(beside, path, flags, mode);

int open(const char *path, int flags, ...) { OPEN(AT_FDCWD) }
int open64(const char *path, int flags, ...) { OPEN(AT_FDCWD) }
int openat(int beside, const char *path, int flags, ...) { OPEN(beside) }
int openat64(int beside, const char *path, int flags, ...) { OPEN(beside) }

/* What changes a folder: done and written down in one go. */
#define NAMED(kind, path, data, needs_room, call) \
    const char *name = inside(path); \
    pthread_mutex_lock(&one); \
    int done = name && needs_room && is_full() ? -1 : call; \
    if (!done && name) note(kind, name, 0, data, strlen(data)); \
    pthread_mutex_unlock(&one); \
    return done;

int mkdir(const char *path, mode_t mode) { NAMED(FOLDER, path, "", 1, syscall(SYS_mkdirat, AT_FDCWD, path, mode)) }
int unlink(const char *path) { NAMED(REMOVE, path, "", 0, syscall(SYS_unlinkat, AT_FDCWD, path, 0)) }
int rename(const char *path, const char *to)
{
    const char *next = inside(to);
    if (!next) next = "";
    NAMED(RENAME, path, next, 0, syscall(SYS_renameat2, AT_FDCWD, path, AT_FDCWD, to, 0))
}
