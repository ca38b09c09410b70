// What a window shows and where, without a display.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "formats/preset/read_preset.h"
#include "instrument/instrument_cache.h"
#include "instrument/preset_library.h"
#include "support/small_preset.h"
#include "window/model/contactogram.h"
#include "window/model/control.h"
#include "window/model/keyboard.h"
#include "window/model/layout.h"
#include "window/model/pacer.h"
#include "window/model/preset_edit.h"
#include "window/model/preset_search.h"
#include "window/model/string_places.h"
#include "window/model/theme.h"

namespace jawari::host::window {
namespace {

TEST(WindowTheme, EveryTextCanBeRead) {
    // The formula of WCAG 2.1 against its own examples: black on white is 21, #777777 on white 4.48.
    EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21, 1e-9);
    EXPECT_NEAR(contrast({0x77, 0x77, 0x77}, {255, 255, 255}), 4.48, 0.005);
    for (const theme::Pair& pair : theme::written)
        EXPECT_GE(contrast(pair.text, pair.ground), 4.5) << pair.use;
}

bool overlap(const Box& a, const Box& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(WindowLayout, NothingOverlapsOrLeavesTheWindow) {
    for (float width = 500; width <= 4000; width += 137) {
        for (float height = 400; height <= 2200; height += 101) {
            const Layout layout = lay_out(width, height);
            std::vector<Box> boxes{layout.head,    layout.play_tab, layout.setup_tab,  layout.notice,
                                   layout.strings, layout.keyboard, layout.parameters, layout.contactogram};
            if (layout.wide) boxes.push_back(layout.presets);
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                EXPECT_GE(boxes[i].x, 0);
                EXPECT_GE(boxes[i].y, 0);
                EXPECT_GT(boxes[i].width, 0);
                EXPECT_GT(boxes[i].height, 0);
                EXPECT_LE(boxes[i].right(), layout.width + 0.01F);
                EXPECT_LE(boxes[i].bottom(), layout.height + 0.01F);
                for (std::size_t j = 0; j < i; ++j)
                    EXPECT_FALSE(overlap(boxes[i], boxes[j]))
                        << width << "x" << height << ": " << i << " " << j;
            }
        }
    }
}

TEST(WindowLayout, EveryParameterHasAControlOfItsOwn) {
    for (const float width : {smallest_width, usual_width, 2000.0F}) {
        const Layout layout = lay_out(width, usual_height);
        for (std::size_t i = 0; i < parameter_count; ++i) {
            const Box& box = layout.controls[i];
            EXPECT_GT(box.width, 100);
            EXPECT_GE(box.x, layout.parameters.x);
            EXPECT_LE(box.right(), layout.parameters.right());
            EXPECT_GE(box.y, layout.parameters.y);
            EXPECT_LE(box.bottom(), layout.parameters.bottom());
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_FALSE(overlap(box, layout.controls[j])) << i << " " << j;
            for (const GroupPlace& group : layout.groups) EXPECT_FALSE(overlap(box, group.box)) << group.name;
        }
    }
}

TEST(WindowKeyboard, EveryKeyIsFoundWhereItIsDrawn) {
    const std::vector<PianoKey> keys = piano_keys({10, 20, 900, 60}, 28, 67);
    std::vector<bool> found(128);
    for (const PianoKey& key : keys) {
        // White keys below the black ones, black ones in their middle.
        const float y = key.black ? key.box.middle_y() : key.box.bottom() - 2;
        EXPECT_EQ(key_at(keys, key.box.middle_x(), y), key.key);
        found[static_cast<std::size_t>(key.key)] = true;
    }
    for (std::size_t key = 24; key <= 71; ++key) EXPECT_TRUE(found[key]) << key;
    EXPECT_FALSE(key_at(keys, 5, 30));
    EXPECT_FALSE(key_at(keys, 500, 90));
}

TEST(WindowKeyboard, WhiteKeysFillTheBox) {
    for (const int highest : {30, 60, 100, 127}) {
        float width = 0;
        for (const PianoKey& key : piano_keys({0, 0, 700, 50}, 20, highest))
            width += key.black ? 0 : key.box.width;
        EXPECT_NEAR(width, 700, 0.1);
    }
}

TEST(WindowControl, DragsStayInRangeAndFineOnesAreATenth) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        ControlDrag far(parameter, parameter.neutral);
        EXPECT_DOUBLE_EQ(far.move(1e9, 200, false), parameter.high);
        EXPECT_DOUBLE_EQ(far.move(-1e9, 200, true), parameter.low);
        ControlDrag coarse(parameter, parameter.low);
        ControlDrag fine(parameter, parameter.low);
        coarse.move(20, 200, false);
        EXPECT_DOUBLE_EQ(fine.move(200, 200, true), coarse.move(0, 200, false)) << parameter.key;
    }
}

