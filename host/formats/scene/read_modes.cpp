#include "formats/scene/read_modes.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

enum class DampingModel { None, Valette, DecayTimes };

ValetteLoss read_valette(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path,
                        {"model", "diameter_m", "air_viscosity_Pa_s", "air_density_kg_per_m3",
                         "viscoelastic_loss_angle_rad", "inverse_quality"},
                        problems);
    ValetteLoss loss;
    loss.diameter_m = reader.number("diameter_m");
    loss.air_viscosity_Pa_s = reader.number("air_viscosity_Pa_s");
    loss.air_density_kg_per_m3 = reader.number("air_density_kg_per_m3");
    loss.viscoelastic_loss_angle_rad = reader.number("viscoelastic_loss_angle_rad");
    loss.inverse_quality = reader.number("inverse_quality");
    return loss;
}

DecayTimePoints read_decay_times(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"model", "points"}, problems);
    DecayTimePoints decay;
    const Value* points = reader.require("points", "an array of 2");
    if (points == nullptr) return decay;
    const auto* array = std::get_if<json::Array>(&points->content);
    if (array == nullptr || array->size() != decay.points.size()) {
        problems.add(reader.path_of("points"), json::describe(*points), "an array of 2");
        return decay;
    }
    for (std::size_t i = 0; i < decay.points.size(); ++i) {
        ObjectReader point((*array)[i], json::indexed(reader.path_of("points"), i), {"frequency_hz", "t60_s"},
                           problems);
        decay.points[i] = {point.number("frequency_hz"), point.number("t60_s")};
    }
    return decay;
}

}  // namespace

/// The model decides which other keys are allowed, so its word is read first, whatever the others are.
Damping read_damping(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path,
                        {"model", "diameter_m", "air_viscosity_Pa_s", "air_density_kg_per_m3",
                         "viscoelastic_loss_angle_rad", "inverse_quality", "points"},
                        problems);
    switch (reader.choice<DampingModel>("model", {{"none", DampingModel::None},
                                                  {"valette", DampingModel::Valette},
                                                  {"t60", DampingModel::DecayTimes}})) {
        case DampingModel::Valette:
            return read_valette(value, path, problems);
        case DampingModel::DecayTimes:
            return read_decay_times(value, path, problems);
        case DampingModel::None:
            break;
    }
    const ObjectReader refuses_other_keys(value, path, {"model"}, problems);
    return NoLoss{};
}

namespace {

PhysicalModes read_physical(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"count", "tension_N", "inharmonicity", "inharmonicity_law", "damping"},
                        problems);
    PhysicalModes modes;
    modes.count = reader.whole_number("count", 1, limits::modes);
    modes.tension_N = reader.number("tension_N");
    modes.inharmonicity = reader.number_or("inharmonicity", 0);
    modes.inharmonicity_law = reader.choice_or(
        "inharmonicity_law", InharmonicityLaw::SquareRoot,
        {{"square_root", InharmonicityLaw::SquareRoot}, {"first_order", InharmonicityLaw::FirstOrder}});
    if (const Value* damping = reader.find("damping"))
        modes.damping = read_damping(*damping, reader.path_of("damping"), problems);
    return modes;
}

ModeTable read_table(const Value& value, const std::string& path, Problems& problems) {
    ObjectReader reader(value, path, {"frequency_hz", "decay_per_s"}, problems);
    return {reader.numbers("frequency_hz", limits::modes), reader.numbers("decay_per_s", limits::modes)};
}

}  // namespace

std::variant<PhysicalModes, ModeTable> read_modes(const Value& value, const std::string& path,
                                                  Problems& problems) {
    if (const auto* object = std::get_if<json::Object>(&value.content))
        if (json::find(*object, "frequency_hz") != nullptr || json::find(*object, "decay_per_s") != nullptr)
            return read_table(value, path, problems);
    return read_physical(value, path, problems);
}

}  // namespace jawari::host
