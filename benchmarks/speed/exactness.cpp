// Compares skipping with uniform stepping on the built-in scenes: all laws, four restitutions, contact rates
// of 1 to 8 MHz. Prints a row each and fails if one does not agree
// (tests/engine/support/agreement.h).
// Usage: exactness [SCENE [SOUND_S [HIGHEST_RATE_HZ]]]     lab/bass, 0.05 s, 8.064 MHz unless told
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "jawari/denormals.h"
#include "jawari/jawari.h"
#include "scenes.h"
#include "support/agreement.h"

namespace jawari::benchmarks {
namespace {

constexpr double output_rate_hz = 48000;

/// Returns whether they agree.
bool print_row(const std::string& scene, ImpactLaw law, double restitution, double contact_rate_hz,
               double sound_s) {
    const SceneModel model =
        compile(builtin(scene, output_rate_hz, contact_rate_hz, law, restitution)).value();
    const test::Agreement found =
        test::agreement(model, skip_all, static_cast<std::size_t>(sound_s * output_rate_hz));
    const bool agrees = found.agrees();
    std::array<char, 16> spread{};  // calm scenes need no uniform runs to compare with
    if (found.spread > 0) std::snprintf(spread.data(), spread.size(), "%.1e", found.spread);
    std::printf("| %s | %g | %.3f | %.1e | %s | %llu | %llu | %s |\n", name_of(law), restitution,
                contact_rate_hz / 1e6, found.difference, spread.data(),
                static_cast<unsigned long long>(found.impulses_skipped),
                static_cast<unsigned long long>(found.impulses), agrees ? "yes" : "NO");
    std::fflush(stdout);
    return agrees;
}

bool print_scene(const std::string& scene, double sound_s, double highest_rate_hz) {
    const NoDenormals guard;  // as jawari simulates
    std::printf("`%s`, %g s\n\n", scene.c_str(), sound_s);
    std::puts(
        "| law | e | contact rate (MHz) | difference | between uniform runs | impulses | without skipping | "
        "agrees "
        "|\n|---|---|---|---|---|---|---|---|");
    bool agrees = true;
    for (const ImpactLaw law :
         {ImpactLaw::Signorini, ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::PaoliSchatzman}) {
        for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
            if (law == ImpactLaw::Signorini && restitution > 0) continue;  // has none
            for (const double rate_hz : {1.008e6, 2.016e6, 4.032e6, 8.064e6}) {
                if (rate_hz <= highest_rate_hz)
                    agrees = print_row(scene, law, restitution, rate_hz, sound_s) && agrees;
            }
        }
    }
    return agrees;
}

}  // namespace
}  // namespace jawari::benchmarks

int main(int argc, char** argv) {
    const std::string scene = argc > 1 ? argv[1] : "lab/bass";
    const double sound_s = argc > 2 ? std::atof(argv[2]) : 0.05;
    const double highest_rate_hz = argc > 3 ? std::atof(argv[3]) : 8.064e6;
    if (!(sound_s > 0 && sound_s <= 10) || !(highest_rate_hz >= 1.008e6)) {
        std::fprintf(stderr, "exactness: SOUND_S must be in (0, 10], HIGHEST_RATE_HZ at least 1008000\n");
        return 2;
    }
    try {
        return jawari::benchmarks::print_scene(scene, sound_s, highest_rate_hz) ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "exactness: %s\n", error.what());
        return 1;
    }
}
