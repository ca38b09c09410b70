// Plays hostile scenes and hostile music, each named by a seed, and checks every block. Prints one line of
// JSON a seed; a violation also prints the command that replays it. docs/engine/stability.md.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>

#include "compare_laws.h"
#include "report.h"
#include "run_seed.h"

namespace jawari::stress {
namespace {

struct Options {
    std::uint64_t seed = 0, first = 0, count = 0, compare = 0;
    Budget budget;
    bool verbose = false;
};

/// Returns the number of violations.
std::size_t play(const PresetShelf& shelf, std::uint64_t seed, const Options& options) {
    if (options.verbose) std::fprintf(stderr, "%s\n", describe_seed(shelf, seed).c_str());
    const Report report = run_seed(shelf, seed, options.budget);
    std::printf("%s\n", json_line(report).c_str());
    std::fflush(stdout);
    const std::string lines = violation_lines(report);
    if (!lines.empty()) std::fprintf(stderr, "%s", lines.c_str());
    return report.judge.violations().size();
}

void print_comparison(std::uint64_t seeds) {
    std::printf(
        "| modes | law | scenes | impulses | energy rose | by more than 1e100 | largest H/H(0) | deepest, in "
        "heights |\n|---|---|---|---|---|---|---|---|\n");
    for (const bool of_tables : {false, true}) {
        for (const LawRecord& r : compare_laws(seeds, of_tables))
            std::printf("| %s | `%s` | %zu | %llu | %zu | %zu | 1 + %.2g | %.2g |\n",
                        of_tables ? "table" : "physics", name_of(r.law), r.scenes,
                        static_cast<unsigned long long>(r.impulses), r.rose, r.exploded, r.largest_gain - 1,
                        r.deepest);
    }
}

}  // namespace
}  // namespace jawari::stress

int main(int argc, char** argv) {
    using namespace jawari::stress;
    Options options;
    CLI::App app("Plays hostile scenes and checks what is proven of them");
    auto* seed = app.add_option("--seed", options.seed, "play this one");
    app.add_option("--first", options.first, "first of a range of seeds")->excludes(seed);
    app.add_option("--count", options.count, "seeds of the range")->excludes(seed);
    app.add_option("--blocks", options.budget.blocks, "blocks of each scene, instead of --cpu");
    app.add_option("--cpu", options.budget.cpu_s, "seconds of CPU time a scene")
        ->check(CLI::Range(1e-4, 1e4));
    app.add_option("--compare-laws", options.compare,
                   "instead: the laws on the same strings, of so many seeds (table)");
    app.add_flag("--verbose", options.verbose, "describe each scene");
    CLI11_PARSE(app, argc, argv);
    if (options.compare > 0) {
        print_comparison(options.compare);
        return 0;
    }
    const PresetShelf shelf = factory_presets();
    if (shelf.presets.empty()) {
        std::fprintf(stderr, "jawari_stress: the built-in presets cannot be read\n");
        return 2;
    }
    std::size_t violations = 0;
    if (*seed) {
        violations = play(shelf, options.seed, options);
    } else {
        for (std::uint64_t n = 0; n < options.count; ++n)
            violations += play(shelf, options.first + n, options);
    }
    return violations == 0 ? 0 : 1;
}
