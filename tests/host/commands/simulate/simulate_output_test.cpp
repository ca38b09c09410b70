// What `jawari simulate` writes: against closed forms, against other readers, and the formats against each
// other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.h"
#include "support/run_program.h"
#include "support/scene_text.h"
#include "support/temporary_folder.h"

namespace jawari::test {
namespace {

struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;

    [[nodiscard]] double value(std::size_t row, std::size_t column) const {
        return std::strtod(rows.at(row).at(column).c_str(), nullptr);
    }
};

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
}

Table read_table(const std::string& text) {
    Table table;
    std::stringstream stream(text);
    std::string line;
    std::getline(stream, line);
    table.header = split(line);
    while (std::getline(stream, line)) table.rows.push_back(split(line));
    return table;
}

void must_simulate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "simulate");
    const Ran ran = jawari(arguments);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
}

/// Two modes of known frequency and loss, without obstacles.
const char* const free_scene = R"({"schema": "jawari.scene/1", "duration_s": 0.05, "output_rate_hz": 8000,
 "contact_rate_hz": 32000, "strings": [{"length_m": 0.5, "linear_density_kg_per_m": 0.003,
 "modes": {"frequency_hz": [110, 223], "decay_per_s": [3, 12]},
 "initial": {"modal_displacement": [0.001, -0.0004], "modal_velocity": [0.2, 0.5]},
 "probes": [{"quantity": "displacement", "position_m": 0.2}]}]})";

/// u(x, t) of free_scene from the solution of the damped oscillator.
double exact_displacement(double x, double t) {
    const double frequency[] = {110, 223}, decay[] = {3, 12}, q0[] = {0.001, -0.0004}, v0[] = {0.2, 0.5};
    double u = 0;
    for (int k = 0; k < 2; ++k) {
        const double omega = 2 * std::numbers::pi * frequency[k];
        const double damped = std::sqrt(omega * omega - decay[k] * decay[k]);
        const double q =
            std::exp(-decay[k] * t) *
            (q0[k] * std::cos(damped * t) + (v0[k] + decay[k] * q0[k]) / damped * std::sin(damped * t));
        u += std::sqrt(2 / 0.5) * std::sin((k + 1) * std::numbers::pi * x / 0.5) * q;
    }
    return u;
}

TEST(SimulateOutput, RowsAreTheExactMotionAtTheirTimes) {
    const TemporaryFolder folder;
    must_simulate({folder.write("free.json", free_scene), "--out", folder.file("a.csv")});
    const Table table = read_table(read_text(folder.file("a.csv")));
    EXPECT_EQ(table.header, (std::vector<std::string>{"time_s", "displacement_m@0.2"}));
    ASSERT_EQ(table.rows.size(), 401U);  // n = 0 to round(0.05 x 8000)
    for (std::size_t n = 0; n < table.rows.size(); ++n) {
        const double t = static_cast<double>(n) / 8000;
        EXPECT_EQ(table.value(n, 0), t);
        EXPECT_NEAR(table.value(n, 1), exact_displacement(0.2, t), 1e-14) << n;
    }
}

TEST(SimulateOutput, CsvDigitsReadBackAsTheSameNumbers) {
    const TemporaryFolder folder;
    must_simulate({"lab/bass", "--duration", "0.01", "--out", folder.file("a.csv")});
    const Table table = read_table(read_text(folder.file("a.csv")));
    ASSERT_EQ(table.rows.size(), 158U);
    for (const auto& row : table.rows)
        for (const auto& field : row)
            EXPECT_EQ(host::seventeen_digits(std::strtod(field.c_str(), nullptr)), field);
    EXPECT_EQ(jawari({"simulate", "lab/bass", "--duration", "0.01", "--out", "-"}).out,
              read_text(folder.file("a.csv")));
}

TEST(SimulateOutput, TheLastRowIsTheRoundedDuration) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("free.json", free_scene);
    for (const auto& [duration, rows] :
         {std::pair{"0", 1U}, {"0.0000624", 1U}, {"0.0000626", 2U}, {"0.001", 9U}}) {
        must_simulate({scene, "--duration", duration, "--out", folder.file("a.csv")});
        EXPECT_EQ(read_table(read_text(folder.file("a.csv"))).rows.size(), rows) << duration;
    }
}

