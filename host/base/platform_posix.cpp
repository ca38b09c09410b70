// Linux and macOS. What one of them alone has is marked.
#include "base/platform.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>

#include "base/cpu_clock.h"

#ifdef __APPLE__
extern char** environ;
#endif

namespace jawari::host {

double thread_cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace jawari::host

namespace jawari::host::platform {

// ------------------------------------------------------------ files

namespace {

FileFacts facts_of(const struct stat& status) {
    FileFacts facts{FileKind::Device, static_cast<std::uint64_t>(status.st_size), status.st_mode & 07777U,
                    static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino)};
    if (S_ISREG(status.st_mode)) facts.kind = FileKind::Regular;
    if (S_ISDIR(status.st_mode)) facts.kind = FileKind::Folder;
    if (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode)) facts.kind = FileKind::Pipe;
    return facts;
}

}  // namespace

std::optional<FileFacts> file_facts(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return std::nullopt;
    return facts_of(status);
}

std::optional<FileFacts> file_facts(int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return std::nullopt;
    return facts_of(status);
}

bool may_write(const std::string& path) {
    return access(path.c_str(), W_OK) == 0;
}

int open_to_read(const std::string& path) {
    return open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

int open_to_write(const std::string& path) {
    return open(path.c_str(), O_WRONLY | O_CLOEXEC);
}

int create_file(const std::string& path, bool overwrite) {
    return open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (overwrite ? O_TRUNC : O_EXCL), 0666);
}

int create_temporary_file(std::string& path) {
    return mkostemp(path.data(), O_CLOEXEC);
}

int create_nameless_file() {
#ifdef __linux__
    return memfd_create("jawari", MFD_CLOEXEC);
#else
    std::string path = "/tmp/jawari-XXXXXX";
    const int file = create_temporary_file(path);
    if (file >= 0) remove_file(path.c_str());
    return file;
#endif
}

int open_timer(std::chrono::milliseconds period) {
    const int file = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    if (file < 0) return file;
    itimerspec times{};
    times.it_interval.tv_sec = static_cast<time_t>(period.count() / 1000);
    times.it_interval.tv_nsec = static_cast<long>(period.count() % 1000 * 1000000);
    times.it_value = times.it_interval;
    if (timerfd_settime(file, 0, &times, nullptr) == 0) return file;
    close(file);
    return -1;
}

int open_nothing() {
    return open("/dev/null", O_RDWR | O_CLOEXEC);
}

int duplicate(int file) {
    return dup(file);
}

int descriptor_of(std::FILE* file) {
    return fileno(file);
}

/// Asked once: the mask can only be read by setting it, which two threads must not do at a time.
unsigned ordinary_permissions() {
    static const unsigned permissions = [] {
        const mode_t mask = umask(0);
        umask(mask);
        return 0666U & ~static_cast<unsigned>(mask);
    }();
    return permissions;
}

bool set_permissions(int file, unsigned permissions) {
    return fchmod(file, static_cast<mode_t>(permissions)) == 0;
}

bool redirect(int file, int target) {
    return dup2(target, file) >= 0;
}

std::ptrdiff_t read_some(int file, std::span<char> bytes) {
    return read(file, bytes.data(), bytes.size());
}

std::ptrdiff_t write_some(int file, std::string_view bytes) {
    return write(file, bytes.data(), bytes.size());
}

