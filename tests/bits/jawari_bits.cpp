// Prints a hash of what the program computes, with one instruction set: one demo piece, rendered to
// floating point, or one scene, simulated under one impact law. check_bits.py compares the hashes with a
// table.
#include <hwy/targets.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "commands/render/render.h"
#include "commands/simulate/simulate.h"
#include "support/read_wav.h"
#include "support/temporary_folder.h"

namespace jawari {
namespace {

/// 64-bit FNV-1a (Fowler, Noll, Vo; RFC 9923).
std::uint64_t fnv1a(const std::string& bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return hash;
}

/// The samples' bytes. Empty after a failure, whose line is on standard error.
std::string piece(const std::string& file, const std::string& preset) {
    const test::TemporaryFolder folder;
    host::RenderOptions options;
    options.midi = {file};
    options.preset = preset;
    options.out = folder.file("piece.wav");
    options.format = host::SampleFormat::Float;
    options.tail_s = 1;
    if (host::render(options)) return {};
    return test::read_wav(options.out).data;
}

/// The probes' rows as text, 17 digits each.
std::string scene(const std::string& name, ImpactLaw law) {
    const test::TemporaryFolder folder;
    host::SimulateOptions options;
    options.scene = name;
    options.overrides.law = law;
    options.overrides.duration_s = 0.05;
    options.out = folder.file("scene.csv");
    if (host::simulate(options)) return {};
    return test::read_text(options.out);
}

int run(const std::string& kind, const std::string& what, const std::string& how, const std::string& set) {
    constexpr ImpactLaw laws[] = {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                  ImpactLaw::PaoliSchatzman};
    std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    while (targets != 0 && set != hwy::TargetName(targets & -targets)) targets &= targets - 1;
    if (targets == 0) {
        std::fprintf(stderr, "jawari_bits: this processor has no instruction set %s\n", set.c_str());
        return 2;
    }
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(targets);
    const std::string bytes = kind == "piece" ? piece(what, how) : scene(what, laws[std::stoul(how)]);
    if (bytes.empty()) return 1;
    std::printf("hash %016llx\n", static_cast<unsigned long long>(fnv1a(bytes)));
    return 0;
}

/// The best first.
int list_sets() {
    for (std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS; targets != 0; targets &= targets - 1)
        std::printf("%s\n", hwy::TargetName(targets & -targets));
    return 0;
}

}  // namespace
}  // namespace jawari

int main(int count, char** arguments) {
    if (count == 2 && std::string(arguments[1]) == "sets") return jawari::list_sets();
    if (count != 5) {
        std::fprintf(stderr,
                     "usage: jawari_bits sets | jawari_bits piece FILE.mid PRESET SET | "
                     "jawari_bits scene NAME LAW SET (LAW: 0 to 3)\n");
        return 2;
    }
    return jawari::run(arguments[1], arguments[2], arguments[3], arguments[4]);
}
