#include "window/model/contactogram.h"

#include <algorithm>
#include <cmath>

namespace jawari::host::window {

float impulse_brightness(float impulse_Ns) {
    constexpr float darkest_Ns = 1e-6F;
    constexpr float brightest_Ns = 3e-3F;
    if (!(impulse_Ns > darkest_Ns)) return 0;
    return std::min(1.0F, std::log(impulse_Ns / darkest_Ns) / std::log(brightest_Ns / darkest_Ns));
}

Contactogram::Contactogram()
    : values_(contactogram_rows * impact_places), pixels_(contactogram_rows * impact_places * 4) {}

void Contactogram::add(const Impact& impact) {
    if (impact.place >= impact_places) return;
    float& value = values_[impact_places - 1 - impact.place];
    value = std::max(value, impulse_brightness(impact.impulse_Ns));
    if (value > 0) filled_ = contactogram_rows;
}

bool Contactogram::advance(double seconds) {
    passed_s_ += seconds;
    const auto rows = static_cast<std::size_t>(
        std::min(passed_s_ / contactogram_row_s, static_cast<double>(contactogram_rows)));
    if (rows == 0) return false;
    passed_s_ = std::fmod(passed_s_, contactogram_row_s);
    if (filled_ == 0) return false;
    const auto moved = static_cast<std::ptrdiff_t>(rows * impact_places);
    std::move_backward(values_.begin(), values_.end() - moved, values_.end());
    std::fill(values_.begin(), values_.begin() + moved, 0.0F);
    filled_ -= std::min(filled_, rows);
    return true;
}

void Contactogram::clear() {
    std::fill(values_.begin(), values_.end(), 0.0F);
    filled_ = 0;
}

std::span<const std::uint8_t> Contactogram::image() {
    const auto mixed = [](std::uint8_t from, std::uint8_t to, float share) {
        return static_cast<std::uint8_t>(static_cast<float>(from) +
                                         share * (static_cast<float>(to) - static_cast<float>(from)));
    };
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const float share = values_[i];
        // From the ground over the colour of impacts to that of text.
        const Colour from = share < 0.7F ? theme::ground : theme::impact;
        const Colour to = share < 0.7F ? theme::impact : theme::text;
        const float between = share < 0.7F ? share / 0.7F : (share - 0.7F) / 0.3F;
        pixels_[4 * i] = mixed(from.red, to.red, between);
        pixels_[4 * i + 1] = mixed(from.green, to.green, between);
        pixels_[4 * i + 2] = mixed(from.blue, to.blue, between);
        pixels_[4 * i + 3] = 255;
    }
    return pixels_;
}

}  // namespace jawari::host::window
