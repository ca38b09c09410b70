// What the host asks of the operating system beyond the C++ library. Nothing else in the host includes a
// header of the system (cmake/check_layers.cmake): another system is another implementation of this file
// beside platform_posix.cpp.
//
// Files are numbers, as in the C library of every system. A call that fails leaves its reason in errno.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jawari::host::platform {

// ------------------------------------------------------------ files

inline constexpr int standard_input = 0;
inline constexpr int standard_output = 1;
inline constexpr int standard_error = 2;

enum class FileKind { Regular, Folder, Pipe, Device };  ///< sockets count as pipes

struct FileFacts {
    FileKind kind = FileKind::Regular;
    std::uint64_t bytes = 0;
    unsigned permissions = 0;
    std::uint64_t device = 0, number = 0;  ///< the same for all names of one file, and for no other
};

std::optional<FileFacts> file_facts(const std::string& path);
std::optional<FileFacts> file_facts(int file);
bool may_write(const std::string& path);

/// Descriptors; below zero: failed. Programs that are started do not inherit them.
int open_to_read(const std::string& path);
int open_to_write(const std::string& path);
/// Opens a file for writing in place; one that is there already is an error (EEXIST) unless `overwrite`.
int create_file(const std::string& path, bool overwrite);
/// `path` ends in XXXXXX, which becomes what makes it a new name. Readable by its owner alone.
int create_temporary_file(std::string& path);
/// For reading and writing; gone once closed.
int create_nameless_file();
/// Swallows what is written, has nothing to read.
int open_nothing();
/// Becomes readable once a period, until it is read (8 bytes); reading it does not wait.
int open_timer(std::chrono::milliseconds period);
int duplicate(int file);
int descriptor_of(std::FILE* file);

/// Of a file that open_to_write() and its like would create.
unsigned ordinary_permissions();
bool set_permissions(int file, unsigned permissions);
/// What is written to `file` goes to `target` from now on.
bool redirect(int file, int target);

/// The count, 0 at the end, below zero if it failed; a signal ends the wait with EINTR.
std::ptrdiff_t read_some(int file, std::span<char> bytes);
std::ptrdiff_t write_some(int file, std::string_view bytes);
/// The same at an offset from the start; the position of the others stays.
std::ptrdiff_t read_some_at(int file, std::uint64_t offset, std::span<char> bytes);
std::ptrdiff_t write_some_at(int file, std::uint64_t offset, std::string_view bytes);

/// Returns when the disk has everything.
bool flush_to_disk(int file);
/// The same without times and other facts that reading the content does not need.
bool flush_content_to_disk(int file);
bool close_file(int file);
/// May be called in the handler of on_end_request().
void remove_file(const char* path) noexcept;

inline constexpr std::size_t longest_path_bytes = 4096;

// ------------------------------------------------------------ the process and others

/// What the user or the system wants by a signal.
enum class EndRequest : int { None, HangUp, Interrupt, Terminate };

/// From now on `handler` is called for each, at any time and in any thread: it may use lock-free atomics,
/// remove_file() and end_at_once(). Hanging up stays ignored if it is (nohup). Writing to a closed pipe or
/// beyond the largest file is an error of the write instead of the end of the process.
void on_end_request(void (*handler)(EndRequest request));

/// Without destructors; the exit code is 128 + the signal.
[[noreturn]] void end_at_once(EndRequest request) noexcept;

struct ProgramEnd {
    int start_error = 0;  ///< errno of a program that could not be started
    bool succeeded = false;
};

/// Looks the program up in PATH, runs it with three descriptors as its standard ones, and waits for its end.
/// The first argument is its name.
ProgramEnd run_program(const std::vector<std::string>& arguments, int input, int output, int error);

/// This process becomes the program, with the arguments of run_program(). Returns only if it cannot be
/// started: why.
std::string become_program(const std::vector<std::string>& arguments);

/// Of this program's file; empty if the system does not say.
std::string own_path();

/// Of the program or module that has the code at `address`; empty if the system does not say.
std::string path_of_code(const void* address);

struct LoadedFunction {
    void (*found)() = nullptr;  ///< null: there is none
    std::string trouble;        ///< why
};

/// Of a module that stays loaded from now on; its other names stay its own.
LoadedFunction load_function(const std::string& module, const char* name);

/// Of this process and of what it starts or becomes.
void set_environment(const std::string& name, const std::string& value);

/// Keeps all pages in memory, now and later.
bool lock_memory();

/// 0 for a thread that is scheduled as others are.
int own_real_time_priority();

/// "unknown" if the system does not say.
std::string processor_name();

// ------------------------------------------------------------ the terminal

bool is_terminal(int file);
/// Nothing if `file` is no terminal or does not know.
std::optional<std::size_t> terminal_columns(int file);

struct Input {
    int file = -1;  ///< below zero: left out
    bool ready = false;
    bool hung_up = false;
};

/// Waits until one of the files can be read or has ended; false after `longest`, or when a signal came.
bool wait_for_input(std::span<Input> inputs, std::chrono::milliseconds longest);

// ------------------------------------------------------------ folders

enum class UserFolder { Configuration, Data, State };

/// XDG Base Directory Specification; empty if there is no home. Paths are absolute.
std::string user_folder(UserFolder folder);
std::vector<std::string> system_data_folders();

// ------------------------------------------------------------ datagrams

/// IPv4, in this machine's order of bytes.
struct NetworkAddress {
    std::uint32_t host = 0;
    std::uint16_t port = 0;
};

/// Of four numbers with dots.
std::optional<std::uint32_t> host_address(const std::string& text);

/// Receives what is sent to `address`; below zero: failed.
int open_datagram_socket(const NetworkAddress& address);
void close_socket(int socket);
/// The size of the next datagram, cut to the buffer; below zero: none has come.
std::ptrdiff_t receive_datagram(int socket, std::span<char> bytes, NetworkAddress& sender);
/// Not delivered if that would take waiting.
void send_datagram(int socket, std::span<const char> bytes, const NetworkAddress& receiver);

}  // namespace jawari::host::platform
