// What a stage is told at its start.
#pragma once

#include <cstddef>

#include "midi/interpreter.h"

namespace jawari::host {

class StageLink;

struct StageSettings {
    double rate_hz = 48000;          ///< of the instruments, 8000 to 384000 [Hz]
    std::size_t most_frames = 1024;  ///< of one Stage::render()
    InterpreterSettings interpreter;
    double gain = 1;              ///< factor of everything, 0 or more
    double ring_out_s = 10;       ///< longest time that an instrument sounds on after another took its place
    bool string_outputs = false;  ///< instruments have room for the sound of each string
    StageLink* link = nullptr;    ///< to a window; null: there is none
};

}  // namespace jawari::host
