// Runs a program and collects what it says.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace jawari::test {

struct Ran {
    int exit_code = -1;  ///< 1000 + signal if it was killed
    std::string out;
    std::string err;
    long resident_kib = 0;  ///< most memory that it held

    [[nodiscard]] auto error_lines() const { return std::count(err.begin(), err.end(), '\n'); }
};

struct RunOptions {
    std::uint64_t largest_file_bytes = 0;  ///< 0: no bound. A full disk, as far as write() can tell.
    int signal = 0;                        ///< sent to the program ...
    /// ... once this holds (asked again and again, until the program ends)
    std::function<bool()> signal_when = {};
    unsigned signal_after_ms = 0;         ///< ... and after this time
    unsigned signal_after_us = 0;         ///< and this
    std::uint64_t most_memory_bytes = 0;  ///< 0: no bound; of the address space
    bool as_nobody = false;               ///< without the rights of root, if the test has them
};

namespace detail {

inline constexpr unsigned nobody = 65534;

inline void become(const std::vector<std::string>& command, const RunOptions& options, const std::string& out,
                   const std::string& err) {
    const int out_file = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out_file, STDOUT_FILENO);
    dup2(err_file, STDERR_FILENO);
    // Whoever runs the tests may ignore it (nohup), and the program would too.
    std::signal(SIGHUP, SIG_DFL);
    if (options.largest_file_bytes > 0) {
        const rlimit bound{options.largest_file_bytes, options.largest_file_bytes};
        setrlimit(RLIMIT_FSIZE, &bound);
    }
    if (options.most_memory_bytes > 0) {
        const rlimit bound{options.most_memory_bytes, options.most_memory_bytes};
        setrlimit(RLIMIT_AS, &bound);
    }
    if (options.as_nobody && geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
}

inline bool has_ended(pid_t child) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == child;
}

/// Whether the process has said what a signal does to it; before that, a busy machine's first second, it
/// would only die of it.
inline bool catches_or_ignores(pid_t child, int signal) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    std::uint64_t masks = 0;
    for (std::string line; std::getline(status, line);)
        if (line.rfind("SigCgt:", 0) == 0 || line.rfind("SigIgn:", 0) == 0)
            masks |= std::stoull(line.substr(line.find(':') + 1), nullptr, 16);
    return (masks >> (signal - 1) & 1U) != 0;
}

inline void send_signal(pid_t child, const RunOptions& options) {
    while (options.signal != SIGKILL && !catches_or_ignores(child, options.signal) && !has_ended(child))
        usleep(1000);
    while (options.signal_when && !options.signal_when() && !has_ended(child)) usleep(50);
    usleep(options.signal_after_ms * 1000 + options.signal_after_us);
    kill(child, options.signal);
}

}  // namespace detail

inline Ran run(const std::vector<std::string>& command, const RunOptions& options = {}) {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) detail::become(command, options, folder.file("out"), folder.file("err"));
    if (options.signal != 0) detail::send_signal(child, options);
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    Ran ran;
    ran.resident_kib = used.ru_maxrss;
    ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    ran.out = read_text(folder.file("out"));
    ran.err = read_text(folder.file("err"));
    return ran;
}

/// The built program with these arguments.
inline Ran jawari(std::vector<std::string> arguments, const RunOptions& options = {}) {
    arguments.insert(arguments.begin(), JAWARI_PROGRAM);
    return run(arguments, options);
}

/// A Python script of the system's Python, whose packages the project installs.
inline Ran python(const std::string& script, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {JAWARI_PYTHON, "-c", script});
    return run(arguments);
}

}  // namespace jawari::test
