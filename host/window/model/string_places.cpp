#include "window/model/string_places.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace jawari::host::window {

namespace {

/// At both sides of the strings, for the names and for the bridge.
constexpr float side = 40;

double full_height(const ExciterDescription& exciter) {
    if (const auto* finger = std::get_if<FingerDescription>(&exciter.body)) return finger->full_height_m;
    if (const auto* tangent = std::get_if<TangentDescription>(&exciter.body)) return tangent->full_height_m;
    return 0.002;
}

StringLane lane_of(const InstrumentStringModel& model, const FretsDescription& frets) {
    StringLane lane;
    lane.course = model.course;
    for (std::size_t f = 0; f < model.stopped.size(); ++f) {
        const StoppedStringModel& stopped = model.stopped[f];
        const double length_m = stopped.string.shape->length_m;
        if (f == 0) {
            lane.length_m = length_m;
            lane.open_key = stopped.key;
            continue;
        }
        const bool has_top = f - 1 < frets.height_m.size();
        lane.frets.push_back({length_m, has_top ? frets.height_m[f - 1] : 0.0, has_top, stopped.key});
    }
    return lane;
}

}  // namespace

StringPlaces::StringPlaces(const LoadedInstrument& instrument, const InstrumentDescription& shown) {
    const InstrumentModel& model = instrument.model;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        const InstrumentStringDescription& string = shown.strings[s];
        lanes_.push_back(lane_of(model.strings[s], string.frets ? *string.frets : shown.frets));
        StringLane& lane = lanes_.back();
        // An open string that the tuning leaves out has no model; its length is as described.
        if (!(lane.length_m > 0)) lane.length_m = string.length_m;
        longest_m_ = std::max(longest_m_, lane.length_m);
        for (const FretPlace& fret : lane.frets) extent_m_ = std::max(extent_m_, -1.15 * fret.height_m);
        for (const StoppedStringModel& stopped : model.strings[s].stopped) {
            if (stopped.key < 0) continue;
            lowest_key_ = std::min(lowest_key_, stopped.key);
            highest_key_ = std::max(highest_key_, stopped.key);
        }
        PluckPlace pluck;
        if (!shown.exciters.empty() &&
            !std::holds_alternative<TangentDescription>(shown.exciters.front().body)) {
            const StringPlace place = string.exciter_place.value_or(shown.exciters.front().place);
            pluck.from_bridge_m = place.share > 0 ? place.share * lane.length_m : place.from_bridge_m;
        }
        plucks_.push_back(pluck);
    }
    for (const ExciterDescription& exciter : shown.exciters)
        extent_m_ = std::max(extent_m_, 0.6 * full_height(exciter));
    if (lowest_key_ > highest_key_) lowest_key_ = highest_key_ = 60;
}

void StringPlaces::place(const Box& box, std::optional<std::size_t> only) {
    box_ = box;
    only_ = only && *only < lanes_.size() ? only : std::nullopt;
    const auto count = static_cast<float>(only_ ? 1 : std::max<std::size_t>(lanes_.size(), 1));
    lane_height_ = box.height / count;
    height_scale_ = static_cast<double>(lane_height_) * 0.5 / extent_m_;
}

float StringPlaces::x_of(double from_bridge_m) const {
    const double share = longest_m_ > 0 ? from_bridge_m / longest_m_ : 0.0;
    return box_.right() - side - static_cast<float>(share) * (box_.width - 2 * side);
}

double StringPlaces::from_bridge_at(float x) const {
    return static_cast<double>((box_.right() - side - x) / (box_.width - 2 * side)) * longest_m_;
}

/// The highest string is on top, as in tablature. Frets lie below the line: it is above the lane's middle.
float StringPlaces::rest_y(std::size_t string) const {
    const std::size_t lane = only_ ? 0 : lanes_.size() - 1 - string;
    return box_.y + lane_height_ * (static_cast<float>(lane) + 0.42F);
}

PicturePoint StringPlaces::point(std::size_t string, double from_bridge_m, double height_m) const {
    return {x_of(from_bridge_m), rest_y(string) - static_cast<float>(height_m * height_scale_)};
}

double StringPlaces::height_at(std::size_t string, float y) const {
    return static_cast<double>(rest_y(string) - y) / height_scale_;
}

std::optional<StringHit> StringPlaces::hit(float x, float y) const {
    if (!box_.has(x, y) || lanes_.empty()) return std::nullopt;
    const auto lane = static_cast<std::size_t>(std::max(0.0F, (y - box_.y) / lane_height_));
    StringHit hit;
    hit.string = only_ ? *only_ : lanes_.size() - 1 - std::min(lane, lanes_.size() - 1);
    const StringLane& string = lanes_[hit.string];
    hit.from_bridge_m = from_bridge_at(x);
    if (hit.from_bridge_m < 0 || hit.from_bridge_m > string.length_m) return std::nullopt;
    // A finger presses the fret that is next towards the bridge.
    for (std::size_t f = 1; f <= string.frets.size(); ++f) {
        if (hit.from_bridge_m < string.frets[f - 1].from_bridge_m) continue;
        hit.fret = f;
        break;
    }
    return hit;
}

PluckPlace StringPlaces::pluck_place(std::size_t string) const {
    return plucks_[string];
}

}  // namespace jawari::host::window
