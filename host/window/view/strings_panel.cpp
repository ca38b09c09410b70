#include "window/view/strings_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "window/model/contactogram.h"
#include "window/model/note_names.h"

namespace jawari::host::window {

using theme::grid;

// ---------------------------------------------------------------------------------------------- what is
// shown

void StringsPanel::place() {
    const SharedInstrument& instrument = shared_.performance.preset().instrument;
    if (instrument == nullptr) {
        places_.reset();
        return;
    }
    if (instrument != instrument_) {
        instrument_ = instrument;
        drawn_.assign(instrument->model.strings.size(), {});
        flashes_.clear();
        pull_.reset();
        under_.reset();
        chosen_string_ = std::min(chosen_string_, instrument->model.strings.size() - 1);
        chosen_fret_ = 0;
        if (alone_) alone_ = std::min(*alone_, instrument->model.strings.size() - 1);
    }
    const InstrumentDescription& shown =
        description_ && description_->strings.size() == instrument->model.strings.size()
            ? *description_
            : instrument->preset.instrument;
    places_.emplace(*instrument, shown);
    places_->place(shared_.layout.strings, alone_);
    shared_.moving_changed = true;
}

void StringsPanel::show(const InstrumentDescription* description) {
    if (description != nullptr)
        description_ = *description;
    else
        description_.reset();
    place();
    shared_.still_changed = true;
}

void StringsPanel::show_alone(std::optional<std::size_t> string) {
    alone_ = string;
    place();
    shared_.still_changed = true;
}

bool StringsPanel::shows(std::size_t string) const {
    return !alone_ || *alone_ == string;
}

void StringsPanel::take(const StagePicture& picture) {
    hand_.follow(picture);
    if (instrument_ == nullptr || picture.model != &instrument_->model) return;
    for (std::size_t s = 0; s < std::min(picture.string_count, drawn_.size()); ++s) {
        Drawn& drawn = drawn_[s];
        const StringPicture& seen = picture.strings[s];
        if (!seen.moves && !drawn.moves) continue;
        shared_.moving_changed = true;
        if (!seen.moves || seen.fret != drawn.fret) drawn.count = 0;
        if (seen.moves != drawn.moves || seen.fret != drawn.fret) shared_.still_changed = true;
        drawn.moves = seen.moves;
        drawn.fret = seen.fret;
        if (!seen.moves) continue;
        std::rotate(drawn.shapes.begin(), drawn.shapes.end() - 1, drawn.shapes.end());
        drawn.shapes[0] = seen.height_m;
        drawn.count = std::min(drawn.count + 1, drawn.shapes.size());
    }
}

void StringsPanel::take(const Impact& impact) {
    if (!places_ || impact.string >= places_->lanes().size()) return;
    constexpr std::size_t most_flashes = 256;
    const double unit_m = [&] {
        const StringLane& lane = places_->lanes()[impact.string];
        double longest_m = lane.length_m;
        for (const FretPlace& fret : lane.frets) longest_m = std::max(longest_m, fret.from_bridge_m);
        return longest_m / impact_places;
    }();
    const Flash flash{impact.string, (impact.place + 0.5) * unit_m, impulse_brightness(impact.impulse_Ns)};
    if (flash.brightness <= 0.05F) return;
    for (Flash& old : flashes_) {
        if (old.string != flash.string || old.from_bridge_m != flash.from_bridge_m) continue;
        old.brightness = std::max(old.brightness, flash.brightness);
        return;
    }
    if (flashes_.size() < most_flashes) flashes_.push_back(flash);
}

void StringsPanel::follow(double passed_s) {
    if (flashes_.empty()) return;
    shared_.moving_changed = true;
    constexpr float fade_per_s = 6;
    for (Flash& flash : flashes_) flash.brightness -= fade_per_s * static_cast<float>(passed_s);
    std::erase_if(flashes_, [](const Flash& flash) { return flash.brightness <= 0; });
}

std::string StringsPanel::string_name(std::size_t string) const {
    return note_name(places_->lanes()[string].open_key);
}

float StringsPanel::thickness(std::size_t string) const {
    const double density = instrument_->preset.instrument.strings[string].linear_density_kg_per_m;
    constexpr double thin = 4e-4;
    constexpr double thick = 2e-2;
    const double share = std::clamp(std::log(density / thin) / std::log(thick / thin), 0.0, 1.0);
    const float usual = 1.2F + 1.6F * static_cast<float>(share);
    return std::min(usual, std::max(0.8F, places_->lane_height() * 0.4F));
}

// ---------------------------------------------------------------------------------------------- drawing

void StringsPanel::draw_still(Canvas& canvas) {
    canvas.box(shared_.layout.strings, theme::ground);
    if (!places_) {
        canvas.text(shared_.layout.strings, "The instrument is being compiled", theme::type, theme::quiet,
                    TextPlace::Middle);
        return;
    }
    for (std::size_t s = 0; s < places_->lanes().size(); ++s)
        if (shows(s)) draw_lane(canvas, s);
}

/// Everything of a lane that does not move.
void StringsPanel::draw_lane(Canvas& canvas, std::size_t string) {
    const StringLane& lane = places_->lanes()[string];
    const float height = places_->lane_height();
    const float y = places_->rest_y(string);
    draw_neck(canvas, string);
    draw_obstacles(canvas, string);
    const float post = std::min(14.0F, height * 0.32F);
    const float nut = places_->x_of(lane.length_m);
    const float bridge = places_->x_of(0);
    canvas.segment(nut, y - 1, nut, y + post, theme::quiet, 2);
    canvas.segment(bridge, y - 1, bridge, y + post, theme::quiet, 2);
    if (height >= 14) {
        const bool lit = string < drawn_.size() && drawn_[string].moves;
        const std::size_t fret = lit ? drawn_[string].fret : 0;
        const int key = fret == 0 ? lane.open_key : lane.frets[fret - 1].key;
        canvas.text({shared_.layout.strings.x, y - 8, nut - shared_.layout.strings.x - grid, 16},
                    lit ? note_name(key) : string_name(string), theme::small_type,
                    lit ? theme::accent : theme::quiet, TextPlace::Right);
    }
    if (shows_focus(0) && string == chosen_string_) {
        const double place = chosen_fret_ == 0 ? lane.length_m : lane.frets[chosen_fret_ - 1].from_bridge_m;
        draw_focus(canvas, {places_->x_of(place) - 4, y - height * 0.3F, 8, height * 0.6F});
    }
}

void StringsPanel::draw_neck(Canvas& canvas, std::size_t string) {
    const StringLane& lane = places_->lanes()[string];
    const float height = places_->lane_height();
    const float bottom = places_->rest_y(string) + height * 0.5F;
    for (std::size_t f = 1; f <= lane.frets.size(); ++f) {
        const FretPlace& fret = lane.frets[f - 1];
        if (fret.key < 0) continue;
        const PicturePoint top = places_->point(string, fret.from_bridge_m, fret.height_m);
        // A fret that the string does not strike is where the finger stops it, and no more.
        if (fret.has_top)
            canvas.segment(top.x, top.y, top.x, std::min(bottom, top.y + height * 0.4F), theme::line,
                           height > 30 ? 2.0F : 1.0F);
        else if (height > 8)
            canvas.dot(top.x, top.y + 4, 1, theme::line);
        const bool marked = f == 3 || f == 5 || f == 7 || f == 9 || f == 12 || f == 15 || f == 17 || f == 19;
        const bool lowest = alone_ ? *alone_ == string : string == 0;
        if (marked && lowest && lane.frets.size() > 4)
            canvas.text({top.x - 12, shared_.layout.strings.bottom() - 14, 24, 14}, std::to_string(f),
                        theme::small_type, theme::quiet, TextPlace::Middle);
    }
}

void StringsPanel::draw_obstacles(Canvas& canvas, std::size_t string) {
    const InstrumentDescription& shown = description_ ? *description_ : instrument_->preset.instrument;
    const double length_m = places_->lanes()[string].length_m;
    for (const ObstacleDescription& obstacle : shown.obstacles) {
        if (!obstacle.strings.empty() &&
            std::find(obstacle.strings.begin(), obstacle.strings.end(), string) == obstacle.strings.end())
            continue;
        const auto point = [&](double distance_m, double height_m) {
            const double from_bridge_m =
                obstacle.origin == Origin::Bridge ? distance_m : length_m - distance_m;
            return places_->point(string, from_bridge_m, height_m);
        };
        auto& nanovg = canvas.nanovg();
        nanovg.beginPath();
        if (const auto* parabola = std::get_if<ParabolicProfile>(&obstacle.profile)) {
            constexpr int steps = 24;
            for (int i = 0; i <= steps; ++i) {
                const double share = static_cast<double>(i) / steps;
                const PicturePoint at =
                    point(share * parabola->length_m, parabola->height_m - parabola->drop_m * share * share);
                i == 0 ? nanovg.moveTo(at.x, at.y) : nanovg.lineTo(at.x, at.y);
            }
        } else {
            bool first = true;
            for (const auto& [distance_m, height_m] : std::get<CornerProfile>(obstacle.profile)) {
                const PicturePoint at = point(distance_m, height_m);
                first ? nanovg.moveTo(at.x, at.y) : nanovg.lineTo(at.x, at.y);
                first = false;
            }
        }
        canvas.stroke(theme::quiet, places_->lane_height() > 12 ? 2.0F : 1.0F, 0.7F);
    }
}

void StringsPanel::draw_moving(Canvas& canvas) {
    if (!places_) return;
    const Box& box = shared_.layout.strings;
    canvas.nanovg().save();
    canvas.nanovg().intersectScissor(box.x, box.y, box.width, box.height);
    for (std::size_t s = 0; s < places_->lanes().size(); ++s)
        if (shows(s)) draw_string(canvas, s);
    for (const Flash& flash : flashes_)
        if (shows(flash.string)) draw_flash(canvas, flash);
    canvas.nanovg().restore();
}

void StringsPanel::draw_string(Canvas& canvas, std::size_t string) {
    if (pull_ && pull_->string == string) {
        draw_pull(canvas, *pull_);
        return;
    }
    const Drawn& drawn = drawn_[string];
    if (!drawn.moves || drawn.count == 0) {
        const double length_m = places_->lanes()[string].length_m;
        const float y = places_->rest_y(string);
        const bool lit = under_ && under_->string == string && !shared_.setup;
        canvas.segment(places_->x_of(length_m), y, places_->x_of(0), y, theme::string, thickness(string),
                       lit ? 1.0F : 0.75F);
        return;
    }
    const bool few = places_->lanes().size() <= 12 || alone_;
    constexpr std::array<float, ghosts + 1> opacity{1, 0.28F, 0.16F, 0.08F};
    for (std::size_t n = few ? drawn.count : 1; n-- > 0;)
        draw_shape(canvas, string, drawn.shapes[n], drawn.fret, opacity[n]);
    if (drawn.fret > 0) {
        const FretPlace& fret = places_->lanes()[string].frets[drawn.fret - 1];
        const PicturePoint at = places_->point(string, fret.from_bridge_m, fret.height_m);
        canvas.dot(at.x, at.y - 2, std::min(5.0F, std::max(2.0F, places_->lane_height() * 0.12F)),
                   theme::accent);
    }
}

/// From the nut straight to the fret that stops it, from there as it moves about the line to the bridge.
void StringsPanel::draw_shape(Canvas& canvas, std::size_t string, const Shape& shape, std::size_t fret,
                              float opacity) {
    const StringLane& lane = places_->lanes()[string];
    const double stop_m = fret == 0 ? lane.length_m : lane.frets[fret - 1].from_bridge_m;
    const double stop_height_m = fret == 0 ? 0 : lane.frets[fret - 1].height_m;
    auto& nanovg = canvas.nanovg();
    nanovg.beginPath();
    const PicturePoint nut = places_->point(string, lane.length_m, 0);
    nanovg.moveTo(nut.x, nut.y);
    const PicturePoint stop = places_->point(string, stop_m, stop_height_m);
    if (fret > 0) nanovg.lineTo(stop.x, stop.y);
    for (std::size_t j = 0; j < shape_points; ++j) {
        const double left = 1 - static_cast<double>(j + 1) / (shape_points + 1);
        const PicturePoint at =
            places_->point(string, stop_m * left, stop_height_m * left + static_cast<double>(shape[j]));
        nanovg.lineTo(at.x, at.y);
    }
    nanovg.lineTo(places_->x_of(0), places_->rest_y(string));
    nanovg.lineJoin(DGL_NAMESPACE::NanoVG::ROUND);
    canvas.stroke(theme::string, thickness(string), opacity);
}

void StringsPanel::draw_pull(Canvas& canvas, const Pull& pull) {
    const float y = places_->rest_y(pull.string);
    const float reach = std::max(6.0F, places_->lane_height() * 0.48F);
    const float pulled = std::clamp(pull.y - pull.began_y, -reach, reach);
    const float x = places_->x_of(pull.from_bridge_m);
    auto& nanovg = canvas.nanovg();
    nanovg.beginPath();
    nanovg.moveTo(places_->x_of(places_->lanes()[pull.string].length_m), y);
    nanovg.lineTo(x, y + pulled);
    nanovg.lineTo(places_->x_of(0), y);
    canvas.stroke(theme::string, thickness(pull.string));
    canvas.dot(x, y + pulled, 4, theme::accent);
}

/// Height of the string as it is drawn now, from the open string's rest line.
double StringsPanel::height_of(std::size_t string, double from_bridge_m) const {
    const Drawn& drawn = drawn_[string];
    if (!drawn.moves || drawn.count == 0) return 0;
    const StringLane& lane = places_->lanes()[string];
    const double stop_m = drawn.fret == 0 ? lane.length_m : lane.frets[drawn.fret - 1].from_bridge_m;
    const double stop_height_m = drawn.fret == 0 ? 0 : lane.frets[drawn.fret - 1].height_m;
    const double left = std::clamp(from_bridge_m / stop_m, 0.0, 1.0);
    const double place = (1 - left) * (shape_points + 1) - 1;
    const auto j = static_cast<std::size_t>(std::clamp(place, 0.0, shape_points - 1.0));
    return stop_height_m * left + static_cast<double>(drawn.shapes[0][j]);
}

void StringsPanel::draw_flash(Canvas& canvas, const Flash& flash) {
    // At the string's lowest reach there: what it struck lies below, or rarely above.
    const PicturePoint at =
        places_->point(flash.string, flash.from_bridge_m, height_of(flash.string, flash.from_bridge_m));
    const float size = std::clamp(places_->lane_height() * 0.16F, 2.0F, 9.0F);
    canvas.dot(at.x, at.y, size * (0.6F + flash.brightness), theme::impact, 0.25F * flash.brightness);
    canvas.dot(at.x, at.y, size * 0.35F * (0.5F + flash.brightness), theme::impact, flash.brightness);
}

// ---------------------------------------------------------------------------------------------- mouse

void StringsPanel::describe(const StringHit& hit) {
    const StringLane& lane = places_->lanes()[hit.string];
    std::array<char, 96> text{};
    if (hit.fret > 0)
        std::snprintf(text.data(), text.size(), "%s string, fret %zu: %s. Drag along to slide",
                      string_name(hit.string).c_str(), hit.fret,
                      note_name(lane.frets[hit.fret - 1].key).c_str());
    else
        std::snprintf(text.data(), text.size(),
                      "%s string, %.0f mm from the bridge. Pull and let go; right button mutes",
                      string_name(hit.string).c_str(), 1000 * hit.from_bridge_m);
    shared_.say(text.data());
}

/// How far it was pulled is how hard it is plucked.
void StringsPanel::let_go(const Pull& pull, double velocity) {
    const auto preset_place = places_->pluck_place(pull.string).from_bridge_m;
    const double factor = preset_place ? pull.from_bridge_m / *preset_place : 1.0;
    hand_.pluck(pull.string, places_->lanes()[pull.string].open_key, factor, velocity);
}

bool StringsPanel::press(const Pointer& pointer) {
    if (!shared_.layout.strings.has(pointer.x, pointer.y)) return false;
    if (!places_) return true;
    const auto hit = places_->hit(pointer.x, pointer.y);
    shared_.moving_changed = true;
    if (pointer.button == 2) {
        muting_ = true;
        hand_.lay_palm(true);
        if (hit) hand_.mute(hit->string, shared_.picture);
        return true;
    }
    if (!hit || pointer.button != 1) return true;
    set_focus(0);
    if (hit->fret > 0) {
        const float share = std::abs(pointer.y - places_->rest_y(hit->string)) / places_->lane_height();
        hand_.press(hit->string, places_->lanes()[hit->string].frets[hit->fret - 1].key,
                    0.85 - 0.6 * std::min(0.5, static_cast<double>(share)));
    } else {
        pull_ = Pull{hit->string, hit->from_bridge_m, pointer.x, pointer.y, pointer.y};
    }
    return true;
}

void StringsPanel::drag(const Pointer& pointer) {
    if (!places_) return;
    shared_.moving_changed = true;
    const auto hit = places_->hit(pointer.x, pointer.y);
    if (muting_) {
        if (hit) hand_.mute(hit->string, shared_.picture);
        return;
    }
    if (hand_.presses()) {
        if (hit && hit->fret > 0) hand_.slide(places_->lanes()[hit->string].frets[hit->fret - 1].key);
        return;
    }
    if (!pull_) return;
    const float speed = std::abs(pointer.y - pull_->y);
    pull_->x = pointer.x;
    pull_->y = pointer.y;
    // Over the next string: this one slips off, and the hand goes on to the next.
    if (!hit || hit->string == pull_->string || hit->fret > 0) return;
    let_go(*pull_, std::clamp(0.35 + static_cast<double>(speed) / 60, 0.35, 1.0));
    pull_ = Pull{hit->string, hit->from_bridge_m, pointer.x, pointer.y, pointer.y};
}

void StringsPanel::release(const Pointer& pointer) {
    shared_.moving_changed = true;
    if (muting_) {
        muting_ = false;
        hand_.lay_palm(false);
        return;
    }
    hand_.lift();
    if (!pull_) return;
    const float reach = std::max(6.0F, places_->lane_height() * 0.48F);
    const double pulled = std::min(1.0, static_cast<double>(std::abs(pointer.y - pull_->began_y) / reach));
    constexpr double of_a_click = 0.6;
    const bool is_click = pulled < 0.08;
    let_go(*pull_, is_click ? of_a_click : 0.2 + 0.8 * pulled);
    pull_.reset();
}

bool StringsPanel::hover(const Pointer& pointer) {
    if (!places_ || !shared_.layout.strings.has(pointer.x, pointer.y)) {
        leave();
        return false;
    }
    const auto hit = places_->hit(pointer.x, pointer.y);
    const bool moved = hit.has_value() != under_.has_value() || (hit && hit->string != under_->string);
    if (moved) shared_.moving_changed = true;
    under_ = hit;
    if (hit) describe(*hit);
    return true;
}

void StringsPanel::leave() {
    if (under_) shared_.moving_changed = true;
    under_.reset();
}

bool StringsPanel::key(const KeyPress& press) {
    if (!places_ || places_->lanes().empty()) return false;
    const StringLane& lane = places_->lanes()[chosen_string_];
    constexpr double velocity = 0.7;
    switch (press.key) {
        case KeyName::Up:
            chosen_string_ = std::min(chosen_string_ + 1, places_->lanes().size() - 1);
            break;
        case KeyName::Down:
            chosen_string_ -= std::min<std::size_t>(chosen_string_, 1);
            break;
        case KeyName::Left:
            chosen_fret_ -= std::min<std::size_t>(chosen_fret_, 1);
            break;
        case KeyName::Right:
            chosen_fret_ += 1;
            break;
        case KeyName::Enter:
            hand_.pluck(chosen_string_, chosen_fret_ == 0 ? lane.open_key : lane.frets[chosen_fret_ - 1].key,
                        shared_.performance.value(ParameterId::PluckPosition), velocity);
            return true;
        case KeyName::Delete:
            hand_.mute(chosen_string_, shared_.picture);
            return true;
        default:
            return false;
    }
    const StringLane& now = places_->lanes()[chosen_string_];
    chosen_fret_ = std::min(chosen_fret_, now.frets.size());
    shared_.say(string_name(chosen_string_) + " string, fret " + std::to_string(chosen_fret_));
    shared_.still_changed = true;
    return true;
}

}  // namespace jawari::host::window