TEST(WindowControl, SmallMovesOfSteppedControlsAddUp) {
    const ParameterDeclaration& harmonic = declaration_of(ParameterId::Harmonic);
    ControlDrag drag(harmonic, harmonic.low);
    for (int i = 0; i < 100; ++i) drag.move(1, 200, false);
    EXPECT_DOUBLE_EQ(drag.move(0, 200, false), 4);  // half-way from 1 to 7
}

TEST(WindowControl, KeysGoWholeStepsThereAndBack) {
    for (const ParameterDeclaration& parameter : parameter_table()) {
        const double up = stepped_value(parameter, parameter.neutral, 1, false);
        EXPECT_GE(up, parameter.neutral);
        EXPECT_LE(up, parameter.high);
        EXPECT_LE(stepped_value(parameter, parameter.low, -1, false), parameter.low);
        const bool can_rise = parameter.curve == Curve::Stepped && parameter.neutral < parameter.high;
        if (can_rise) {
            EXPECT_DOUBLE_EQ(up, parameter.neutral + 1);
        }
    }
}

TEST(WindowSearch, FindsWordsOfNamesAndDescriptions) {
    const std::vector<ListedPreset> presets{{"guitar-steel", "Steel-string guitar", "Bronze strings"},
                                            {"bass", "Fretted bass", "As steel as it gets"},
                                            {"sitar", "Sitar", "It buzzes"}};
    EXPECT_EQ(search_presets(presets, ""), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(search_presets(presets, "STEEL"), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(search_presets(presets, "  gets bass "), (std::vector<std::size_t>{1}));
    EXPECT_EQ(search_presets(presets, "tar"), (std::vector<std::size_t>{0, 2}));
    EXPECT_TRUE(search_presets(presets, "piano").empty());
}

TEST(WindowSearch, ListsEveryFactoryPreset) {
    const std::vector<ListedPreset> presets = list_presets();
    for (const std::string& name : builtin_preset_names()) {
        const auto listed = std::find_if(presets.begin(), presets.end(),
                                         [&](const ListedPreset& preset) { return preset.name == name; });
        ASSERT_NE(listed, presets.end()) << name;
        EXPECT_FALSE(listed->description.empty()) << name;
    }
}

TEST(WindowPacer, DrawingTakesAtMostAFifth) {
    std::mt19937 dice(1);
    for (const double mean_s : {0.0005, 0.004, 0.03, 0.08}) {
        Pacer pacer;
        double drawn_s = 0;
        double now = 0;
        while (now < 60) {
            now += 0.001;
            if (!pacer.is_due(now)) continue;
            const double cost_s = mean_s * (0.5 + static_cast<double>(dice() % 1000) / 1000);
            pacer.drawn(now, cost_s);
            drawn_s += cost_s;
            now += cost_s;
        }
        EXPECT_LE(drawn_s / now, drawing_share * 1.01) << mean_s;
    }
}

TEST(WindowContactogram, ImpulsesMoveDownAndVanish) {
    Contactogram picture;
    picture.add({0, 2, 10, 1e-3F});
    const std::size_t column = impact_places - 1 - 10;
    const float brightness = picture.at(0, column);
    EXPECT_GT(brightness, 0.5F);
    EXPECT_TRUE(picture.advance(10 * contactogram_row_s));
    EXPECT_EQ(picture.at(0, column), 0);
    EXPECT_EQ(picture.at(10, column), brightness);
    for (std::size_t i = 0; i < contactogram_rows; ++i) picture.advance(contactogram_row_s);
    EXPECT_TRUE(picture.is_empty());
    EXPECT_FALSE(picture.advance(1));  // nothing to draw
}

// ---------------------------------------------------------------------------------------------- strings

SharedInstrument small_instrument(const std::string& name) {
    return compile_preset_text(test::small_preset_text(name), name, {}).value();
}

TEST(WindowStrings, PlacesGoThereAndBack) {
    const auto bass = small_instrument("bass-fretted");
    StringPlaces places(*bass, bass->preset.instrument);
    places.place({100, 50, 800, 300});
    for (const double from_bridge_m : {0.0, 0.1, 0.5, 0.863}) {
        EXPECT_NEAR(places.from_bridge_at(places.x_of(from_bridge_m)), from_bridge_m, 1e-5);
        for (std::size_t s = 0; s < 4; ++s)
            EXPECT_NEAR(places.height_at(s, places.point(s, from_bridge_m, 0.001).y), 0.001, 1e-6);
    }
}

/// Frets divide the string as equal temperament does: fret n lies at L 2^(-n/12) from the bridge.
TEST(WindowStrings, AFingerPressesTheFretTowardsTheBridge) {
    const auto bass = small_instrument("bass-fretted");
    StringPlaces places(*bass, bass->preset.instrument);
    places.place({100, 50, 800, 300});
    const double length_m = bass->preset.instrument.strings[0].length_m;
    for (std::size_t s = 0; s < 4; ++s) {
        for (std::size_t fret = 1; fret <= 20; ++fret) {
            const double at = length_m * std::exp2(-static_cast<double>(fret) / 12);
            const auto hit = places.hit(places.x_of(at * 1.01), places.rest_y(s));
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->string, s);
            EXPECT_EQ(hit->fret, fret);
        }
        const auto pluck = places.hit(places.x_of(0.1), places.rest_y(s));
        ASSERT_TRUE(pluck);
        EXPECT_EQ(pluck->fret, 0U);
        EXPECT_NEAR(pluck->from_bridge_m, 0.1, 1e-5);
    }
    EXPECT_FALSE(places.hit(99, 100));
}

TEST(WindowStrings, AllFactoryPresetsHaveAPicture) {
    for (const std::string& name : builtin_preset_names()) {
        const auto instrument = small_instrument(name);
        StringPlaces places(*instrument, instrument->preset.instrument);
        places.place({0, 0, 800, 260});
        EXPECT_EQ(places.lanes().size(), instrument->model.strings.size()) << name;
        EXPECT_LT(places.lowest_key(), places.highest_key()) << name;
    }
}

// ---------------------------------------------------------------------------------------------- edits

struct Edited {
    Preset before, after;
};

/// As the window does it: the part is moved, and what comes of it is read as a preset file.
Edited edit(const std::string& name, std::size_t string, const PartName& part, const Move& move) {
    const std::string text = preset_text(name).value();
    Edited edited{read_preset(text, name).value(), {}};
    const auto& instrument = edited.before.instrument;
    const double length_m = instrument.strings[string].length_m;
    std::vector<double> frets;
    for (std::size_t f = 1; f <= instrument.frets.count; ++f)
        frets.push_back(length_m * std::exp2(-static_cast<double>(f) / 12));
    const auto moved = with_part_moved(text, instrument, string, length_m, frets, part, move);
    EXPECT_TRUE(moved);
    edited.after = read_preset(moved.value_or(text), name).value();
    return edited;
}

TEST(WindowEdits, APluckPlaceIsWhereItWasDragged) {
    const Edited edited = edit("bass-fretted", 0, {Part::Exciter, 0, 0}, {0.0875, 0});
    EXPECT_DOUBLE_EQ(edited.after.instrument.exciters[0].place.from_bridge_m, 0.0875);
    EXPECT_EQ(edited.after.instrument.frets.height_m, edited.before.instrument.frets.height_m);
    EXPECT_EQ(edited.after.instrument.pickups[0].place.from_bridge_m,
              edited.before.instrument.pickups[0].place.from_bridge_m);
}

/// On all of its stops: the highest fret is the 20th.
TEST(WindowEdits, APickupStaysOnTheString) {
    const Edited edited = edit("bass-fretted", 0, {Part::Pickup, 0, 0}, {5, 0});
    const double shortest_m = 0.863 * std::exp2(-20.0 / 12);
    EXPECT_LT(edited.after.instrument.pickups[0].place.from_bridge_m, shortest_m);
    EXPECT_GT(edited.after.instrument.pickups[0].place.from_bridge_m, 0.95 * shortest_m);
}

TEST(WindowEdits, AFretMovesAlone) {
    const Edited edited = edit("bass-fretted", 1, {Part::Fret, 7, 0}, {0, -0.0012});
    for (std::size_t f = 0; f < 20; ++f) {
        const double expected = f == 6 ? -0.0012 : edited.before.instrument.frets.height_m[f];
        EXPECT_DOUBLE_EQ(edited.after.instrument.frets.height_m[f], expected) << f;
    }
}

/// A raised bridge turns the strings about the nut; fret n is L (1 - 2^(-n/12)) away from it.
TEST(WindowEdits, ActionGrowsFromTheNut) {
    const Edited edited = edit("bass-fretted", 0, {Part::Action, 0, 0}, {0, 0.0005});
    const double neck = 1 - std::exp2(-20.0 / 12);
    for (std::size_t f = 1; f <= 20; ++f) {
        const double share = (1 - std::exp2(-static_cast<double>(f) / 12)) / neck;
        EXPECT_NEAR(edited.after.instrument.frets.height_m[f - 1],
                    edited.before.instrument.frets.height_m[f - 1] - 0.0005 * share, 1e-6);
    }
}

TEST(WindowEdits, ReliefLeavesTheLastFretAlone) {
    const Edited edited = edit("bass-fretted", 0, {Part::Relief, 0, 0}, {0, -0.0004});
    const auto& before = edited.before.instrument.frets.height_m;
    const auto& after = edited.after.instrument.frets.height_m;
    EXPECT_NEAR(after.back(), before.back(), 1e-6);
    double deepest = 0;
    for (std::size_t f = 0; f < 20; ++f) deepest = std::min(deepest, after[f] - before[f]);
    EXPECT_NEAR(deepest, -0.0004, 1e-5);
}

TEST(WindowEdits, TheSitarsBridgeIsAsLongAndAsDeepAsDragged) {
    const Edited edited = edit("sitar", 0, {Part::ObstacleEnd, 0, 0}, {0.03, -0.0015});
    const auto& parabola = std::get<ParabolicProfile>(edited.after.instrument.obstacles[0].profile);
    EXPECT_NEAR(parabola.length_m, 0.03, 1e-6);
    EXPECT_NEAR(parabola.height_m - parabola.drop_m, -0.0015, 2e-6);
}

TEST(WindowEdits, EveryHandleOfEveryPresetCanBeMoved) {
    for (const std::string& name : builtin_preset_names()) {
        const std::string text = test::small_preset_text(name);
        const auto instrument = compile_preset_text(text, name, {}).value();
        const auto& description = instrument->preset.instrument;
        const StringPlaces places(*instrument, description);
        const StringLane& lane = places.lanes()[0];
        std::vector<double> frets;
        for (const FretPlace& fret : lane.frets) frets.push_back(fret.from_bridge_m);
        for (const Handle& handle : handles_of(description, 0, lane.length_m, frets)) {
            const auto moved = with_part_moved(text, description, 0, lane.length_m, frets, handle.name,
                                               {handle.from_bridge_m * 1.02, handle.height_m - 0.0001});
            ASSERT_TRUE(moved) << name << ": " << handle.label;
            EXPECT_NE(*moved, text) << name << ": " << handle.label;
            EXPECT_TRUE(compile_preset_text(*moved, name, {})) << name << ": " << handle.label;
        }
    }
}

}  // namespace
}  // namespace jawari::host::window
