// A scene file as read: what the engine compiles, and what only the program needs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/scene/time_table.h"
#include "jawari/result.h"
#include "jawari/scene/description.h"

namespace jawari::host {

/// Where a string's contacts come from; they are numbered in this order.
struct ContactSources {
    std::size_t contacts = 0;          ///< written out under "contacts"
    std::size_t frets = 0;             ///< from "frets"
    bool fret_heights_listed = false;  ///< "frets" gives each its own height
    std::size_t neck = 0;              ///< from "neck"
};

/// What a force follows.
struct ForceTable {
    TimeTable table;
    std::optional<double> height_m;  ///< of a pluck: the table's 1 stands for the force that pulls so far
};

/// What a contact's height follows.
struct MotionTable {
    TimeTable table;
    std::size_t contact = 0;
};

struct DrivenTables {
    std::vector<ForceTable> forces;  ///< in the order of StringDescription::forces
    std::vector<MotionTable> motions;
};

struct Scene {
    std::string file;  ///< the file's path or the built-in name, for messages
    std::string name;  ///< for headings: the file's name without folder and extension, or the built-in name
    std::string text;  ///< the JSON as read

    double duration_s = 0;
    /// contact_rate_hz and law of the description hold only once resolve_defaults() has been called.
    SceneDescription description;
    std::optional<double> contact_rate_hz;
    std::optional<ImpactLaw> law;
    std::vector<ContactSources> contact_sources;  ///< one per string
    std::vector<DrivenTables> tables;             ///< one per string
};

/// Longest simulation.
inline constexpr double longest_duration_s = 86400;
/// Values of a force or a motion: 10 minutes at 192 kHz.
inline constexpr std::size_t most_driven_frames = 115'200'000;
/// Scenes without contact_rate_hz get at least this.
inline constexpr double default_contact_rate_hz = 2e6;

/// Fills in what depends on other settings: contact rate (the smallest multiple of the output rate that is >=
/// 2 MHz), law (`signorini`; `newton` for the theta scheme, which has no other), and the values of forces and
/// motions at the output rate.
void resolve_defaults(Scene& scene);

/// The engine numbers all contacts of a string in one list; this names the key of the file that a failure is
/// about.
Failure in_file_terms(const Scene& scene, const Failure& failure);

}  // namespace jawari::host
