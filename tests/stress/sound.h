// What an instrument has played so far, piece by piece.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "instrument_watch.h"
#include "jawari/instrument/render.h"

namespace jawari::stress {

struct Sound {
    std::vector<double> left, right;

    /// Room for `frames` more, valid until the next call.
    InstrumentOutput append(std::size_t frames) {
        left.resize(left.size() + frames);
        right.resize(right.size() + frames);
        return {left.data() + left.size() - frames, right.data() + right.size() - frames, {}};
    }
    [[nodiscard]] Piece tail(std::size_t frames) const {
        return {std::span(left).last(frames), std::span(right).last(frames)};
    }
};

}  // namespace jawari::stress