/// A string with a comma and a quote in its name, and a second one.
std::string two_strings() {
    std::string text = replaced(valid_scene, "\"name\": \"test\"", R"("name": "a,\"b")");
    const auto first = text.find("  {\n");
    const std::string string = text.substr(first, text.rfind("\n ]") - first);
    return text.insert(first + string.size(), ",\n" + replaced(string, R"("a,\"b")", "\"second\""));
}

const char* const compare_formats = R"(
import csv, json, struct, sys
import h5py
import numpy as np
folder = sys.argv[1]
with open(folder + "/a.csv", newline="") as file:
    rows = list(csv.reader(file))
table = np.array(rows[1:], dtype=float)
with h5py.File(folder + "/a.h5") as h5:
    assert np.array_equal(h5["time_s"][:], table[:, 0])
    own = h5["probes"][:]
    assert own.shape == (81, 8)
    assert np.array_equal(own, table[:, 1:])
    assert [name.decode() for name in h5["probe_name"][:]] == rows[0][1:], rows[0]
    units = [unit.decode() for unit in h5["probe_unit"][:]]
    assert units == ["m", "m/s", "N", "J"] * 2, units
    assert h5.attrs["scheme"] == "exact" and h5.attrs["law"] == "newton"
    assert h5.attrs["output_rate_hz"] == 8000 and h5.attrs["contact_rate_hz"] == 80000
    assert h5.attrs["duration_s"] == 0.01
    assert h5.attrs["scene_json"] == open(folder + "/scene.json").read()
    stats = json.load(open(folder + "/a.json"))
    assert len(h5["strings"]) == 2 == len(stats["strings"])
    for s in range(2):
        string = h5["strings"][str(s)]
        assert string.attrs["name"] == stats["strings"][s]["name"] == ['a,"b', "second"][s]
        assert string.attrs["start"] == "exact" and string.attrs["length_m"] == 0.8
        probes = own[:, 4 * s:4 * s + 4]
        impulse, gap = string["impulse_Ns"][:], string["gap_m"][:]
        assert impulse.shape == gap.shape == (81, 2)
        assert np.allclose(impulse[:, 0] * 8000, probes[:, 2], rtol=1e-14)
        assert (impulse[:, 0] > 0).sum() > 5
        energy = string["energy_J"][:]
        assert np.allclose(energy, probes[:, 3], rtol=1e-14)
        assert not any(key in string for key in ("dissipated_J", "contact_work_J", "player_work_J"))
        # The shape from the final modal state is the last row's probe and gap.
        k = np.arange(1, 21)
        phi = lambda x: np.sqrt(2 / 0.8) * np.sin(k * np.pi * x / 0.8)
        q, v = string["final_modal_displacement"][:], string["final_modal_velocity"][:]
        assert abs(phi(0.1) @ q - probes[-1, 0]) < 1e-16 and abs(phi(0.1) @ v - probes[-1, 1]) < 1e-13
        assert abs(phi(0.2) @ q + 0.0005 - gap[-1, 0]) < 1e-16
        assert abs(0.004 - phi(0.5) @ q - gap[-1, 1]) < 1e-16
        assert list(string["contact_side"][:]) == [b"below", b"above"]
        assert list(string["contact_restitution"][:]) == [0.5, 0]
        assert np.allclose(string["frequency_hz"][0], np.sqrt(100 / 0.005) / 1.6 * np.sqrt(1 + 1e-5), rtol=1e-14)
        for key in ("steps", "impulses", "candidates", "solves"):
            assert string.attrs[key] == stats["strings"][s][key], key
        assert string.attrs["steps"] == 800
    # What CSV skips, HDF5 skips.
    skipped = json.load(open(folder + "/csv.json"))
    for key in ("flown_frames", "near_frames", "asleep_frames", "candidates", "impulses", "solves"):
        assert stats[key] == skipped[key], key
    assert stats["flown_frames"] > 0 and stats["settings"]["metering"] == "frame"
