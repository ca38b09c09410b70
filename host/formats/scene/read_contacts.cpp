#include "formats/scene/read_contacts.h"

#include <cstddef>
#include <optional>
#include <string>

#include "formats/scene/read_attachments.h"
#include "formats/scene/read_drives.h"
#include "jawari/scene/obstacles.h"

namespace jawari::host {

namespace {

using json::ObjectReader;
using json::Problems;
using json::Value;

ContactDescription read_contact(ObjectReader& reader, std::size_t index, System& system,
                                DrivenTables& tables) {
    ContactDescription contact;
    const Place place = system.place(reader);
    contact.position_m = place.position_m;
    contact.point = place.point;
    if (!reader.has("motion")) {
        contact.height_m = reader.number("height_m");
    } else if (reader.has("height_m")) {
        reader.problems().add(reader.path_of("height_m"), "beside a motion", "either height_m or motion");
    }
    contact.restitution = reader.number_or("restitution", 0, {0, 1});
    contact.side = reader.choice_or("side", Side::Below, {{"below", Side::Below}, {"above", Side::Above}});
    contact.compliance = read_compliance(reader);
    read_motion(reader, index, tables);
    return contact;
}

std::vector<ContactDescription> read_contact_list(ObjectReader& string, System& system,
                                                  DrivenTables& tables) {
    std::vector<ContactDescription> contacts;
    const json::Array* array = string.array("contacts", limits::contacts);
    if (array == nullptr) return contacts;
    for (std::size_t i = 0; i < array->size() && !string.problems().any(); ++i) {
        ObjectReader reader((*array)[i], json::indexed(string.path_of("contacts"), i),
                            {system.place_key(), "height_m", "restitution", "side", "compliance", "motion"},
                            string.problems());
        contacts.push_back(read_contact(reader, i, system, tables));
    }
    return contacts;
}

/// One height for all frets, or a list of as many as there are frets.
std::vector<double> read_fret_heights(ObjectReader& frets, std::size_t count, bool& listed) {
    const Value* height = frets.require("height_m", "a number, or an array with one for each fret");
    if (height == nullptr) return {};
    const std::string place = frets.path_of("height_m");
    listed = std::holds_alternative<json::Array>(height->content);
    if (!listed)
        return std::vector<double>(count, json::read_number(*height, place, std::nullopt, frets.problems()));
    auto heights = json::read_numbers(*height, place, limits::contacts, frets.problems());
    if (heights.size() != count)
        frets.problems().add(place, json::describe(*height),
                             "as many heights as count, " + std::to_string(count));
    return heights;
}

std::vector<ContactDescription> complying(std::vector<ContactDescription> contacts,
                                          const std::optional<Compliance>& compliance) {
    for (ContactDescription& contact : contacts) contact.compliance = compliance;
    return contacts;
}

std::vector<ContactDescription> read_frets(ObjectReader& string, double length_m, ContactSources& sources) {
    ObjectReader frets(*string.find("frets"), string.path_of("frets"),
                       {"count", "height_m", "restitution", "compliance"}, string.problems());
    const std::size_t count = frets.whole_number("count", 1, limits::contacts - sources.contacts);
    const auto heights = read_fret_heights(frets, count, sources.fret_heights_listed);
    const double restitution = frets.number_or("restitution", 0, {0, 1});
    const auto compliance = read_compliance(frets);
    if (string.problems().any()) return {};
    return complying(equal_temperament_frets(length_m, heights, restitution), compliance);
}

std::vector<ProfilePoint> read_profile(ObjectReader& neck) {
    std::vector<ProfilePoint> profile;
    const json::Array* points = neck.array("profile_m", limits::contacts);
    if (points == nullptr) return profile;
    const std::string place = neck.path_of("profile_m");
    if (points->empty()) neck.problems().add(place, "an empty array", "at least one [position, height]");
    for (std::size_t i = 0; i < points->size() && !neck.problems().any(); ++i) {
        const std::string at = json::indexed(place, i);
        const auto point = json::read_numbers((*points)[i], at, 2, neck.problems());
        if (neck.problems().any()) break;
        if (point.size() != 2) {
            neck.problems().add(at, json::describe((*points)[i]), "[position, height]");
        } else if (!profile.empty() && point[0] < profile.back().first) {
            neck.problems().add(
                json::indexed(at, 0), json::describe(Value{point[0]}),
                "positions that do not decrease, here from " + json::describe(Value{profile.back().first}));
        } else {
            profile.emplace_back(point[0], point[1]);
        }
    }
    return profile;
}

std::vector<ContactDescription> read_neck(ObjectReader& string, double length_m,
                                          const ContactSources& sources) {
    ObjectReader neck(*string.find("neck"), string.path_of("neck"),
                      {"grid_points", "profile_m", "restitution", "compliance"}, string.problems());
    const std::size_t points =
        neck.whole_number("grid_points", 1, limits::contacts - sources.contacts - sources.frets);
    const auto profile = read_profile(neck);
    const double restitution = neck.number_or("restitution", 0, {0, 1});
    const auto compliance = read_compliance(neck);
    if (string.problems().any()) return {};
    return complying(sampled_neck(length_m, points, profile, restitution), compliance);
}

void append(std::vector<ContactDescription>& list, const std::vector<ContactDescription>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

std::vector<ContactDescription> read_all_contacts(ObjectReader& string, System& system, double length_m,
                                                  ContactSources& sources, DrivenTables& tables) {
    std::vector<ContactDescription> contacts;
    if (string.has("contacts")) contacts = read_contact_list(string, system, tables);
    sources.contacts = contacts.size();
    if (string.has("frets")) append(contacts, read_frets(string, length_m, sources));
    sources.frets = contacts.size() - sources.contacts;
    if (string.has("neck")) append(contacts, read_neck(string, length_m, sources));
    sources.neck = contacts.size() - sources.contacts - sources.frets;
    return contacts;
}

}  // namespace jawari::host
