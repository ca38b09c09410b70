// Qualities keep the error they promise on the published bass, measured against a far finer run.
#include "jawari/scene/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "formats/scene/read_scene.h"
#include "jawari/jawari.h"

namespace jawari::host {
namespace {

/// All probes, one after the other.
std::vector<double> rendered(const SceneDescription& scene) {
    const SceneModel model = compile(scene).value();
    SceneState state = make_state(model);
    const auto frames = static_cast<std::size_t>(0.1 * scene.output_rate_hz);
    std::vector<double> samples(model.probe_count * frames);
    std::vector<double*> outputs;
    for (std::size_t p = 0; p < model.probe_count; ++p) outputs.push_back(samples.data() + p * frames);
    render(model, state, outputs, frames);
    return samples;
}

double relative_error(const std::vector<double>& a, const std::vector<double>& truth) {
    double difference = 0;
    double size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += (a[i] - truth[i]) * (a[i] - truth[i]);
        size += truth[i] * truth[i];
    }
    return std::sqrt(difference / size);
}

TEST(Quality, ErrorsStayBelowTheirTargetsOnTheBass) {
    SceneDescription bass = load_scene("lab/bass").value().description;
    bass.output_rate_hz = 48000;
    bass.law = ImpactLaw::Signorini;
    SceneDescription finest = bass;
    finest.contact_rate_hz = 48000 * 1344;
    const auto truth = rendered(finest);
    for (const Quality quality : {Quality::Live, Quality::Studio, Quality::Reference}) {
        const double error = relative_error(rendered(at_quality(bass, quality)), truth);
        EXPECT_LT(error, error_target(quality)) << name_of(quality);
        EXPECT_GT(error, error_target(quality) / 100) << name_of(quality);
    }
}

}  // namespace
}  // namespace jawari::host
