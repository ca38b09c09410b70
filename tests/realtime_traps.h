// Traps for what rendering must not do: take memory, take a lock, ask the system. Included by one source file
// of a test program, for it replaces functions of the C library. JAWARI_TRAPS is defined where allocations
// and locks are trapped, JAWARI_TRAPS_SYSTEM_CALLS where system calls are.
#pragma once

// Sanitizers replace the allocator themselves and make system calls of their own.
#include <cstddef>
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define JAWARI_TRAPS 1
#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>
#if defined(__linux__) && defined(__x86_64__)
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/wait.h>

#include <csignal>
#include <cstddef>
#define JAWARI_TRAPS_SYSTEM_CALLS 1
#endif

namespace {

thread_local bool trapping = false;
thread_local unsigned long allocations = 0;
thread_local unsigned long locks = 0;

void note_allocation() {
    if (trapping) allocations += 1;
}

/// Of the C library, behind the functions below.
template <class Function>
Function* behind(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// The C++ operators, aligned or not, end here as well.
extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
    note_allocation();
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    note_allocation();
    return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
    note_allocation();
    return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    note_allocation();
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    note_allocation();
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
    note_allocation();
    *block = __libc_memalign(alignment, size);
    return *block == nullptr ? 12 : 0;  // ENOMEM
}
void free(void* block) {
    if (block != nullptr) note_allocation();
    __libc_free(block);
}
}

#define JAWARI_TRAP_LOCK(function, type)                                    \
    int function(type* lock) noexcept {                                     \
        static int (*real)(type*) noexcept = nullptr;                       \
        if (real == nullptr) real = behind<int(type*) noexcept>(#function); \
        if (trapping) locks += 1;                                           \
        return real(lock);                                                  \
    }
extern "C" {
JAWARI_TRAP_LOCK(pthread_mutex_lock, pthread_mutex_t)
JAWARI_TRAP_LOCK(pthread_mutex_trylock, pthread_mutex_t)
JAWARI_TRAP_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
JAWARI_TRAP_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
}
#undef JAWARI_TRAP_LOCK

namespace jawari::test {
namespace {

/// While it lives, this thread's allocations and locks are counted.
struct Trap {
    Trap() {
        allocations = 0;
        locks = 0;
        trapping = true;
    }
    ~Trap() { trapping = false; }
    Trap(const Trap&) = delete;
    Trap& operator=(const Trap&) = delete;
};

/// Keeps the compiler from leaving an allocation out.
template <class T>
T* used(T* pointer) {
    asm volatile("" : "+r"(pointer) : : "memory");
    return pointer;
}

#ifdef JAWARI_TRAPS_SYSTEM_CALLS

volatile std::sig_atomic_t system_calls = 0;

/// In this thread (and those that it starts) from now on, every system call but leaving raises SIGSYS, which
/// counts, and is not made.
bool trap_system_calls() {
    struct sigaction action = {};
    action.sa_handler = [](int) { system_calls = system_calls + 1; };
    action.sa_flags = SA_NODEFER;
    if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
    sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 1, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
    };
    const sock_fprog program{sizeof filter / sizeof *filter, filter};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

#endif

}  // namespace
}  // namespace jawari::test

#endif
