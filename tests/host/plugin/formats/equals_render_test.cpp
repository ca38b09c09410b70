// What a host hears of a MIDI file through VST 3 and LV2 is what `jawari render` makes of it, bit for bit, as
// through CLAP (plugin/clap/offline_test.cpp).
#include <gtest/gtest.h>

#ifdef JAWARI_LV2
#include "support/lv2_host.h"
#endif
#include "support/rendered_piece.h"
#include "support/small_preset.h"
#include "support/vst3_host.h"

namespace jawari::host {
namespace {

template <class Instance>
class FormatEqualsRender : public testing::Test {};

#ifdef JAWARI_LV2
using RenderFormats = testing::Types<test::Vst3Instance, test::Lv2Instance>;
#else
using RenderFormats = testing::Types<test::Vst3Instance>;
#endif
TYPED_TEST_SUITE(FormatEqualsRender, RenderFormats, test::FormatNames);

std::string factory_state(const std::string& name) {
    const BuiltinFile* const preset = find_builtin("instruments", name);
    return nlohmann::ordered_json{{"schema", "jawari.plugin/1"},
                                  {"preset", {{"name", name}, {"text", preset->text}}}}
        .dump();
}

template <class Instance>
void send(Instance& one, const MidiEvent& event, std::uint32_t time) {
    if constexpr (std::is_same_v<Instance, test::Vst3Instance>) {
        // A VST 3 host hands over the values of one frame without their order, so that registered parameters
        // cannot be set at one: the bend range has a parameter of its own.
        if ((event.status & 0xF0) == 0xB0 && (event.data1 == 6 || event.data1 == 38 || event.data1 >= 98)) {
            if (event.data1 == 6)
                one.events.parameter(time, static_cast<std::uint32_t>(ParameterId::BendRange), event.data2);
            return;
        }
    }
    one.events.midi(time, event.status, event.data1, event.data2);
}

TYPED_TEST(FormatEqualsRender, BitForBit) {
    struct Piece {
        const char* midi;
        const char* preset;
    };
    for (const Piece piece :
         {Piece{"slap", "bass-slap"}, Piece{"sitar", "sitar"}, Piece{"steel", "guitar-steel"}}) {
        SCOPED_TRACE(piece.midi);
        const test::RenderedPiece rendered = test::render_piece(
            piece.midi, piece.preset, {"--end", "2", "--set", "palm_mute=0.25", "--set", "volume=0.5625"});
        constexpr std::size_t frames = 2 * 48000 - 1000;  // what ends the excerpt comes after it
        TypeParam one;
        ASSERT_TRUE(one.load(factory_state(piece.preset)));
        ASSERT_TRUE(one.activate(48000, 512));
        one.events.parameter(0, 6, 0.25);
        one.events.parameter(0, 0, 0.5625);
        test::play_piece(one, rendered.file, frames,
                         [&](const MidiEvent& event, std::uint32_t time) { send(one, event, time); });
        test::expect_equal(one, rendered, frames);
    }
}

}  // namespace
}  // namespace jawari::host
