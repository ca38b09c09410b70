#include "hostile_scene.h"

#include <algorithm>
#include <cmath>

#include "dice.h"
#include "hostile_string.h"
#include "string/contact/impact_law.h"

namespace jawari::stress {
namespace {

constexpr double highest_rate_hz = 64e6;
/// Multiply-adds of the dearest frame, and of the Delassus operator.
constexpr double work_of_frame = 1.5e7;
constexpr double work_of_compile = 3e7;
constexpr double work_of_neck = 3e6;

double choose_output_rate(Dice& dice) {
    if (dice.chance(0.5)) return dice.pick({8000, 22050, 44100, 48000, 96000, 192000, 384000, 768000});
    return std::round(dice.spread(8000, 768000));
}

SizeLimits choose_sizes(const StringPlan& plan, Dice& dice) {
    SizeLimits sizes;
    if (plan.neck) {
        sizes.contacts = dice.spread_whole(1, 4096);
    } else if (!dice.chance(0.1)) {
        sizes.contacts = dice.chance(0.02) ? dice.spread_whole(300, 4096) : dice.spread_whole(1, 100);
    }
    const double contacts = std::max(1.0, static_cast<double>(sizes.contacts));
    const double cap = plan.neck ? work_of_neck / contacts : work_of_compile / (contacts * contacts);
    sizes.modes = dice.spread_whole(1, static_cast<std::size_t>(std::clamp(cap, 1.0, 2000.0)));
    return sizes;
}

/// Steps per frame: up to 64 MHz, as far as the work allows.
double choose_contact_rate(double output_rate_hz, const SizeLimits& sizes, Dice& dice) {
    const double work_of_step =
        static_cast<double>(sizes.modes + 8) * static_cast<double>(sizes.contacts + 6);
    const double most = std::min(highest_rate_hz / output_rate_hz, work_of_frame / work_of_step);
    const std::size_t largest = std::max<std::size_t>(1, static_cast<std::size_t>(most));
    const std::size_t steps = dice.chance(0.1) ? largest : dice.spread_whole(1, largest);
    return output_rate_hz * static_cast<double>(steps);
}

void choose_scheme(Dice& dice, SceneDescription& scene) {
    static constexpr ImpactLaw laws[] = {ImpactLaw::Newton, ImpactLaw::Passive, ImpactLaw::Signorini,
                                         ImpactLaw::Signorini, ImpactLaw::PaoliSchatzman};
    scene.law = laws[dice.whole(0, 4)];
    if (!dice.chance(0.06)) return;
    scene.scheme = Scheme::Theta;
    scene.law = ImpactLaw::Newton;
    scene.theta = dice.chance(0.5) ? dice.pick({0.5, 1}) : dice.uniform(0.5, 1);
}

/// `newton` and `paoli-schatzman` may inject energy: only the balance of each step tells by how much.
void choose_playing(Dice& dice, HostileScene& hostile) {
    hostile.forces = dice.chance(0.4);
    hostile.moves = dice.chance(0.25);
    const bool of_steps = hostile.moves || !is_passive(hostile.description.law) || dice.chance(0.25);
    hostile.metering = of_steps ? Metering::Step : dice.chance(0.5) ? Metering::Frame : Metering::Off;
    if (dice.chance(0.8)) return;
    hostile.skipping = {dice.chance(0.5), dice.chance(0.5), dice.chance(0.5), dice.chance(0.5),
                        dice.chance(0.5)};
}

StringPlan choose_plan(Dice& dice) {
    StringPlan plan;
    plan.extreme = dice.chance(0.1);
    plan.tabled = dice.chance(0.2);
    plan.neck = dice.chance(0.15);
    plan.lifted = !plan.neck && dice.chance(0.2);
    plan.sizes = choose_sizes(plan, dice);
    if (plan.lifted) plan.sizes.contacts = std::min<std::size_t>(plan.sizes.contacts, 200);
    return plan;
}

std::string kind_of(const StringPlan& plan, const HostileScene& hostile) {
    std::string kind =
        hostile.description.scheme == Scheme::Theta ? "theta" : name_of(hostile.description.law);
    if (plan.extreme) return kind + " extreme";
    if (plan.neck) return kind + " neck";
    return kind + (plan.tabled ? " tabled" : plan.lifted ? " lifted" : " string");
}

/// Compliant contacts are solved in rounds over all of them.
constexpr std::size_t most_compliant_contacts = 60;

Compliance choose_compliance(Dice& dice) {
    Compliance compliance;
    compliance.stiffness = dice.spread(1e2, 1e12);
    compliance.exponent = dice.chance(0.4) ? dice.pick({1, 1.5, 3}) : dice.uniform(1, 3);
    if (dice.chance(0.5)) compliance.loss_s_per_m = dice.spread(1e-3, 1e3);
    if (dice.chance(0.1)) compliance.resistance_kg_per_s = dice.spread(1e-4, 1e2);
    return compliance;
}

void add_hammers(Dice& dice, double frame_s, StringDescription& string) {
    for (std::size_t n = dice.whole(1, 3); n > 0; --n) {
        FlyingHammer hammer;
        hammer.position_m = dice.uniform(0, string.length_m);
        hammer.side = dice.chance(0.5) ? Side::Below : Side::Above;
        hammer.time_s = dice.uniform(0, 100 * frame_s);
        hammer.mass_kg = string.linear_density_kg_per_m * string.length_m * dice.spread(1e-4, 1e2);
        hammer.velocity_m_per_s = dice.spread(1e-3, 1e2);
        hammer.compliance = choose_compliance(dice);
        hammer.compliance.resistance_kg_per_s = 0;
        string.hammers.push_back(hammer);
    }
}

void add_springs(Dice& dice, double height_m, StringDescription& string) {
    for (std::size_t n = dice.whole(1, 2); n > 0; --n) {
        SpringDescription spring;
        spring.position_m = dice.uniform(0, string.length_m);
        spring.height_m = height_m * dice.uniform(-1, 1);
        spring.stiffness_N_per_m = dice.spread(1e-2, 1e8);
        if (dice.chance(0.3)) spring.resistance_kg_per_s = dice.spread(1e-4, 1e2);
        string.springs.push_back(spring);
    }
}

void add_laboratory(Dice& dice, HostileScene& hostile) {
    const double frame_s = 1 / hostile.description.output_rate_hz;
    for (StringDescription& string : hostile.description.strings) {
        if (string.contacts.size() > most_compliant_contacts) string.contacts.resize(most_compliant_contacts);
        if (dice.chance(0.8)) {
            for (ContactDescription& contact : string.contacts) {
                if (dice.chance(0.6)) contact.compliance = choose_compliance(dice);
            }
        }
        if (dice.chance(0.3)) add_hammers(dice, frame_s, string);
        if (dice.chance(0.2)) add_springs(dice, hostile.height_m, string);
        for (ProbeDescription& probe : string.probes) {
            if (probe.contact >= string.contacts.size()) probe.quantity = Quantity::Energy;
        }
    }
    hostile.kind += " laboratory";
}

}  // namespace

HostileScene make_hostile_scene(std::uint64_t seed) {
    Dice dice(seed);
    HostileScene hostile;
    SceneDescription& scene = hostile.description;
    StringPlan plan = choose_plan(dice);
    scene.output_rate_hz = choose_output_rate(dice);
    scene.contact_rate_hz = choose_contact_rate(scene.output_rate_hz, plan.sizes, dice);
    plan.contact_rate_hz = scene.contact_rate_hz;
    choose_scheme(dice, scene);
    choose_playing(dice, hostile);
    const std::size_t strings = dice.chance(0.1) ? dice.whole(2, 4) : 1;
    for (std::size_t s = 0; s < strings; ++s) {
        PlannedString planned = make_string(plan, dice);
        hostile.height_m = planned.height_m;
        scene.strings.push_back(std::move(planned.string));
        plan.sizes.contacts = std::min<std::size_t>(plan.sizes.contacts, 20);
        plan.sizes.modes = std::min<std::size_t>(plan.sizes.modes, 50);
    }
    hostile.kind = kind_of(plan, hostile);
    hostile.denormals = dice.chance(0.25);
    if (seed >= first_laboratory_seed && scene.scheme == Scheme::Exact) add_laboratory(dice, hostile);
    return hostile;
}

}  // namespace jawari::stress
