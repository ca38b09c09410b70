#include "jawari/scene/snapshot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "jawari/detail/step_coefficients.h"

namespace jawari {
namespace {

static_assert(std::endian::native == std::endian::little, "states are written as they are in memory");

constexpr char magic[] = "jawari.state/1";

class Writer {
  public:
    static constexpr bool writes = true;
    void bytes(const void* data, std::size_t count) {
        const auto* first = static_cast<const std::uint8_t*>(data);
        out.insert(out.end(), first, first + count);
    }
    std::vector<std::uint8_t> out;
};

class Reader {
  public:
    static constexpr bool writes = false;
    explicit Reader(std::span<const std::uint8_t> bytes) : left_(bytes) {}
    void bytes(void* data, std::size_t count) {
        failed = failed || count > left_.size();
        if (failed || count == 0) return;  // an empty array has no place
        std::memcpy(data, left_.data(), count);
        left_ = left_.subspan(count);
    }
    [[nodiscard]] std::size_t left() const { return left_.size(); }
    bool failed = false;

  private:
    std::span<const std::uint8_t> left_;
};

template <class Archive, class Value>
requires std::is_arithmetic_v<Value> || std::is_enum_v<Value>
void visit(Archive& archive, Value& value) {
    archive.bytes(&value, sizeof value);
}

/// Arrays keep the size that the model gives them.
template <class Archive, class Value, class Allocator>
void visit(Archive& archive, std::vector<Value, Allocator>& values) {
    std::uint64_t size = values.size();
    visit(archive, size);
    if constexpr (!Archive::writes) {
        archive.failed = archive.failed || size != values.size();
        if (archive.failed) return;
    }
    archive.bytes(values.data(), values.size() * sizeof(Value));
}

template <class Archive>
void visit(Archive& archive, IndexList& list) {
    std::uint64_t size = list.size();
    visit(archive, size);
    if constexpr (Archive::writes) {
        for (std::uint32_t index : list) visit(archive, index);
    } else {
        archive.failed = archive.failed || size > list.capacity();
        if (archive.failed) return;
        list.clear();
        for (std::uint64_t i = 0; i < size; ++i) {
            std::uint32_t index = 0;
            visit(archive, index);
            if (!archive.failed) list.push(index);
        }
    }
}

template <class Archive, class... Members>
void visit_all(Archive& archive, Members&... members) {
    (visit(archive, members), ...);
}

template <class Archive>
void visit(Archive& archive, EnergyMeter& e) {
    visit_all(archive, e.initial, e.highest, e.dissipated, e.contact_work, e.player_work, e.worst_imbalance,
              e.worst_rise);
}

template <class Archive>
void visit(Archive& archive, Counters& c) {
    visit_all(archive, c.steps, c.candidates, c.impulses, c.solves, c.truncated_solves, c.flown_frames,
              c.near_frames, c.asleep_frames, c.nonfinite_resets, c.worst_residual_m, c.worst_penetration_m);
}

template <class Archive>
void visit(Archive& archive, ContactState& c) {
    visit_all(archive, c.gap, c.gap_before, c.impulse, c.frame_impulse, c.left_open, c.height,
              c.height_before, c.height_rise_before, c.height_rate, c.height_target, c.moving_steps,
              c.moving_count, c.stepping_in_frame, c.near, c.is_near);
}

template <class Archive>
void visit(Archive& archive, LcpWorkspace& w) {
    visit_all(archive, w.active_count, w.factored, w.repeated, w.inverse, w.active, w.factor);
}

template <class Archive>
void visit(Archive& archive, ShortFrameState& s) {
    visit_all(archive, s.gaps_at, s.table.of, s.table.values, s.table.sign, s.table.scale, s.table.active,
              s.table.pivots, s.step_response, s.response_known);
}

template <class Archive>
void visit(Archive& archive, GapBounds& b) {
    visit_all(archive, b.speed, b.detour, b.extent, b.group_speed, b.group_detour, b.group_clearance,
              b.group_odometer, b.group_push, b.group_margin, b.open_until, b.margin, b.frame_gap,
              b.frame_end_gap);
    KickState& k = b.kicks;
    visit_all(archive, k.speed, k.overtones, k.detour, k.low_detour, k.frame_detour, k.frame_low_detour);
    UnitKick& u = b.unit_kick;
    visit_all(archive, u.modes, u.low_speed, u.low_detour, u.high_speed, u.high_extent, u.high_detour);
    visit_all(archive, b.strongest_speed, b.strongest_extent);
}

template <class Archive>
void visit(Archive& archive, CertificateState& c) {
    visit_all(archive, c.struck, c.backoff.granted, c.backoff.left, c.bounds);
    Validity& v = c.validity;
    visit_all(archive, v.outdated, v.excited, v.age, v.direct, v.odometers_at_frame, v.group_has_detour,
              v.group_has_clearance, v.group_has_forecast, v.frame_gap_at, v.certified_at);
    visit_all(archive, c.clear.valid, c.clear.limits_valid, c.clear.energy_J, c.clear.root, c.clear.force_N);
    ForecastState& f = c.forecast;
    visit_all(archive, f.group_detour, f.group_overtones, f.gap, f.gap_at, f.displacement, f.velocity);
}

/// All but scratch, metering and skipping.
template <class Archive>
void visit(Archive& archive, StringState& s) {
    ExcitationState& e = s.excitation;
    visit_all(archive, s.displacement, s.velocity, s.active_modes, s.frame, s.steps_left, s.asleep,
              s.leaves_obstacles);
    visit_all(archive, e.held, e.ramp, e.elapsed, e.modes, e.active, e.ramps, e.passive, e.strength_N,
              e.root);
    visit_all(archive, s.contact, s.lcp, s.short_frame, s.certificate, s.near_frame.crowded, s.energy,
              s.counters);
}

/// FNV-1a, a byte at a time.
std::uint64_t hashed(std::uint64_t hash, const void* data, std::size_t count) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < count; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3;
    return hash;
}

constexpr std::uint64_t empty_hash = 0xcbf29ce484222325;

/// Of what the same bits depend on.
std::uint64_t identity_of(const SceneModel& model) {
    std::uint64_t id = empty_hash;
    const auto add = [&](const void* data, std::size_t count) { id = hashed(id, data, count); };
    const auto add_all = [&](const auto& values) { add(values.data(), values.size() * sizeof(values[0])); };
    add(&model.output_rate_hz, sizeof model.output_rate_hz);
    add(&model.contact_rate_hz, sizeof model.contact_rate_hz);
    for (const StringModel& string : model.strings) {
        const StringShape& shape = *string.shape;
        const std::uint64_t sizes[] = {shape.mode_count, shape.contact_count, shape.steps_per_frame,
                                       static_cast<std::uint64_t>(shape.law),
                                       static_cast<std::uint64_t>(shape.scheme)};
        add(sizes, sizeof sizes);
        add_all(shape.carry);
        add_all(shape.change);
        add_all(shape.mobility);
        add_all(string.tuning.restoring);
        add_all(shape.contact_rows);
        add_all(shape.contact_restitution);
        for (Compliance law : shape.contact_compliance) {
            const double values[] = {law.stiffness, law.exponent, law.loss_s_per_m, law.resistance_kg_per_s};
            add(values, sizeof values);
        }
    }
    return id;
}

/// v = backward_q q + backward_u u for the true velocity u.
struct Backward {
    double q = 0;
    double u = 1;
};

Backward backward_of(const StringModel& model, std::size_t k) {
    const StringShape& shape = *model.shape;
    if (shape.scheme == Scheme::Theta) return {};
    const auto part = [&](double q, double u) {
        return exact_backward_velocity(model.tuning.omega[k], shape.sigma[k], shape.step_s, q, u);
    };
    const Backward backward{part(1, 0), part(0, 1)};
    // A mode that decays within a step has no past that could be known.
    return backward.u != 0 && std::isfinite(backward.q) && std::isfinite(backward.u) ? backward : Backward{};
}

/// What every model of the same scene can go on from.
struct PortableString {
    std::vector<double> displacement, velocity;  ///< q and the true velocity; per mode
    std::vector<double> height_m;                ///< b per described contact; of dropped ones 0
    EnergyMeter energy;
    Counters counters;
};

template <class Archive>
void visit(Archive& archive, PortableString& s) {
    visit_all(archive, s.displacement, s.velocity, s.height_m, s.energy, s.counters);
}

PortableString room_of(const StringModel& model) {
    PortableString string;
    string.displacement.resize(model.shape->mode_count);
    string.velocity.resize(model.shape->mode_count);
    string.height_m.resize(model.shape->contact_of_description.size());
    return string;
}

PortableString portable(const StringModel& model, const StringState& state) {
    PortableString string = room_of(model);
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const Backward backward = backward_of(model, k);
        string.displacement[k] = state.displacement[k];
        string.velocity[k] = (state.velocity[k] - backward.q * state.displacement[k]) / backward.u;
    }
    for (std::size_t c = 0; c < string.height_m.size(); ++c) {
        const std::ptrdiff_t kept = model.shape->contact_of_description[c];
        if (kept >= 0) string.height_m[c] = state.contact.height[static_cast<std::size_t>(kept)];
    }
    string.energy = state.energy;
    string.counters = state.counters;
    return string;
}

