// Prints what a compiled scene and its state occupy on the heap, and the CPU time of compile(). Markdown, to
// standard output.
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "base/cpu_clock.h"
#include "formats/scene/read_scene.h"
#include "jawari/jawari.h"

namespace jawari::benchmarks {
namespace {

/// Bytes that are allocated now, small blocks and mapped ones.
std::size_t heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

void print_row(const char* name, const char* file, double contact_rate_hz) {
    auto scene = host::load_scene(file);
    if (!scene) throw std::runtime_error(scene.error().message);
    SceneDescription description = scene.value().description;
    description.output_rate_hz = 48000;
    description.contact_rate_hz = contact_rate_hz;
    description.law = ImpactLaw::Signorini;

    double compile_s = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
        const double start = host::thread_cpu_s();
        const auto model = compile(description);
        compile_s = std::min(compile_s, host::thread_cpu_s() - start);
        if (!model) throw std::runtime_error(model.failure().line());
    }
    const std::size_t before = heap_bytes();
    const auto model = compile(description);
    const std::size_t with_model = heap_bytes();
    const SceneState state = make_state(model.value(), Metering::Off);
    const std::size_t with_state = heap_bytes();
    std::size_t modes = 0, contacts = 0;
    for (const StringModel& string : model.value().strings) {
        modes += string.shape->mode_count;
        contacts += string.shape->contact_count;
    }
    const auto strings = static_cast<double>(model.value().strings.size());
    std::printf("| %s | %zu | %zu | %zu | %.3f | %.0f | %.0f | %.1f |\n", name, model.value().strings.size(),
                modes, contacts, contact_rate_hz / 1e6,
                static_cast<double>(with_model - before) / 1024 / strings,
                static_cast<double>(with_state - with_model) / 1024 / strings, 1e3 * compile_s);
}

}  // namespace
}  // namespace jawari::benchmarks

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: memory_and_compile GUITAR-SCENE\n", stderr);
        return 2;
    }
    try {
        std::puts(
            "| scene | strings | modes | contacts | contact rate (MHz) | model (KiB per string) | state (KiB "
            "per "
            "string) | compile (CPU ms) |\n|---|---|---|---|---|---|---|---|");
        using jawari::benchmarks::print_row;
        print_row("`lab/bass`", "lab/bass", 480000);
        print_row("`lab/bass`", "lab/bass", 2016000);
        print_row("`lab/bass`", "lab/bass", 8064000);
        print_row("`lab/one-contact`", "lab/one-contact", 2016000);
        print_row("`lab/fretless`", "lab/fretless", 480000);
        print_row("`lab/fretless`", "lab/fretless", 2016000);
        print_row("guitar, modes to 20 kHz", argv[1], 1008000);
        print_row("guitar, modes to 20 kHz", argv[1], 2016000);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "memory_and_compile: %s\n", error.what());
        return 1;
    }
    return 0;
}
