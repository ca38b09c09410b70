// Prints how far the engine is from the cases of tests/engine/literature, as Markdown, to standard output:
// `literature_accuracy cases`, the errors at four resolutions, worst first; `points`, distributed obstacles
// as points and rate rise together; `front`, the energy that a front of contact takes.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "literature/bridge_at_rest.h"
#include "literature/cases.h"

namespace {

using namespace jawari;
using namespace jawari::literature;

constexpr std::size_t fine_lattice = 5120;

struct Row {
    std::string text;  ///< case, reference, law, what is refined
    std::vector<double> resolutions;
    std::function<double(double resolution)> error;
    std::vector<double> errors = {};
};

std::size_t whole(double resolution) {
    return static_cast<std::size_t>(resolution);
}

UnitString with(UnitString u, ImpactLaw law, double restitution, double steps_per_interval) {
    u.law = law;
    u.restitution = restitution;
    u.steps_per_interval = steps_per_interval;
    return u;
}

const std::vector<double> intervals{40, 80, 160, 320};

void add_points(std::vector<Row>& rows) {
    for (const double depth : {0.3, 0.5, 1 / std::sqrt(3.0)}) {
        std::array<char, 128> text{};
        std::snprintf(text.data(), text.size(),
                      "Cabannes, point at -%.4g | events in closed form | `signorini`", depth);
        rows.push_back({std::string(text.data()) + " | intervals", intervals,
                        [depth](double n) { return cabannes_error(depth, cabannes(depth, whole(n))); }});
    }
    rows.push_back({"rattling between two points | lattice | `signorini` | intervals", intervals,
                    [](double n) { return lattice_error(rattling(whole(n)), 121, fine_lattice); }});
}

void add_lines(std::vector<Row>& rows) {
    rows.push_back({"sitar's bridge | lattice | `signorini` | intervals", intervals,
                    [](double n) { return lattice_error(sitar(whole(n)), 121, fine_lattice); }});
    rows.push_back({"arch, e = 0 | lattice | `signorini` | intervals", intervals,
                    [](double n) { return lattice_error(arch(whole(n)), 41, fine_lattice); }});
    for (const double e : {0.5, 0.9, 1.0}) {
        std::array<char, 96> text{};
        std::snprintf(text.data(), text.size(), "arch, e = %.1f | lattice | `paoli-schatzman` | intervals",
                      e);
        rows.push_back({text.data(), intervals, [e](double n) {
                            return lattice_error(with(arch(whole(n)), ImpactLaw::PaoliSchatzman, e, 1.5), 41,
                                                 20 * fine_lattice / 8);
                        }});
    }
    rows.push_back({"landing on a plane, e = 0 | lattice | `signorini` | intervals", intervals,
                    [](double n) { return lattice_error(landing(0.5, whole(n)), 81, whole(n)); }});
    rows.push_back(
        {"landing, energy kept, e = 0 | closed form 0.5 | `newton` | intervals", intervals, [](double n) {
             return landing_energy_error(0.5, with(landing(0.5, whole(n)), ImpactLaw::Newton, 0, 32));
         }});
    rows.push_back(
        {"landing on a plane, e = 1 | closed form | `newton` | intervals", intervals, [](double n) {
             return landing_elastic_error(0.5, with(landing(0.5, whole(n)), ImpactLaw::Newton, 1, 32));
         }});
    rows.push_back(
        {"at rest on a bridge, movement | 0 | `signorini` | intervals", {100, 200, 400, 800}, [](double n) {
             return furthest_from_rest(run(bridge_at_rest(whole(n) - 1), 21)) / 0.01;
         }});
}

void add_modes(std::vector<Row>& rows) {
    const std::vector<double> rates{1e4, 1e5, 1e6, 1e7};
    for (const ImpactLaw law : {ImpactLaw::Newton, ImpactLaw::PaoliSchatzman}) {
        for (const double e : {0.0, 0.5, 0.9, 1.0}) {
            std::array<char, 128> text{};
            std::snprintf(text.data(), text.size(),
                          "oscillator on a stop, e = %.1f | closed form | `%s` | rate (Hz)", e, name_of(law));
            rows.push_back({text.data(), {1e3, 1e4, 1e5, 1e6}, [law, e](double r) {
                                return oscillator_error(law, e, r, 20);
                            }});
        }
    }
    for (const double e : {0.5, 0.8, 1.0}) {
        std::array<char, 96> text{};
        std::snprintf(text.data(), text.size(),
                      "bar of 5 modes bounces, e = %.1f | events | `newton` | rate (Hz)", e);
        rows.push_back(
            {text.data(), rates, [e](double r) { return bouncing_bar_error(ImpactLaw::Newton, e, r); }});
    }
    rows.push_back({"bar on a stop | clamped halves | `signorini` | modes, 200 steps each",
                    {10, 20, 40, 80},
                    [](double n) { return clamped_halves_error(ImpactLaw::Signorini, whole(n), 200 * n); }});
}

void print_cases() {
    std::vector<Row> rows;
    add_points(rows);
    add_lines(rows);
    add_modes(rows);
    for (Row& row : rows) {
        for (const double resolution : row.resolutions) row.errors.push_back(row.error(resolution));
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.errors.back() > b.errors.back(); });
    std::puts("| case | reference | law | resolution | from | to | error at each | | | | order |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
    for (const Row& row : rows) {
        std::printf("| %s | %g | %g |", row.text.c_str(), row.resolutions.front(), row.resolutions.back());
        for (const double error : row.errors) std::printf(" %.1e |", error);
        const double order = std::log(row.errors.front() / row.errors.back()) /
                             std::log(row.resolutions.back() / row.resolutions.front());
        std::printf(" %.1f |\n", order);
    }
}

const std::vector<double> steps_per_interval{0.5, 1, 1.5, 2, 4, 16, 64};

struct Choice {
    ImpactLaw law;
    double restitution;
    std::size_t modes_per_point;
};

void print_choice(const Choice& choice, const std::vector<Samples>& reference) {
    for (const std::size_t n : {100U, 200U, 400U}) {
        std::printf("| `%s` | %g | %zu | %zu |", name_of(choice.law), choice.restitution,
                    choice.modes_per_point, n);
        for (const double m : steps_per_interval) {
            SceneDescription scene = scene_of(with(arch(n), choice.law, choice.restitution, m));
            std::get<PhysicalModes>(scene.strings[0].modes).count = n * choice.modes_per_point - 1;
            scene.strings[0].initial.shape = Pluck{0.3, 0.5};
            std::printf(" %.2f %% |", 100 * error_of(run(scene, 41).probes, reference));
        }
        std::puts("");
    }
}

/// Finite differences: an explicit scheme has no time steps longer than a wave's way from node to node.
void print_differences(double restitution, const std::vector<Samples>& reference) {
    for (const std::size_t n : {100U, 200U, 400U}) {
        UnitString u = arch(n);
        u.restitution = restitution;
        std::printf("| finite differences | %g | | %zu |", restitution, n);
        for (const double m : steps_per_interval) {
            if (m < 1 || m != std::floor(m)) {
                std::printf(" |");
            } else {
                std::printf(" %.2f %% |", 100 * error_of(difference_samples(u, 41, whole(m)), reference));
            }
        }
        std::puts("");
    }
}

void print_points() {
    std::printf("| law | e | modes a point | intervals |");
    for (const double m : steps_per_interval) std::printf(" %g |", m);
    std::puts("\n|---|---|---|---|---|---|---|---|---|---|---|");
    const std::vector<Choice> choices{{ImpactLaw::Signorini, 0, 1},      {ImpactLaw::Signorini, 0, 4},
                                      {ImpactLaw::Newton, 0, 1},         {ImpactLaw::PaoliSchatzman, 0.5, 1},
                                      {ImpactLaw::PaoliSchatzman, 1, 1}, {ImpactLaw::Newton, 1, 1}};
    for (const double restitution : {0.0, 0.5, 1.0}) {
        UnitString finest = arch(12800);
        finest.restitution = restitution;
        const std::vector<Samples> reference = lattice_samples(finest, 41);
        for (const Choice& choice : choices) {
            if (choice.restitution == restitution) print_choice(choice, reference);
        }
        if (restitution == 0) print_differences(restitution, reference);
    }
}

void print_front() {
    const std::vector<double> speeds{1.05, 1.25, 1.5, 2, 3};
    std::printf("| steps an interval | intervals |");
    for (const double s : speeds) std::printf(" %g c |", s);
    std::puts("\n|---|---|---|---|---|---|---|");
    std::printf("| closed form | |");
    for (const double s : speeds) std::printf(" %.3f |", 1 - 1 / (s * s));
    std::puts("");
    for (const double m : {1, 2, 4, 16, 64}) {
        for (const std::size_t n : {200U, 800U}) {
            std::printf("| %g | %zu |", m, n);
            for (const double s : speeds) std::printf(" %.3f |", front_loss(s, n, m));
            std::puts("");
        }
    }
}

}  // namespace

int main(int count, char** arguments) {
    const char* table = count == 2 ? arguments[1] : "";
    if (std::strcmp(table, "cases") == 0) {
        print_cases();
    } else if (std::strcmp(table, "points") == 0) {
        print_points();
    } else if (std::strcmp(table, "front") == 0) {
        print_front();
    } else {
        std::fprintf(stderr, "usage: literature_accuracy cases|points|front\n");
        return 2;
    }
    return 0;
}
