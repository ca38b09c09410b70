// Exit codes of the program, documented in docs/commands/exit-codes.md.
#pragma once

namespace jawari::host {

enum class ExitCode : int {
    Ok = 0,
    Usage = 2,         ///< wrong command line
    InvalidInput = 3,  ///< a scene, preset or MIDI file says something that is not allowed
    File = 4,          ///< a file cannot be read or written
    Internal = 5,      ///< a defect of the program, or out of memory
    Device = 6,        ///< an audio or MIDI device or its driver cannot be used, or was lost
    HungUp = 129,      ///< the terminal is gone
    Interrupted = 130,
    Terminated = 143
};

}  // namespace jawari::host