with h5py.File(folder + "/metered.h5") as h5:
    # Metering each step forgoes skipping ahead, which gives the same numbers to rounding only.
    scale = np.abs(table[:, 1:]).max(axis=0)
    own = h5["probes"][:]
    assert (np.abs(own - table[:, 1:]) / scale).max() < 1e-9, (np.abs(own - table[:, 1:]) / scale).max()
    for s in range(2):
        string = h5["strings"][str(s)]
        energy = string["energy_J"][:]
        balance = energy - energy[0] + string["dissipated_J"][:] - string["contact_work_J"][:] - string["player_work_J"][:]
        assert np.abs(balance).max() < 1e-13 * energy[0], np.abs(balance).max() / energy[0]
        assert string["dissipated_J"][-1] > 0 > string["contact_work_J"][-1]
wav = open(folder + "/a.wav", "rb").read()
assert wav[:4] == b"RIFF" and wav[8:12] == b"WAVE"
chunks, at = {}, 12
while at < len(wav):
    size = struct.unpack_from("<I", wav, at + 4)[0]
    chunks[wav[at:at + 4]] = wav[at + 8:at + 8 + size]
    at += 8 + size + size % 2
form, channels, rate, _, _, bits = struct.unpack_from("<HHIIHH", chunks[b"fmt "])
assert (channels, rate, bits) == (8, 8000, 64) and form in (3, 0xFFFE), (form, channels, rate, bits)
assert np.array_equal(np.frombuffer(chunks[b"data"]).reshape(-1, channels), table[:, 1:])
print("same")
)";

TEST(SimulateOutput, CsvHdf5AndWavHoldTheSameNumbers) {
    if (python("import h5py", {}).exit_code != 0) GTEST_SKIP() << "python3-h5py is not installed";
    const TemporaryFolder folder;
    const std::string scene = folder.write("scene.json", two_strings());
    must_simulate({scene, "--out", folder.file("a.csv"), "--stats", folder.file("csv.json")});
    must_simulate({scene, "--out", folder.file("a.h5"), "--stats", folder.file("a.json")});
    must_simulate({scene, "--out", folder.file("metered.h5"), "--meter-steps"});
    must_simulate({scene, "--out", folder.file("a.wav")});
    const Ran compared = python(compare_formats, {folder.file(".")});
    EXPECT_EQ(compared.out, "same\n") << compared.err;
}

/// HDF5 lays out variable-length names by their addresses in memory, so its files are compared by what is in
/// them.
const char* const compare_recordings = R"(
import sys
import h5py
import numpy as np
a, b = (h5py.File(sys.argv[1] + name) for name in ("/a.h5", "/b.h5"))
names = []
a.visit(names.append)
assert names, "empty"
other = []
b.visit(other.append)
assert names == other, (names, other)
def value(file, name, key):
    # References are equal if they lead to places of one name.
    content = file[name].attrs[key]
    if key == "REFERENCE_LIST":
        return [(file[place].name, int(dimension)) for place, dimension in content]
    if key == "DIMENSION_LIST":
        return [[file[scale].name for scale in scales] for scales in content]
    return content
for name in names:
    if isinstance(a[name], h5py.Dataset):
        assert np.array_equal(a[name][()], b[name][()]), name
    assert set(a[name].attrs) == set(b[name].attrs), name
    for key in a[name].attrs:
        one, two = value(a, name, key), value(b, name, key)
        assert one == two if isinstance(one, list) else np.array_equal(one, two), (name, key)
)";

TEST(SimulateOutput, RunsAreReproducible) {
    const TemporaryFolder folder;
    for (const char* name : {"a.csv", "b.csv", "a.h5", "b.h5", "a.wav", "b.wav"})
        must_simulate({"lab/one-contact", "--duration", "0.005", "--out", folder.file(name)});
    for (const char* extension : {".csv", ".wav"})
        EXPECT_EQ(read_text(folder.file(std::string("a") + extension)),
                  read_text(folder.file(std::string("b") + extension)))
            << extension;
    const Ran compared = python(compare_recordings, {folder.file(".")});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
}

