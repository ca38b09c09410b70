// A demo piece as `jawari render` makes it, and the same played into a plugin.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "formats/midi_file/midi_file.h"
#include "support/read_wav.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace jawari::test {

struct RenderedPiece {
    host::MidiFile file;
    std::vector<double> left, right;
};

/// At 48000 Hz, with further options of the program.
inline RenderedPiece render_piece(const std::string& piece, const std::string& preset,
                                  const std::vector<std::string>& options) {
    const TemporaryFolder folder;
    const std::string midi = std::string(JAWARI_SOURCE_DIR) + "/presets/demo/" + piece + ".mid";
    const std::string wav = folder.file("render.wav");
    std::vector<std::string> command{JAWARI_PROGRAM, "render", midi, "--preset", preset, "--format", "float"};
    command.insert(command.end(), options.begin(), options.end());
    command.insert(command.end(), {"-o", wav});
    const auto ran = run(command);
    if (ran.exit_code != 0) throw std::runtime_error(ran.err);
    const Wav rendered = read_wav(wav);
    const std::string bytes = read_text(midi);
    const auto file = host::parse_midi({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return {file.value(), rendered.channel(0), rendered.channel(1)};
}

/// In blocks of random lengths; send(event, frame of the block) hands over each channel message.
template <class Instance, class Send>
void play_piece(Instance& one, const host::MidiFile& file, std::size_t frames, Send send) {
    std::mt19937 random(11);
    std::size_t next = 0, done = 0;
    while (done < frames) {
        const auto block = static_cast<std::uint32_t>(std::min<std::size_t>(random() % 1500, frames - done));
        for (; next < file.events.size(); ++next) {
            const host::MidiEvent& event = file.events[next];
            const auto frame = frame_of(file, event.time, 48000);
            if (frame >= done + block) break;
            if (event.status >= 0x80 && event.status < 0xF0)
                send(event, static_cast<std::uint32_t>(frame - done));
        }
        one.process(block);
        done += block;
    }
}

/// The first `frames` of what a plugin has played are those of the program, and there is sound in them.
template <class Instance>
void expect_equal(const Instance& one, const RenderedPiece& rendered, std::size_t frames) {
    ASSERT_GT(rendered.left.size(), frames);
    double loud = 0;
    for (std::size_t n = 0; n < frames; ++n) {
        ASSERT_EQ(static_cast<double>(one.left[n]), rendered.left[n]) << n;
        ASSERT_EQ(static_cast<double>(one.right[n]), rendered.right[n]) << n;
        loud = std::max(loud, std::abs(rendered.left[n]));
    }
    EXPECT_GT(loud, 1e-3);
}

}  // namespace jawari::test
