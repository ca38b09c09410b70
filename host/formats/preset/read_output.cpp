#include "formats/preset/read_output.h"

#include <cmath>
#include <numbers>

#include "formats/preset/read_section.h"

namespace jawari::host::preset {

PickupDescription read_pickup(const json::Value& value, const std::string& path, json::Problems& problems) {
    Section reader(value, path,
                   {"position_from_bridge_m", "position_share", "width_m", "level", "quantity",
                    "magnet_distance_m", "resonance_hz", "quality_factor"},
                   problems);
    PickupDescription pickup;
    pickup.quantity = reader.choice_or<PickupQuantity>("quantity", pickup.quantity,
                                                       {{"velocity", PickupQuantity::Velocity},
                                                        {"displacement", PickupQuantity::Displacement},
                                                        {"bridge_force", PickupQuantity::BridgeForce}});
    if (pickup.quantity != PickupQuantity::BridgeForce) pickup.place = reader.place();
    pickup.width_m = reader.number_or("width_m", pickup.width_m);
    pickup.level = reader.number_or("level", pickup.level);
    pickup.magnet_distance_m = reader.number_or("magnet_distance_m", pickup.magnet_distance_m);
    pickup.resonance_hz = reader.number_or("resonance_hz", pickup.resonance_hz);
    pickup.quality_factor = reader.number_or("quality_factor", pickup.quality_factor);
    return pickup;
}

BodyModeDescription read_body_mode(const json::Value& value, const std::string& path,
                                   json::Problems& problems) {
    Section reader(value, path,
                   {"frequency_hz", "t60_s", "quality_factor", "gain_left", "gain_right", "mass_kg", "shape"},
                   problems);
    BodyModeDescription mode;
    mode.frequency_hz = reader.number("frequency_hz");
    if (reader.has("t60_s") == reader.has("quality_factor")) {
        problems.add(reader.path_of("t60_s"), reader.has("t60_s") ? "given beside quality_factor" : "missing",
                     "either t60_s or quality_factor");
    } else if (reader.has("t60_s")) {
        mode.t60_s = reader.number("t60_s");
    } else {
        // sigma = omega/(2 Q), T60 = ln(1000)/sigma
        const double q = reader.number("quality_factor", {0.1, 1e5});
        mode.t60_s = std::log(1000.0) * q / (std::numbers::pi * mode.frequency_hz);
    }
    mode.gain_left = reader.number("gain_left");
    mode.gain_right = reader.number_or("gain_right", mode.gain_left);
    if (reader.has("mass_kg")) mode.mass_kg = reader.number("mass_kg", {1e-4, 1e4});
    if (reader.has("shape")) mode.shape = reader.numbers("shape", limits::instrument_strings);
    return mode;
}

BridgeDescription read_bridge(const json::Value& value, const std::string& path, json::Problems& problems) {
    Section reader(value, path, {"open_strings"}, problems);
    BridgeDescription bridge;
    bridge.open_strings = reader.number_or("open_strings", bridge.open_strings);
    return bridge;
}

}  // namespace jawari::host::preset