/// Goes on from the final modal state of the first half; prints the largest difference to the whole run.
const char* const continue_run = R"(
import json, subprocess, sys
import h5py
import numpy as np
program, folder = sys.argv[1:]
def simulate(scene, name):
    json.dump(scene, open(folder + "/" + name + ".json", "w"))
    subprocess.run([program, "simulate", folder + "/" + name + ".json", "--out", folder + "/" + name + ".h5"], check=True)
    return h5py.File(folder + "/" + name + ".h5")
scene = json.load(open(folder + "/free.json"))
whole = simulate(scene, "whole")
half = dict(scene, duration_s=scene["duration_s"] / 2)
first = simulate(half, "first")
string = first["strings/0"]
half["strings"][0]["initial"] = {"modal_displacement": list(string["final_modal_displacement"]),
                                 "modal_velocity": list(string["final_modal_velocity"]), "start": "backward"}
second = simulate(half, "second")
joined = np.concatenate([first["probes"][:-1], second["probes"][:]])
print(np.abs(joined - whole["probes"][:]).max())
)";

TEST(SimulateOutput, TheFinalModalStateContinuesTheRun) {
    const TemporaryFolder folder;
    folder.write("free.json", free_scene);
    const Ran ran = python(continue_run, {JAWARI_PROGRAM, folder.file(".")});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_LT(std::stod(ran.out), 1e-16) << ran.out;
}

const char* const check_stats = R"(
import json, sys
stats = json.load(sys.stdin if len(sys.argv) < 2 else open(sys.argv[1]))
assert stats["schema"] == "jawari.stats/1"
assert stats["settings"] == {"output_rate_hz": 8000, "contact_rate_hz": 80000, "duration_s": 0.01, "scheme": "exact",
                             "law": "signorini", "metering": "frame"}
assert stats["rows"] == 81 and stats["sound_s"] == 0.01 and stats["steps"] == 2 * 800
assert stats["modes"] == 40 and stats["contacts"] == 4
for key in ("candidates", "impulses", "solves", "truncated_solves", "nonfinite_resets"):
    assert stats[key] == sum(s[key] for s in stats["strings"]), key
assert stats["impulses"] > 0 and stats["worst_penetration_m"] < 1e-12
assert abs(stats["real_time_factor"] - 0.01 / stats["cpu_render_s"]) < 1e-9 * stats["real_time_factor"]
assert stats["energy_max_over_initial"] <= 1 + 1e-12
assert stats["cpu_compile_s"] > 0 and stats["cpu_output_s"] >= 0
# A triangle of height h at x has the energy T h^2/2 (1/x + 1/(L - x)); 20 modes hold most of it.
triangle = 100 * 0.002**2 / 2 * (1 / 0.3 + 1 / 0.5)
for s in stats["strings"]:
    assert 0.85 * triangle < s["initial_energy_J"] < 1.001 * triangle, s["initial_energy_J"] / triangle
    assert 0 < s["final_energy_J"] < s["initial_energy_J"]
print("right")
)";

TEST(SimulateOutput, StatsHaveTheirKeys) {
    const TemporaryFolder folder;
    must_simulate({folder.write("scene.json", two_strings()), "--law", "signorini", "--restitution", "0",
                   "--stats", folder.file("a.json")});
    const Ran checked = python(check_stats, {folder.file("a.json")});
    EXPECT_EQ(checked.out, "right\n") << checked.err;
    const Ran printed = jawari({"simulate", folder.file("scene.json"), "--stats", "-"});
    EXPECT_TRUE(printed.out.starts_with("{\n  \"schema\": \"jawari.stats/1\"")) << printed.out;
}

TEST(SimulateOutput, AStringAtRestHasNoEnergyRatio) {
    const TemporaryFolder folder;
    const std::string still =
        replaced(free_scene, R"("modal_displacement": [0.001, -0.0004], "modal_velocity": [0.2, 0.5])", "");
    const Ran ran = jawari({"simulate", folder.write("still.json", still), "--stats", "-"});
    EXPECT_NE(ran.out.find("\"energy_max_over_initial\": null"), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace jawari::test
