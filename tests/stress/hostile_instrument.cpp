#include "hostile_instrument.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "dice.h"
#include "instrument/preset_library.h"

namespace jawari::stress {
namespace {

constexpr std::size_t most_frets = 4;

template <class T>
void cut(std::vector<T>& list, std::size_t count) {
    if (list.size() > count) list.resize(count);
}

void cut_frets(FretsDescription& frets, Dice& dice) {
    frets.count = std::min(frets.count, dice.whole(0, most_frets));
    cut(frets.semitones, frets.count);
    cut(frets.position_from_nut_m, frets.count);
    cut(frets.height_m, frets.count);
}

/// Indices of strings elsewhere in the description are those of the strings kept.
void keep_strings(InstrumentDescription& instrument, Dice& dice) {
    const std::size_t kept = dice.whole(1, std::min<std::size_t>(3, instrument.strings.size()));
    const std::size_t first = dice.whole(0, instrument.strings.size() - kept);
    const auto begin = instrument.strings.begin() + static_cast<std::ptrdiff_t>(first);
    instrument.strings = {begin, begin + static_cast<std::ptrdiff_t>(kept)};
    for (InstrumentStringDescription& string : instrument.strings) {
        string.course.reset();
        if (string.frets) cut_frets(*string.frets, dice);
    }
    cut_frets(instrument.frets, dice);
    for (ObstacleDescription& obstacle : instrument.obstacles) obstacle.strings.clear();
    for (SoftTouchDescription& touch : instrument.soft_touches) touch.strings.clear();
    cut(instrument.soft_touches, limits::soft_touches);
    for (ExciterDescription& exciter : instrument.exciters) {
        exciter.first_string = 0;
        exciter.last_string = 1000;
    }
}

/// The value times a factor up to `factor` either way, within its range.
void warp(Dice& dice, double factor, double low, double high, double& value) {
    if (value != 0 && dice.chance(0.5))
        value = std::clamp(value * dice.spread(1 / factor, factor), low, high);
}

void warp_string(Dice& dice, InstrumentStringDescription& string) {
    warp(dice, 8, 10, 5000, string.open_frequency_hz);
    warp(dice, 10, 1e-5, 0.1, string.linear_density_kg_per_m);
    warp(dice, 100, 0, 0.01, string.inharmonicity);
    warp(dice, 10, 0.01, 100, string.excitation);
    if (dice.chance(0.2)) string.damping = NoLoss{};
    if (dice.chance(0.2)) {
        const double slow = dice.spread(1e-3, 100);
        string.damping = DecayTimePoints{{{{100, slow}, {5000, slow * dice.spread(1e-3, 1)}}}};
    }
}

void warp_exciter(Dice& dice, ExciterDescription& exciter) {
    if (dice.chance(0.5)) {
        exciter.lowest_velocity = 0;
        exciter.highest_velocity = 1;
    }
    if (auto* finger = std::get_if<FingerDescription>(&exciter.body)) {
        warp(dice, 10, 1e-4, 0.1, finger->rise_s);
        warp(dice, 10, 5e-5, 0.1, finger->release_s);
        warp(dice, 20, 1e-6, 0.02, finger->full_height_m);
        warp(dice, 100, 0, 100, finger->damping_kg_per_s);
    } else if (auto* hammer = std::get_if<HammerDescription>(&exciter.body)) {
        warp(dice, 100, 1e-5, 1, hammer->mass_kg);
        warp(dice, 1e4, 1, 1e15, hammer->stiffness);
        warp(dice, 2, 1, 5, hammer->exponent);
        warp(dice, 100, 0, 10, hammer->loss_s_per_m);
        warp(dice, 10, 0.01, 50, hammer->full_speed_m_per_s);
    } else if (auto* tangent = std::get_if<TangentDescription>(&exciter.body)) {
        warp(dice, 10, 2e-4, 0.1, tangent->rise_s);
        warp(dice, 20, 1e-6, 0.02, tangent->full_height_m);
    }
}

void warp_hand(Dice& dice, HandDescription& hand) {
    for (double* time : {&hand.release_t60_s, &hand.palm_t60_s, &hand.dead_t60_s, &hand.harmonic_t60_s})
        warp(dice, 20, 0.005, 60, *time);
    if (dice.chance(0.3)) hand.damps = !hand.damps;
    if (dice.chance(0.3)) hand.pressure_semitones = dice.uniform(-12, 12);
    if (dice.chance(0.3)) hand.course_delay_s = dice.uniform(0, 0.05);
    if (dice.chance(0.3)) hand.legato_level = dice.unit();
}

void warp_sound(Dice& dice, InstrumentDescription& instrument) {
    for (SoftTouchDescription& touch : instrument.soft_touches) {
        warp(dice, 100, 0, 1e4, touch.damping_kg_per_s);
        warp(dice, 100, 0, 1e7, touch.stiffness_N_per_m);
    }
    for (BodyModeDescription& mode : instrument.body) {
        warp(dice, 4, 5, 20000, mode.frequency_hz);
        warp(dice, 30, 1e-4, 20, mode.t60_s);
    }
    for (PickupDescription& pickup : instrument.pickups) {
        if (dice.chance(0.1)) pickup.magnet_distance_m = dice.spread(1e-4, 0.1);
    }
}

/// Drawn last: what the dice gave before there were noises stays.
void add_noises(Dice& dice, InstrumentDescription& instrument) {
    for (ExciterDescription& exciter : instrument.exciters) {
        auto* finger = std::get_if<FingerDescription>(&exciter.body);
        if (finger != nullptr && dice.chance(0.5)) finger->roughness = dice.unit();
    }
    if (!dice.chance(0.5)) return;
    instrument.hand.release_noise_N = dice.spread(1e-4, 100);
    instrument.hand.release_noise_s = dice.spread(0.001, 1);
}

/// Drawn last of all, likewise. Bodies of a gram to ten kilograms, resonances wherever they are.
void move_bridge(Dice& dice, InstrumentDescription& instrument) {
    if (!dice.chance(0.5)) return;
    if (instrument.body.empty())
        instrument.body = {{.frequency_hz = 100, .t60_s = 0.2, .gain_left = 0.1, .gain_right = 0.1},
                           {.frequency_hz = 400, .t60_s = 0.1, .gain_left = 0.1, .gain_right = -0.1}};
    instrument.bridge = BridgeDescription{.open_strings = dice.chance(0.7) ? dice.unit() : 0};
    std::size_t moving = 0;
    for (BodyModeDescription& mode : instrument.body) {
        if (moving == limits::moving_body_modes || (moving > 0 && dice.chance(0.3))) continue;
        ++moving;
        mode.mass_kg = dice.spread(1e-3, 10);
        if (dice.chance(0.3)) continue;
        for (std::size_t s = 0; s < instrument.strings.size(); ++s) mode.shape.push_back(dice.uniform(-2, 2));
    }
    for (std::size_t s = 1; s < instrument.strings.size(); ++s)
        instrument.strings[s].sympathetic = dice.chance(0.1) && !instrument.strings[s].course;
}

/// Few modes and steps, so that compiling and playing take milliseconds.
QualityDescription choose_quality(const InstrumentDescription& instrument, double output_rate_hz,
                                  Dice& dice) {
    double highest_open = 10;
    for (const InstrumentStringDescription& string : instrument.strings)
        highest_open = std::max(highest_open, string.open_frequency_hz);
    const double wanted = highest_open * dice.spread(2, 80);
    QualityDescription quality;
    const double steps = dice.chance(0.1) ? dice.spread(1, 6.4e7 / output_rate_hz) : dice.spread(1, 64);
    quality.contact_rate_min_hz = std::clamp(std::max(output_rate_hz * steps, 2.3 * wanted), 8000.0, 6.4e7);
    quality.mode_limit_hz = std::min(wanted, 0.45 * quality.contact_rate_min_hz);
    return quality;
}

QualityDescription lowered(const QualityDescription& quality, double share) {
    QualityDescription lower = quality;
    lower.mode_limit_hz = std::max(10.0, quality.mode_limit_hz * share);
    lower.contact_rate_min_hz =
        std::max({8000.0, quality.contact_rate_min_hz * share, lower.mode_limit_hz / 0.44});
    return lower;
}

ImpactLaw choose_law(Dice& dice) {
    static constexpr ImpactLaw laws[] = {ImpactLaw::Passive, ImpactLaw::PaoliSchatzman, ImpactLaw::Newton};
    return dice.chance(0.6) ? ImpactLaw::Signorini : laws[dice.whole(0, 2)];
}

}  // namespace

PresetShelf factory_presets() {
    PresetShelf shelf;
    for (const host::NamedPreset& named : host::named_presets()) {
        if (named.origin != host::PresetOrigin::BuiltIn) continue;
        auto preset = host::load_preset(named.name);
        if (!preset.ok()) return {};
        shelf.presets.push_back(std::move(preset.value().instrument));
    }
    return shelf;
}

HostileInstrument make_hostile_instrument(const PresetShelf& shelf, std::uint64_t seed) {
    Dice dice(seed);
    HostileInstrument hostile;
    InstrumentDescription& instrument = hostile.description;
    instrument = shelf.presets[dice.whole(0, shelf.presets.size() - 1)];
    hostile.kind = "instrument " + instrument.name;
    hostile.output_rate_hz =
        dice.chance(0.6) ? dice.pick({44100, 48000, 96000}) : std::round(dice.spread(8000, 768000));
    keep_strings(instrument, dice);
    const bool warped = dice.chance(0.7);
    if (warped) {
        for (InstrumentStringDescription& string : instrument.strings) warp_string(dice, string);
        for (ExciterDescription& exciter : instrument.exciters) warp_exciter(dice, exciter);
        warp_hand(dice, instrument.hand);
        warp_sound(dice, instrument);
        instrument.law = choose_law(dice);
    }
    instrument.studio.reset();
    instrument.quality = choose_quality(instrument, hostile.output_rate_hz, dice);
    if (dice.chance(0.3))
        hostile.lower = {lowered(instrument.quality, 0.5), lowered(instrument.quality, 0.2)};
    if (warped) add_noises(dice, instrument);
    move_bridge(dice, instrument);
    return hostile;
}

}  // namespace jawari::stress
