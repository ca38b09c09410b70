// Arbitrary bytes as a scene file: refused properly, or compiled and rendered to finite numbers.
#include <cmath>
#include <cstdint>
#include <vector>

#include "check.h"
#include "formats/scene/read_scene.h"
#include "jawari/jawari.h"

namespace {

using namespace jawari;

constexpr std::size_t largest_cost = 50000;  // modes x contacts, so that an input takes milliseconds
constexpr std::size_t frames = 4;

std::size_t cost(const StringDescription& string) {
    const auto* physical = std::get_if<PhysicalModes>(&string.modes);
    const std::size_t modes =
        physical != nullptr ? physical->count : std::get<ModeTable>(string.modes).frequency_hz.size();
    return modes * (string.contacts.size() + string.probes.size() + 1);
}

bool cheap(const SceneDescription& scene) {
    std::size_t total = 0;
    for (const StringDescription& string : scene.strings) total += cost(string);
    return total <= largest_cost && scene.contact_rate_hz <= 64 * scene.output_rate_hz;
}

void render_some(const SceneModel& model) {
    SceneState state = make_state(model, Metering::Step);
    std::vector<std::vector<double>> rows(model.probe_count, std::vector<double>(frames));
    std::vector<double*> outputs;
    for (auto& row : rows) outputs.push_back(row.data());
    render(model, state, outputs, frames);

    bool reset = false;
    for (const StringState& string : state.strings) reset = reset || string.counters.nonfinite_resets > 0;
    for (const auto& row : rows) {
        for (const double value : row) fuzz::require(std::isfinite(value) || reset, "output is finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    auto scene = host::read_scene(text, "fuzz.json");
    if (!scene) {
        fuzz::require_proper_refusal(scene.error(), "fuzz.json");
        return 0;
    }
    host::resolve_defaults(scene.value());
    if (!cheap(scene.value().description)) return 0;
    const auto model = compile(scene.value().description);
    if (model) {
        render_some(model.value());
    } else {
        fuzz::require_proper_failure(host::in_file_terms(scene.value(), model.failure()));
    }
    return 0;
}