std::ptrdiff_t read_some_at(int file, std::uint64_t offset, std::span<char> bytes) {
    return pread(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
}

std::ptrdiff_t write_some_at(int file, std::uint64_t offset, std::string_view bytes) {
    return pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
}

#ifdef __APPLE__
// fsync() of macOS leaves the content in the disk's own memory.
bool flush_to_disk(int file) {
    return fcntl(file, F_FULLFSYNC) == 0 || fsync(file) == 0;
}

bool flush_content_to_disk(int file) {
    return flush_to_disk(file);
}
#else
bool flush_to_disk(int file) {
    return fsync(file) == 0;
}

bool flush_content_to_disk(int file) {
    return fdatasync(file) == 0;
}
#endif

bool close_file(int file) {
    return close(file) == 0;
}

void remove_file(const char* path) noexcept {
    unlink(path);
}

// ------------------------------------------------------------ the process and others

namespace {

std::atomic<void (*)(EndRequest)> end_handler{nullptr};
static_assert(std::atomic<void (*)(EndRequest)>::is_always_lock_free);

extern "C" void on_signal(int signal) {
    auto* const handler = end_handler.load();
    if (signal == SIGHUP) handler(EndRequest::HangUp);
    if (signal == SIGINT) handler(EndRequest::Interrupt);
    if (signal == SIGTERM) handler(EndRequest::Terminate);
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

int signal_of(EndRequest request) {
    switch (request) {
        case EndRequest::HangUp:
            return SIGHUP;
        case EndRequest::Terminate:
            return SIGTERM;
        case EndRequest::None:
        case EndRequest::Interrupt:
            break;
    }
    return SIGINT;
}

}  // namespace

void on_end_request(void (*handler)(EndRequest request)) {
    end_handler.store(handler);
    handle(SIGINT, on_signal);
    handle(SIGTERM, on_signal);
    if (!is_ignored(SIGHUP)) handle(SIGHUP, on_signal);
    handle(SIGPIPE, SIG_IGN);
    handle(SIGXFSZ, SIG_IGN);
}

void end_at_once(EndRequest request) noexcept {
    _exit(128 + signal_of(request));
}

ProgramEnd run_program(const std::vector<std::string>& arguments, int input, int output, int error) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, standard_input);
    posix_spawn_file_actions_adddup2(&actions, output, standard_output);
    posix_spawn_file_actions_adddup2(&actions, error, standard_error);
    std::vector<std::string> words = arguments;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ProgramEnd end;
    pid_t child = 0;
    end.start_error = posix_spawnp(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (end.start_error != 0) return end;
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    end.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return end;
}

std::string become_program(const std::vector<std::string>& arguments) {
    std::vector<std::string> words = arguments;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(pointers.front(), pointers.data());
    return std::strerror(errno);
}

std::string own_path() {
    std::string path(longest_path_bytes, '\0');
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size());
    if (length <= 0) return {};
    path.resize(static_cast<std::size_t>(length));
    return path;
}

std::string path_of_code(const void* address) {
    Dl_info facts{};
    if (dladdr(address, &facts) == 0 || facts.dli_fname == nullptr) return {};
    const std::string path = facts.dli_fname;
    // A program is named as it was called.
    return path.find('/') == std::string::npos || path.front() != '/' ? std::string() : path;
}

LoadedFunction load_function(const std::string& module, const char* name) {
    const auto trouble = [] {
        const char* const why = dlerror();
        return std::string(why == nullptr ? "unknown" : why);
    };
    void* const loaded = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (loaded == nullptr) return {nullptr, trouble()};
    void* const found = dlsym(loaded, name);
    if (found == nullptr) return {nullptr, trouble()};
    return {reinterpret_cast<void (*)()>(found), {}};
}

void set_environment(const std::string& name, const std::string& value) {
    setenv(name.c_str(), value.c_str(), 1);
}

bool lock_memory() {
    return mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
}

int own_real_time_priority() {
    int policy = 0;
    sched_param parameters{};
    if (pthread_getschedparam(pthread_self(), &policy, &parameters) != 0) return 0;
    return policy == SCHED_FIFO || policy == SCHED_RR ? parameters.sched_priority : 0;
}

/// Linux. Processors of 64-bit ARM have no name there; the machine they sit in may.
std::string processor_name() {
    std::ifstream processors("/proc/cpuinfo");
    for (std::string text; std::getline(processors, text);) {
        const std::size_t colon = text.find(": ");
        if (text.starts_with("model name") && colon != std::string::npos) return text.substr(colon + 2);
    }
    std::ifstream machine("/proc/device-tree/model");
    std::string name;
    if (std::getline(machine, name, '\0') && !name.empty()) return name;
    return "unknown";
}

// ------------------------------------------------------------ the terminal

