#include "hostile_string.h"

#include <algorithm>
#include <vector>

#include "jawari/scene/obstacles.h"

namespace jawari::stress {
namespace {

/// More contacts than this are not pressed through at the start: the static problem is dense.
constexpr std::size_t contacts_to_lift = 200;

void choose_body(const StringPlan& plan, Dice& dice, StringDescription& string, PhysicalModes& modes) {
    string.length_m = plan.extreme ? dice.spread(0.001, 1000) : dice.spread(0.05, 5);
    string.linear_density_kg_per_m = plan.extreme ? dice.spread(1e-9, 1e7) : dice.spread(1e-6, 1);
    modes.tension_N = plan.extreme ? dice.spread(1e-8, 1e8) : dice.spread(1e-2, 1e5);
    modes.inharmonicity = dice.chance(0.3) ? 0.0 : dice.spread(1e-8, plan.extreme ? 1e3 : 0.1);
    modes.inharmonicity_law = dice.chance(0.5) ? InharmonicityLaw::SquareRoot : InharmonicityLaw::FirstOrder;
}

std::variant<NoLoss, ValetteLoss, DecayTimePoints> choose_losses(Dice& dice) {
    switch (dice.whole(0, 3)) {
        case 0:
            return NoLoss{};
        case 1:
            return ValetteLoss{dice.spread(1e-5, 1e-2), dice.spread(1e-8, 1), dice.spread(1e-3, 1e3),
                               dice.spread(1e-6, 1), dice.chance(0.2) ? 0.0 : dice.spread(1e-8, 10)};
        case 2: {
            const double slow = dice.spread(1e-4, 1e3);
            return DecayTimePoints{
                {{{dice.spread(10, 1000), slow}, {dice.spread(1001, 1e5), slow * dice.spread(1e-4, 1)}}}};
        }
        default:
            return DecayTimePoints{{{{100, dice.uniform(0.5, 10)}, {5000, dice.uniform(0.01, 0.5)}}}};
    }
}

/// Any frequencies in any order: half-way and full turns of the step among them, where s = 0 and d = 0.
ModeTable choose_table(const StringPlan& plan, std::size_t count, Dice& dice) {
    ModeTable table;
    for (std::size_t k = 0; k < count; ++k) {
        const bool resonant = dice.chance(0.05);
        table.frequency_hz.push_back(resonant
                                         ? plan.contact_rate_hz / 2 * static_cast<double>(dice.whole(1, 4))
                                         : dice.spread(plan.extreme ? 1e-3 : 1.0, plan.extreme ? 1e9 : 1e6));
        table.decay_per_s.push_back(dice.chance(0.3) ? 0.0 : dice.spread(1e-3, plan.extreme ? 1e9 : 1e6));
    }
    return table;
}

double choose_place(Dice& dice, double length_m) {
    if (dice.chance(0.05)) return dice.chance(0.5) ? 0.0 : length_m;
    if (dice.chance(0.05)) return length_m * dice.spread(1e-9, 1e-3);
    if (dice.chance(0.03)) return length_m * (1 - dice.spread(1e-9, 1e-3));
    return length_m * dice.unit();
}

double choose_restitution(Dice& dice) {
    return dice.chance(0.4) ? dice.pick({0, 0.5, 1}) : dice.unit();
}

ContactDescription choose_contact(const StringPlan& plan, Dice& dice, const StringDescription& string,
                                  double height_m) {
    ContactDescription contact;
    contact.position_m = choose_place(dice, string.length_m);
    const bool inside =
        contact.position_m > 1e-3 * string.length_m && contact.position_m < (1 - 1e-3) * string.length_m;
    const double depth = dice.chance(0.1) ? 0.0 : dice.unit();
    const double sign = plan.lifted && inside && dice.chance(0.3) ? 1.0 : -1.0;
    contact.height_m = sign * height_m * depth;
    contact.restitution = choose_restitution(dice);
    return contact;
}

/// Some contacts coincide with one before, or lie nearer to it than the wave travels in a step.
void add_contacts(const StringPlan& plan, Dice& dice, StringDescription& string, double height_m) {
    for (std::size_t i = 0; i < plan.sizes.contacts; ++i) {
        ContactDescription contact = choose_contact(plan, dice, string, height_m);
        if (i > 0 && dice.chance(0.2)) {
            const ContactDescription& other = string.contacts[dice.whole(0, i - 1)];
            contact.position_m = other.position_m;
            contact.height_m = dice.chance(0.5) ? other.height_m : std::min(other.height_m, contact.height_m);
            if (dice.chance(0.3))
                contact.position_m =
                    std::min(string.length_m, other.position_m * (1 + dice.spread(1e-15, 1e-3)));
        }
        string.contacts.push_back(contact);
    }
    if (plan.lifted || plan.sizes.contacts == 0 || plan.sizes.contacts >= contacts_to_lift) return;
    if (!dice.chance(0.3)) return;
    for (std::size_t i = dice.whole(1, 3); i > 0; --i)
        string.contacts.push_back({dice.uniform(0.01, 0.99) * string.length_m, height_m * dice.uniform(1, 12),
                                   choose_restitution(dice), Side::Above});
}

void add_neck(const StringPlan& plan, Dice& dice, StringDescription& string, double height_m) {
    const std::vector<ProfilePoint> profile{
        {0, -height_m * dice.unit()},
        {string.length_m * dice.uniform(0.1, 0.9), -height_m * dice.unit()},
        {string.length_m, -height_m * dice.unit()}};
    string.contacts = sampled_neck(string.length_m, plan.sizes.contacts, profile, choose_restitution(dice));
}

InitialCondition choose_start(const StringPlan& plan, std::size_t modes, double length_m, double height_m,
                              Dice& dice) {
    InitialCondition initial;
    initial.start = dice.chance(0.7) ? Start::Exact : Start::Backward;
    const bool may_press = plan.sizes.contacts <= contacts_to_lift;
    const double sign = may_press && dice.chance(0.3) ? -1.0 : 1.0;
    switch (dice.whole(0, 4)) {
        case 0:
            initial.shape = AtRest{};
            break;
        case 1: {
            ModalState state;
            for (std::size_t k = 0; k < modes; ++k)
                state.velocity.push_back(dice.uniform(-1, 1) * height_m * dice.spread(1, 1e5));
            initial.shape = state;
            break;
        }
        default:
            initial.shape = Pluck{length_m * dice.spread(1e-3, 0.999), sign * height_m * dice.uniform(0, 10)};
    }
    return initial;
}

void add_probes(Dice& dice, StringDescription& string) {
    for (std::size_t p = dice.whole(1, 4); p > 0; --p) {
        const double x = dice.chance(0.1) ? string.length_m : dice.unit() * string.length_m;
        string.probes.push_back({dice.chance(0.5) ? Quantity::Displacement : Quantity::Velocity, x, 0});
    }
    if (dice.chance(0.3)) string.probes.push_back({Quantity::Energy, 0, 0});
    if (dice.chance(0.3) && !string.contacts.empty())
        string.probes.push_back({Quantity::ContactForce, 0, dice.whole(0, string.contacts.size() - 1)});
}

}  // namespace

PlannedString make_string(const StringPlan& plan, Dice& dice) {
    PlannedString planned;
    StringDescription& string = planned.string;
    PhysicalModes modes;
    choose_body(plan, dice, string, modes);
    modes.count = plan.sizes.modes;
    modes.damping = choose_losses(dice);
    string.modes = modes;
    if (plan.tabled) string.modes = choose_table(plan, plan.sizes.modes, dice);
    const double height_m =
        string.length_m * dice.spread(plan.extreme ? 1e-9 : 1e-5, plan.extreme ? 10 : 0.02);
    planned.height_m = height_m;
    if (plan.neck) {
        add_neck(plan, dice, string, height_m);
    } else {
        add_contacts(plan, dice, string, height_m);
    }
    string.initial = choose_start(plan, plan.sizes.modes, string.length_m, height_m, dice);
    add_probes(dice, string);
    return planned;
}

}  // namespace jawari::stress
