/* An ALSA sequencer that nothing is connected to, for programs that do not start without one: preloaded, it
   takes the place of the device /dev/snd/seq where the kernel has none. What is sent to it is swallowed; its
   queues stand still. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <sound/asequencer.h>
#include <stdarg.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/types.h>

enum { own_client = 128 };

static int device = -1;
static int ports = 0;
static int queues = 0;
static struct snd_seq_queue_tempo tempo = {.tempo = 500000, .ppq = 96};

/* A file that never has anything to read. */
static int open_device(void) {
    if (device < 0) device = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    return device;
}

static int is_device(const char* path) {
    return path != NULL && strcmp(path, "/dev/snd/seq") == 0;
}

/* The function of that name that comes after this file's, as a variable. */
#define NEXT(TYPE, NAME) TYPE = (__typeof__(next))dlsym(RTLD_NEXT, NAME)

static int open_next(const char* name, const char* path, int flags, mode_t mode) {
    NEXT(int (*next)(const char*, int, ...), name);
    return next(path, flags, mode);
}

#define OPEN(NAME)                                                                      \
    int NAME(const char* path, int flags, ...) {                                        \
        va_list list;                                                                   \
        va_start(list, flags);                                                          \
        const int creates = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE; \
        const mode_t mode = creates ? va_arg(list, mode_t) : 0;                         \
        va_end(list);                                                                   \
        return is_device(path) ? open_device() : open_next(#NAME, path, flags, mode);   \
    }
OPEN(open)
OPEN(open64)

int __open_2(const char* path, int flags) {
    return is_device(path) ? open_device() : open_next("open", path, flags, 0);
}

int __open64_2(const char* path, int flags) {
    return is_device(path) ? open_device() : open_next("open64", path, flags, 0);
}

ssize_t write(int file, const void* bytes, size_t count) {
    if (file >= 0 && file == device) return (ssize_t)count;
    NEXT(ssize_t(*next)(int, const void*, size_t), "write");
    return next(file, bytes, count);
}

static void create_port(struct snd_seq_port_info* port) {
    port->addr.client = own_client;
    port->addr.port = (unsigned char)ports++;
}

static void create_queue(struct snd_seq_queue_info* queue) {
    queue->queue = queues++;
    queue->owner = own_client;
}

static int ask_device(unsigned long request, void* place) {
    switch (request) {
        case SNDRV_SEQ_IOCTL_PVERSION:
            *(int*)place = SNDRV_SEQ_VERSION;
            return 0;
        case SNDRV_SEQ_IOCTL_CLIENT_ID:
            *(int*)place = own_client;
            return 0;
        case SNDRV_SEQ_IOCTL_CREATE_PORT:
            create_port(place);
            return 0;
        case SNDRV_SEQ_IOCTL_CREATE_QUEUE:
            create_queue(place);
            return 0;
        case SNDRV_SEQ_IOCTL_SET_QUEUE_TEMPO:
            tempo = *(struct snd_seq_queue_tempo*)place;
            return 0;
        case SNDRV_SEQ_IOCTL_GET_QUEUE_TEMPO: {
            const int queue = ((struct snd_seq_queue_tempo*)place)->queue;
            *(struct snd_seq_queue_tempo*)place = tempo;
            ((struct snd_seq_queue_tempo*)place)->queue = queue;
            return 0;
        }
        case SNDRV_SEQ_IOCTL_QUERY_NEXT_CLIENT:
        case SNDRV_SEQ_IOCTL_QUERY_NEXT_PORT:
        case SNDRV_SEQ_IOCTL_QUERY_SUBS:
        case SNDRV_SEQ_IOCTL_SUBSCRIBE_PORT:
        case SNDRV_SEQ_IOCTL_UNSUBSCRIBE_PORT:
            errno = ENOENT;
            return -1;
        default:
            return 0;
    }
}

int ioctl(int file, unsigned long request, ...) {
    va_list list;
    va_start(list, request);
    void* const place = va_arg(list, void*);
    va_end(list);
    if (file >= 0 && file == device) return ask_device(request, place);
    NEXT(int (*next)(int, unsigned long, ...), "ioctl");
    return next(file, request, place);
}
