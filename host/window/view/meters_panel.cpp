#include "window/view/meters_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace jawari::host::window {

namespace {

using theme::grid;

constexpr float lowest_db = -60;
constexpr float fall_db_per_s = 30;
constexpr float hold_s = 1.5F;
/// A level below this is shown as none: -66 dB.
constexpr float silent = 5e-4F;

float share_of(float level) {
    if (level <= 0) return 0;
    return std::clamp(1 - 20 * std::log10(level) / lowest_db, 0.0F, 1.0F);
}

std::string percent(float share) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.0f %%", static_cast<double>(100 * share));
    return text.data();
}

Box bars_of(const Box& meters) {
    return {meters.x, meters.y + 2, meters.width - 22 * grid, meters.height - 4};
}

}  // namespace

void MetersPanel::take(const StagePicture& picture) {
    const std::array<float, 2> peaks{picture.peak_left, picture.peak_right};
    for (std::size_t side = 0; side < 2; ++side) {
        if (peaks[side] > level_[side]) shared_.moving_changed = true;
        level_[side] = std::max(level_[side], peaks[side]);
        if (peaks[side] >= held_[side] && peaks[side] > silent) {
            held_[side] = peaks[side];
            held_s_ = hold_s;
        }
        if (peaks[side] > 1 && !clipped_) {
            clipped_ = true;
            shared_.still_changed = true;
        }
    }
    // At rest a load that wavers by a hundredth is no news.
    constexpr float least_news = 0.02F;
    if (std::abs(picture.load - load_) >= least_news && picture.moving > 0) {
        load_ = picture.load;
        shared_.still_changed = true;
    } else if (picture.moving == 0 && load_ != 0) {
        load_ = 0;
        shared_.still_changed = true;
    }
    if (picture.moving > 0 && picture.worst_load > worst_ + least_news) {
        worst_ = picture.worst_load;
        shared_.still_changed = true;
    }
}

void MetersPanel::follow(double passed_s) {
    const float fall = std::pow(10.0F, -fall_db_per_s * static_cast<float>(passed_s) / 20);
    held_s_ -= static_cast<float>(passed_s);
    for (std::size_t side = 0; side < 2; ++side) {
        if (level_[side] == 0 && held_[side] == 0) continue;
        shared_.moving_changed = true;
        level_[side] *= fall;
        if (level_[side] < silent) level_[side] = 0;
        if (held_s_ <= 0) held_[side] = 0;
    }
    const int quality = shared_.performance.facts().quality_level;
    if (quality != quality_) {
        quality_ = quality;
        shared_.still_changed = true;
    }
}

void MetersPanel::draw_still(Canvas& canvas) {
    const Box& meters = shared_.layout.meters;
    const Box bars = bars_of(meters);
    for (const float db : {-48.0F, -36.0F, -24.0F, -12.0F, 0.0F}) {
        const float x = bars.x + bars.width * (1 - db / lowest_db);
        canvas.segment(x, bars.y, x, bars.y + 20, theme::line, 1);
        std::array<char, 8> text{};
        std::snprintf(text.data(), text.size(), "%.0f", static_cast<double>(db));
        canvas.text({x - 16, bars.y + 21, 32, 14}, text.data(), theme::small_type, theme::quiet,
                    TextPlace::Middle);
    }
    if (clipped_) canvas.dot(bars.right() + 6, bars.y + 10, 3, theme::impact);
    const Box facts{bars.right() + 3 * grid, meters.y, meters.right() - bars.right() - 3 * grid,
                    meters.height};
    const PerformanceFacts now = shared_.performance.facts();
    const Box first{facts.x, facts.y + 1, facts.width, 18};
    const Box second{facts.x, facts.y + 20, facts.width, 18};
    canvas.text(first, "Load", theme::small_type, theme::quiet);
    const bool heavy = worst_ > 1;
    canvas.text({first.x + 5 * grid, first.y, first.width, first.height},
                percent(load_) + "  worst " + percent(worst_), theme::small_type,
                heavy ? theme::impact : theme::text);
    canvas.text(second, "Quality", theme::small_type, theme::quiet);
    const std::string quality =
        quality_ == 0 ? (now.adapts ? "full, adapts" : "full") : "lowered, step " + std::to_string(quality_);
    canvas.text({second.x + 5.5F * grid, second.y, second.width, second.height}, quality, theme::small_type,
                quality_ == 0 ? theme::text : theme::impact);
}

void MetersPanel::draw_moving(Canvas& canvas) {
    const Box bars = bars_of(shared_.layout.meters);
    for (std::size_t side = 0; side < 2; ++side) {
        const Box bar{bars.x, bars.y + 2 + 9 * static_cast<float>(side), bars.width, 6};
        canvas.box(bar, theme::raised, 2);
        const float share = share_of(level_[side]);
        if (share > 0)
            canvas.box({bar.x, bar.y, bar.width * share, bar.height},
                       level_[side] > 1 ? theme::impact : theme::accent, 2);
        if (held_[side] > 0) {
            const float x = bar.x + bar.width * share_of(held_[side]);
            canvas.segment(x, bar.y, x, bar.bottom(), theme::text, 1.5F);
        }
    }
}

bool MetersPanel::press(const Pointer& pointer) {
    if (!shared_.layout.meters.has(pointer.x, pointer.y)) return false;
    worst_ = 0;
    clipped_ = false;
    shared_.still_changed = true;
    return true;
}

bool MetersPanel::hover(const Pointer& pointer) {
    if (!shared_.layout.meters.has(pointer.x, pointer.y)) return false;
    shared_.say(
        "Peak levels in dB of full scale; share of the time that a block may take; a click sets the worst "
        "back");
    return true;
}

}  // namespace jawari::host::window
