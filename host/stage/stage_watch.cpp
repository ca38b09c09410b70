#include "stage/stage_watch.h"

#include <algorithm>
#include <cmath>

#include "jawari/instrument/render.h"

namespace jawari::host {

double look_interval_s(double frequency_hz, std::size_t moving) JAWARI_REALTIME {
    const double longest_s = std::max(1 / picture_rate_hz, static_cast<double>(moving) / most_looks_per_s);
    if (!(frequency_hz > 2 * stroboscope_hz)) return longest_s;
    const double slowed_s = 1 / (frequency_hz - stroboscope_hz);
    return std::max(1.0, std::round(longest_s / slowed_s)) * slowed_s;
}

std::size_t StageWatch::frames_to_look(std::uint64_t frame) const JAWARI_REALTIME {
    double next = picture_at_;
    for (std::size_t s = 0; s < strings_; ++s)
        if (looks_[s].due) next = std::min(next, looks_[s].at_frame);
    const double left = std::ceil(next - static_cast<double>(frame));
    return left < 1 ? 1 : static_cast<std::size_t>(left);
}

void StageWatch::look(StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME {
    if (model_ != &instrument.loaded->model) return;
    for (std::size_t s = 0; s < strings_; ++s)
        if (looks_[s].due && looks_[s].at_frame <= static_cast<double>(frame)) look_at(instrument, s, frame);
}

void StageWatch::look_at(const StagedInstrument& instrument, std::size_t string,
                         std::uint64_t frame) JAWARI_REALTIME {
    const InstrumentModel& model = instrument.loaded->model;
    const StringMotion motion = string_motion(model, instrument.state, string);
    StringPicture& seen = seen_[string];
    seen.moves = motion.moves;
    looks_[string].due = motion.moves;
    if (!motion.moves) return;
    std::array<double, shape_points> heights_m{};
    string_shape(model, instrument.state, string, heights_m);
    for (std::size_t j = 0; j < shape_points; ++j) seen.height_m[j] = static_cast<float>(heights_m[j]);
    seen.fret = static_cast<std::uint8_t>(motion.fret);
    seen.key = static_cast<std::uint8_t>(std::clamp(model.strings[string].stopped[motion.fret].key, 0, 127));
    seen.held = is_held(model, instrument.state, string);
    seen.length_m = static_cast<float>(motion.length_m);
    seen.frequency_hz = static_cast<float>(motion.frequency_hz);
    // From the moment that was meant, not from the frame in which it fell: the phase does not drift.
    double& next = looks_[string].at_frame;
    const double interval = look_interval_s(motion.frequency_hz, moving_) * rate_hz_;
    next += interval;
    if (next <= static_cast<double>(frame)) next = static_cast<double>(frame) + interval;
}

void StageWatch::hear(const double* left, const double* right, std::size_t frames) JAWARI_REALTIME {
    for (std::size_t n = 0; n < frames; ++n) {
        peak_left_ = std::max(peak_left_, static_cast<float>(std::abs(left[n])));
        peak_right_ = std::max(peak_right_, static_cast<float>(std::abs(right[n])));
    }
}

void StageWatch::add_load(std::size_t frames, double taken_s) JAWARI_REALTIME {
    const double available_s = static_cast<double>(frames) / rate_hz_;
    taken_s_ += taken_s;
    available_s_ += available_s;
    if (available_s > 0) worst_load_ = std::max(worst_load_, static_cast<float>(taken_s / available_s));
}

/// Strings that have begun to move are looked at from now on.
void StageWatch::follow(const StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME {
    const InstrumentModel& model = instrument.loaded->model;
    if (model_ != &model) {
        model_ = &model;
        strings_ = model.strings.size();
        looks_.fill({});
        for (StringPicture& seen : seen_) seen.moves = false;
    }
    moving_ = 0;
    for (std::size_t s = 0; s < strings_; ++s) {
        if (instrument.state.strings[s].busy == 0) continue;
        moving_ += 1;
        if (!looks_[s].due) looks_[s] = {static_cast<double>(frame), true};
    }
}

void StageWatch::report_impacts(StageLink& link, StagedInstrument& instrument,
                                std::uint64_t frame) JAWARI_REALTIME {
    std::array<float, impact_places> sums_Ns{};
    for (std::size_t s = 0; s < strings_; ++s) {
        if (!take_impacts(instrument.state, s, sums_Ns)) continue;
        for (std::size_t place = 0; place < impact_places; ++place) {
            if (sums_Ns[place] > 0)
                link.add(
                    {frame, static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(place), sums_Ns[place]});
        }
        sums_Ns.fill(0);
    }
}

void StageWatch::draw(StagePicture& picture, const StagedInstrument& instrument,
                      std::uint64_t frame) JAWARI_REALTIME {
    picture.frame = frame;
    picture.model = model_;
    picture.string_count = strings_;
    picture.moving = 0;
    for (std::size_t s = 0; s < strings_; ++s) {
        picture.strings[s].moves = seen_[s].moves;
        if (!seen_[s].moves) continue;
        picture.strings[s] = seen_[s];
        picture.moving += 1;
    }
    picture.note_count = 0;
    const InstrumentState& state = instrument.state;
    for (std::size_t c = 0; c < state.courses.size() && picture.note_count < most_pictured_notes; ++c) {
        const HeldNote& held = state.courses[c].held;
        if (!held.active) continue;
        picture.notes[picture.note_count++] = {
            static_cast<std::int8_t>(held.channel), static_cast<std::uint8_t>(held.key),
            static_cast<std::uint8_t>(instrument.loaded->model.courses[c].strings.front())};
    }
    picture.peak_left = peak_left_;
    picture.peak_right = peak_right_;
    picture.load = available_s_ > 0 ? static_cast<float>(taken_s_ / available_s_) : 0.0F;
    picture.worst_load = worst_load_;
}

void StageWatch::publish(StageLink& link, StagedInstrument& instrument, std::uint64_t frame) JAWARI_REALTIME {
    // A clock that was set back begins anew.
    const double interval = rate_hz_ / picture_rate_hz;
    const auto now = static_cast<double>(frame);
    if (picture_at_ > now && picture_at_ < now + interval && model_ == &instrument.loaded->model) return;
    picture_at_ = now + interval;
    if (!instrument.state.impacts.open) watch_impacts(instrument.state, true);
    follow(instrument, frame);
    report_impacts(link, instrument, frame);
    draw(link.pictures().back(), instrument, frame);
    link.pictures().publish();
    peak_left_ = peak_right_ = worst_load_ = 0;
    taken_s_ = available_s_ = 0;
}

void StageWatch::close(StagedInstrument* instrument) JAWARI_REALTIME {
    if (instrument != nullptr && instrument->state.impacts.open) watch_impacts(instrument->state, false);
    model_ = nullptr;
    strings_ = 0;
    picture_at_ = 0;
}

}  // namespace jawari::host
