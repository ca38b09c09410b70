// What there is to know about a scene before it is simulated.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/scene/scene.h"
#include "jawari/scene/cost.h"

namespace jawari::host {

struct VibratingSurvey {
    std::string name;
    std::string system;  ///< whether it is a string
    std::size_t modes = 0;
    double lowest_hz = 0, highest_hz = 0;
    double longest_t60_s = 0, shortest_t60_s = 0;  ///< infinite without losses
    std::size_t rigid_contacts = 0, compliant_contacts = 0, hammers = 0, springs = 0, forces = 0, motions = 0;
    std::vector<std::string> probes;  ///< names, as in outputs
    FrameCost cost;                   ///< of an output row
};

struct SceneSurvey {
    Scene scene;
    std::size_t steps_per_row = 0;
    std::vector<VibratingSurvey> strings;
    double cpu_compile_s = 0;
};

/// Compiles the scene.
Outcome<SceneSurvey> survey_scene(Scene scene);

std::string survey_text(const SceneSurvey& survey);
std::string survey_json(const SceneSurvey& survey);

}  // namespace jawari::host