void adopt(const StringModel& model, const PortableString& string, std::uint64_t frame, StringState& state) {
    reset(model, state);
    for (std::size_t k = 0; k < model.shape->mode_count; ++k) {
        const Backward backward = backward_of(model, k);
        state.displacement[k] = string.displacement[k];
        state.velocity[k] = backward.q * string.displacement[k] + backward.u * string.velocity[k];
    }
    for (std::size_t c = 0; c < string.height_m.size(); ++c) {
        const std::ptrdiff_t kept = model.shape->contact_of_description[c];
        if (kept < 0) continue;
        state.contact.height[static_cast<std::size_t>(kept)] = string.height_m[c];
        state.contact.height_before[static_cast<std::size_t>(kept)] = string.height_m[c];
    }
    state.frame = frame;
    notice_change(model, state);
    state.energy = string.energy;
    state.counters = string.counters;
}

/// The parts before the states: what they are of, and when.
struct Header {
    std::uint64_t identity = 0;
    std::uint64_t strings = 0;
    double time_s = 0;
    std::uint64_t exact_bytes = 0;  ///< of the states themselves
};

template <class Archive>
void visit(Archive& archive, Header& header) {
    visit_all(archive, header.identity, header.strings, header.time_s, header.exact_bytes);
}

bool all_below(const auto& indices, std::size_t end) {
    for (const std::uint32_t index : indices) {
        if (index >= end) return false;
    }
    return true;
}