bool is_terminal(int file) {
    return isatty(file) == 1;
}

std::optional<std::size_t> terminal_columns(int file) {
    winsize size{};
    if (ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
    return size.ws_col;
}

bool wait_for_input(std::span<Input> inputs, std::chrono::milliseconds longest) {
    std::vector<pollfd> waits;
    for (const Input& input : inputs) waits.push_back({input.file, POLLIN, 0});
    const bool any =
        poll(waits.data(), static_cast<nfds_t>(waits.size()), static_cast<int>(longest.count())) > 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        inputs[i].ready = any && waits[i].revents != 0;
        inputs[i].hung_up = any && (waits[i].revents & (POLLHUP | POLLERR)) != 0;
    }
    return any;
}

// ------------------------------------------------------------ folders

namespace {

std::string environment(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets variables
    return value == nullptr ? std::string() : std::string(value);
}

/// The variable if it is an absolute path, else a folder in the home folder, else nothing.
std::string base_folder(const char* variable, const char* below_home) {
    std::string value = environment(variable);
    if (value.starts_with('/')) return value;
    const std::string home = environment("HOME");
    return home.starts_with('/') ? home + below_home : std::string();
}

}  // namespace

std::string user_folder(UserFolder folder) {
    switch (folder) {
        case UserFolder::Configuration:
            return base_folder("XDG_CONFIG_HOME", "/.config");
        case UserFolder::Data:
            return base_folder("XDG_DATA_HOME", "/.local/share");
        case UserFolder::State:
            break;
    }
    return base_folder("XDG_STATE_HOME", "/.local/state");
}

std::vector<std::string> system_data_folders() {
    std::string all = environment("XDG_DATA_DIRS");
    if (all.empty()) all = "/usr/local/share:/usr/share";
    std::vector<std::string> folders;
    for (std::size_t begin = 0; begin <= all.size();) {
        const std::size_t end = std::min(all.find(':', begin), all.size());
        if (all[begin] == '/') folders.push_back(all.substr(begin, end - begin));
        begin = end + 1;
    }
    return folders;
}

// ------------------------------------------------------------ datagrams

namespace {

#ifdef MSG_NOSIGNAL
constexpr int send_flags = MSG_DONTWAIT | MSG_NOSIGNAL;
#else
constexpr int send_flags = MSG_DONTWAIT;  // macOS; on_end_request() ignores the signal
#endif

sockaddr_in socket_address(const NetworkAddress& address) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(address.port);
    result.sin_addr.s_addr = htonl(address.host);
    return result;
}

}  // namespace

std::optional<std::uint32_t> host_address(const std::string& text) {
    in_addr address{};
    if (inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
    return ntohl(address.s_addr);
}

int open_datagram_socket(const NetworkAddress& address) {
    const int opened = socket(AF_INET, SOCK_DGRAM, 0);
    if (opened < 0) return -1;
    const sockaddr_in own = socket_address(address);
    if (fcntl(opened, F_SETFD, FD_CLOEXEC) == 0 && fcntl(opened, F_SETFL, O_NONBLOCK) == 0 &&
        bind(opened, reinterpret_cast<const sockaddr*>(&own), sizeof own) == 0)
        return opened;
    const int reason = errno;
    close(opened);
    errno = reason;
    return -1;
}

void close_socket(int socket) {
    close(socket);
}

std::ptrdiff_t receive_datagram(int socket, std::span<char> bytes, NetworkAddress& sender) {
    sockaddr_in address{};
    socklen_t address_size = sizeof address;
    const ssize_t size = recvfrom(socket, bytes.data(), bytes.size(), MSG_DONTWAIT,
                                  reinterpret_cast<sockaddr*>(&address), &address_size);
    sender = {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
    return size;
}

void send_datagram(int socket, std::span<const char> bytes, const NetworkAddress& receiver) {
    const sockaddr_in address = socket_address(receiver);
    (void)sendto(socket, bytes.data(), bytes.size(), send_flags, reinterpret_cast<const sockaddr*>(&address),
                 sizeof address);
}

}  // namespace jawari::host::platform
