#include "formats/scene/read_attachments.h"

namespace jawari::host {

namespace {

using json::ObjectReader;

void read_law(ObjectReader& reader, Compliance& compliance) {
    compliance.stiffness = reader.number_or("stiffness", 0);
    compliance.exponent = reader.number_or("exponent", 1);
    compliance.loss_s_per_m = reader.number_or("loss_s_per_m", 0);
}

SpringDescription read_spring(ObjectReader& reader, System& system) {
    const Place place = system.place(reader);
    SpringDescription spring;
    spring.position_m = place.position_m;
    spring.point = place.point;
    spring.height_m = reader.number_or("height_m", 0);
    spring.stiffness_N_per_m = reader.number_or("stiffness_N_per_m", 0);
    spring.resistance_kg_per_s = reader.number_or("resistance_kg_per_s", 0);
    return spring;
}

FlyingHammer read_hammer(ObjectReader& reader, System& system) {
    const Place place = system.place(reader);
    FlyingHammer hammer;
    hammer.position_m = place.position_m;
    hammer.point = place.point;
    hammer.side = reader.choice_or("side", Side::Below, {{"below", Side::Below}, {"above", Side::Above}});
    hammer.time_s = reader.number_or("time_s", 0);
    hammer.mass_kg = reader.number("mass_kg");
    hammer.velocity_m_per_s = reader.number("velocity_m_per_s");
    read_law(reader, hammer.compliance);
    return hammer;
}

template <class Item, class Read>
std::vector<Item> read_list(ObjectReader& reader, std::string_view key, std::size_t most,
                            const std::vector<std::string_view>& keys, const Read& read) {
    std::vector<Item> items;
    if (!reader.has(key)) return items;
    const json::Array* array = reader.array(key, most);
    if (array == nullptr) return items;
    for (std::size_t i = 0; i < array->size() && !reader.problems().any(); ++i) {
        ObjectReader item((*array)[i], json::indexed(reader.path_of(key), i), keys, reader.problems());
        items.push_back(read(item));
    }
    return items;
}

}  // namespace

std::optional<Compliance> read_compliance(ObjectReader& reader) {
    const json::Value* value = reader.find("compliance");
    if (value == nullptr) return std::nullopt;
    ObjectReader keys(*value, reader.path_of("compliance"),
                      {"stiffness", "exponent", "loss_s_per_m", "resistance_kg_per_s"}, reader.problems());
    Compliance compliance;
    read_law(keys, compliance);
    compliance.resistance_kg_per_s = keys.number_or("resistance_kg_per_s", 0);
    return compliance;
}

std::vector<SpringDescription> read_springs(ObjectReader& reader, System& system) {
    return read_list<SpringDescription>(
        reader, "springs", limits::contacts,
        {system.place_key(), "height_m", "stiffness_N_per_m", "resistance_kg_per_s"},
        [&](ObjectReader& item) { return read_spring(item, system); });
}

std::vector<FlyingHammer> read_hammers(ObjectReader& reader, System& system) {
    return read_list<FlyingHammer>(reader, "hammers", limits::hammers,
                                   {system.place_key(), "side", "time_s", "mass_kg", "velocity_m_per_s",
                                    "stiffness", "exponent", "loss_s_per_m"},
                                   [&](ObjectReader& item) { return read_hammer(item, system); });
}

}  // namespace jawari::host