/// Whether everything that is used as an index or a size is one.
bool is_sound(const StringModel& model, const StringState& state) {
    const std::size_t contacts = model.shape->contact_count;
    const std::size_t stride = model.shape->stride;
    const std::size_t factored = state.lcp.active_count;
    return state.active_modes <= stride && state.excitation.modes <= stride && factored <= state.lcp.room &&
           factored <= state.lcp.active.size() &&
           all_below(std::span(state.lcp.active).first(factored), std::max<std::size_t>(contacts, 1)) &&
           all_below(state.contact.near, contacts) && all_below(state.short_frame.table.active, contacts);
}

Failure refusal(const std::string& value, const std::string& allowed) {
    return Failure{"state", value, allowed};
}

}  // namespace

std::vector<std::uint8_t> save(const SceneModel& model, const SceneState& state) {
    Writer exact;
    Writer converted;
    for (std::size_t s = 0; s < model.strings.size(); ++s) {
        StringState copy = state.strings[s];  // visit() takes what a reader would fill
        visit(exact, copy);
        PortableString string = portable(model.strings[s], state.strings[s]);
        visit(converted, string);
    }
    Header header{identity_of(model), model.strings.size(),
                  static_cast<double>(state.frame) / model.output_rate_hz, exact.out.size()};
    Writer file;
    file.bytes(magic, sizeof magic);
    visit(file, header);
    file.bytes(converted.out.data(), converted.out.size());
    file.bytes(exact.out.data(), exact.out.size());
    const std::uint64_t check = hashed(empty_hash, file.out.data(), file.out.size());
    file.bytes(&check, sizeof check);
    return file.out;
}

Result<Restored> restore(const SceneModel& model, std::span<const std::uint8_t> bytes, SceneState& state) {
    std::uint64_t check = 0;
    if (bytes.size() < sizeof magic + sizeof check)
        return refusal("other bytes", std::string("a state of the format ") + magic);
    std::memcpy(&check, bytes.data() + bytes.size() - sizeof check, sizeof check);
    bytes = bytes.first(bytes.size() - sizeof check);
    Reader reader(bytes);
    char found[sizeof magic]{};
    reader.bytes(found, sizeof found);
    if (reader.failed || std::memcmp(found, magic, sizeof magic) != 0)
        return refusal("other bytes", std::string("a state of the format ") + magic);
    if (check != hashed(empty_hash, bytes.data(), bytes.size()))
        return refusal("damaged", "a state as it was saved");
    Header header;
    visit(reader, header);
    if (reader.failed || header.strings != model.strings.size() || !(header.time_s >= 0) ||
        !std::isfinite(header.time_s))
        return refusal(std::to_string(header.strings) + " strings", "a state of this scene");
    std::vector<PortableString> strings;
    for (const StringModel& string : model.strings) {
        strings.push_back(room_of(string));
        visit(reader, strings.back());
    }
    if (reader.failed || reader.left() != header.exact_bytes)
        return refusal("other modes or contacts, or not whole", "a state of this scene");
    if (header.identity != identity_of(model)) {
        const auto frame = static_cast<std::uint64_t>(std::llround(header.time_s * model.output_rate_hz));
        for (std::size_t s = 0; s < strings.size(); ++s)
            adopt(model.strings[s], strings[s], frame, state.strings[s]);
        state.frame = frame;
        return Restored::Converted;
    }
    SceneState whole = state;
    bool sound = true;
    for (std::size_t s = 0; s < whole.strings.size(); ++s) {
        visit(reader, whole.strings[s]);
        sound = sound && !reader.failed && is_sound(model.strings[s], whole.strings[s]);
    }
    if (!sound) return refusal("not whole", "a state of this scene");
    state = std::move(whole);
    state.frame = static_cast<std::uint64_t>(std::llround(header.time_s * model.output_rate_hz));
    return Restored::Exactly;
}

}  // namespace jawari
