// Very long runs: a day of playing, a thousand million steps. Prints one JSON object; progress goes to
// standard error. Interrupted, it judges what has been done. docs/reliability.md.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <string>

#include "jawari/denormals.h"
#include "long_play.h"
#include "phase_drift.h"

namespace jawari::soak {
namespace {

// Largest changes between the first and the last ten minutes.
constexpr std::size_t compared_minutes = 10;
constexpr double most_cents = 0.01;
constexpr double most_db = 0.01;
constexpr double most_kib = 64;
/// Of the phase after 1e9 steps: five times what is published (docs/reliability.md).
constexpr double most_phase_rad = 1e-8;

std::atomic<bool> interrupted{false};
extern "C" void on_interrupt(int) {
    interrupted = true;
}

struct Options {
    double hours = 0;
    std::uint64_t steps = 0;
    std::string preset = "bass-fretted";
};

int print_play(const LongPlay& played) {
    const Drift drift = drift_of(played.minutes, compared_minutes);
    const double played_s = 60 * static_cast<double>(played.minutes.size());
    const bool compared = played.minutes.size() > compared_minutes;
    const bool steady = std::abs(drift.pitch_cents) <= most_cents && std::abs(drift.level_db) <= most_db &&
                        std::abs(drift.energy_db) <= most_db && drift.resident_kib <= most_kib &&
                        played.nonfinite_resets == 0 && played.dropped_messages == 0;
    std::printf(
        "{\"minutes\": %zu, \"times_real_time\": %.1f, \"notes\": %llu, \"nonfinite_resets\": %llu, "
        "\"pitch_hz\": %.9f, \"level_dbfs\": %.6f, \"energy_J\": %.9g, \"resident_kib\": %.0f, "
        "\"pitch_drift_cents\": %.3g, \"level_drift_db\": %.3g, \"energy_drift_db\": %.3g, "
        "\"resident_drift_kib\": %.0f, \"steady\": %s}\n",
        played.minutes.size(), played_s / played.cpu_s, static_cast<unsigned long long>(played.notes),
        static_cast<unsigned long long>(played.nonfinite_resets), played.minutes.back().pitch_hz,
        20 * std::log10(played.minutes.back().level), played.minutes.back().energy_J,
        played.minutes.back().resident_kib, drift.pitch_cents, drift.level_db, drift.energy_db,
        drift.resident_kib, compared ? steady ? "true" : "false" : "null");
    return compared && steady ? 0 : 1;
}

int run_play(const Options& options) {
    constexpr double rate_hz = 48000;
    const auto instrument = host::load_and_compile(options.preset, {.output_rate_hz = rate_hz, .tuning = {}});
    if (!instrument) {
        std::fprintf(stderr, "jawari_soak: %s\n", instrument.error().message.c_str());
        return 2;
    }
    const auto minutes = static_cast<std::uint64_t>(std::ceil(options.hours * 60));
    const LongPlay played = play_long(instrument.value(), rate_hz, minutes, [&](const LongPlay& so_far) {
        if (so_far.minutes.size() % 10 == 0)
            std::fprintf(stderr, "%zu of %llu minutes, %.0f s of CPU time\n", so_far.minutes.size(),
                         static_cast<unsigned long long>(minutes), so_far.cpu_s);
        return !interrupted;
    });
    return print_play(played);
}

int run_steps(const Options& options, Advance advance) {
    const NoDenormals guard;
    const PhaseDrift drift = run_phase_drift(options.steps, advance, [&](std::uint64_t done) {
        if (done % 42000000 == 0)
            std::fprintf(stderr, "%llu of %llu steps\n", static_cast<unsigned long long>(done),
                         static_cast<unsigned long long>(options.steps));
        return !interrupted;
    });
    std::printf(
        "{\"steps\": %llu, \"by\": \"%s\", \"contact_rate_hz\": %.0f, \"worst_phase_error_rad\": %.3g, "
        "\"worst_amplitude_error\": %.3g, \"modes\": [",
        static_cast<unsigned long long>(drift.steps), advance == Advance::Steps ? "steps" : "frames",
        drift.contact_rate_hz, drift.worst_phase_rad(), drift.worst_amplitude());
    for (std::size_t k = 0; k < drift.modes.size(); ++k)
        std::printf(
            "%s{\"frequency_hz\": %.1f, \"decay_per_s\": %.3g, \"phase_rad\": %.2e, \"amplitude\": %.2e}",
            k == 0 ? "" : ", ", drift.modes[k].frequency_hz, drift.modes[k].decay_per_s,
            drift.modes[k].phase_rad, drift.modes[k].amplitude);
    std::printf("]}\n");
    return drift.worst_phase_rad() <= most_phase_rad ? 0 : 1;
}

}  // namespace
}  // namespace jawari::soak

int main(int argc, char** argv) {
    using namespace jawari::soak;
    Options options;
    CLI::App app("Very long runs: what changes in a day of playing, in a thousand million steps");
    app.add_option("--hours", options.hours, "of playing (24 is the published run)")
        ->check(CLI::Range(0.01, 1e4));
    app.add_option("--steps", options.steps, "of free modes, step by step and by frames (1000000000)");
    app.add_option("--preset", options.preset, "that plays");
    CLI11_PARSE(app, argc, argv);
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    if (options.hours == 0 && options.steps == 0) {
        std::fprintf(stderr, "jawari_soak: nothing to do (allowed: --hours, --steps)\n");
        return 2;
    }
    int result = 0;
    if (options.steps > 0) result = run_steps(options, Advance::Steps) | run_steps(options, Advance::Frames);
    if (options.hours > 0) result |= run_play(options);
    return result;
}
