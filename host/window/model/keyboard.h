// The keys of a piano in a box, and which of them lies under a point.
#pragma once

#include <optional>
#include <vector>

#include "window/model/layout.h"

namespace jawari::host::window {

struct PianoKey {
    int key = 0;  ///< MIDI note number
    bool black = false;
    Box box;
};

/// White keys first, then the black ones that lie on them. `lowest` to `highest`, widened to whole octaves
/// from C to B and to two octaves at least. Threads: any.
std::vector<PianoKey> piano_keys(const Box& box, int lowest, int highest);

/// Nothing outside the keys. Threads: any.
std::optional<int> key_at(const std::vector<PianoKey>& keys, float x, float y);

/// How hard a key is struck there, 0.2 to 1: harder towards its front edge. Threads: any.
double velocity_at(const PianoKey& key, float y);

}  // namespace jawari::host::window
