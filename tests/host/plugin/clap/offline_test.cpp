// What a host hears of a MIDI file through the plugin is what `jawari render` makes of it, bit for bit.
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <utility>

#include "support/clap_host.h"
#include "support/rendered_piece.h"

namespace jawari::host {
namespace {

using test::ClapInstance;

struct Piece {
    const char* midi;
    const char* preset;
    double seconds;
};

class ClapEqualsRender : public testing::TestWithParam<Piece> {};

enum class Dialect { Midi, Notes, NotesWithIds };

/// A host that sends its notes in a dialect; all else goes as MIDI.
class Sender {
  public:
    Sender(ClapInstance& one, Dialect dialect) : one_(one), dialect_(dialect) {}

    void send(const MidiEvent& event, std::uint32_t time) {
        const int channel = event.status & 0x0F;
        const int kind = event.status & 0xF0;
        if (dialect_ == Dialect::Midi || (kind != 0x80 && kind != 0x90)) {
            one_.events.midi(time, event.status, event.data1, event.data2);
            return;
        }
        std::deque<std::int32_t>& open = open_[{channel, event.data1}];
        if (kind == 0x90 && event.data2 > 0) {
            open.push_back(dialect_ == Dialect::Notes ? -1 : next_id_++);
            one_.events.note_on(time, event.data1, event.data2 / 127.0, open.back(), channel);
            return;
        }
        const double release = kind == 0x80 ? event.data2 / 127.0 : 0.5;
        one_.events.note(CLAP_EVENT_NOTE_OFF, time, event.data1, release, open.empty() ? -1 : open.front(),
                         channel);
        if (!open.empty()) open.pop_front();
    }

  private:
    ClapInstance& one_;
    Dialect dialect_;
    std::map<std::pair<int, int>, std::deque<std::int32_t>> open_;
    std::int32_t next_id_ = 1;
};

TEST_P(ClapEqualsRender, BitForBit) {
    const Piece piece = GetParam();
    const test::RenderedPiece rendered =
        test::render_piece(piece.midi, piece.preset, {"--set", "palm_mute=0.2", "--set", "volume=0.7"});
    const auto frames = static_cast<std::size_t>(piece.seconds * 48000);
    for (const Dialect dialect : {Dialect::Midi, Dialect::Notes, Dialect::NotesWithIds}) {
        SCOPED_TRACE(static_cast<int>(dialect));
        ClapInstance one;
        const auto& loader = one.get<clap::PluginPresetLoad>(clap::preset_load_id);
        ASSERT_TRUE(loader.from_location(one.plugin, clap::location_plugin, nullptr, piece.preset));
        ASSERT_TRUE(one.activate(48000, 512));
        one.events.parameter(0, 6, 0.2);
        one.events.parameter(0, 0, 0.7);
        Sender sender(one, dialect);
        test::play_piece(one, rendered.file, frames,
                         [&](const MidiEvent& event, std::uint32_t time) { sender.send(event, time); });
        test::expect_equal(one, rendered, frames);
    }
}

INSTANTIATE_TEST_SUITE_P(Pieces, ClapEqualsRender,
                         testing::Values(Piece{"slap", "bass-slap", 3}, Piece{"sitar", "sitar", 3},
                                         Piece{"steel", "guitar-steel", 2}),
                         [](const auto& piece) { return std::string(piece.param.midi); });

}  // namespace
}  // namespace jawari::host
