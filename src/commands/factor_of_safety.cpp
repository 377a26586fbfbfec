#include "commands/factor_of_safety.hpp"

#include "base/counted.hpp"

#include "commands/handlers.hpp"
#include "commands/materials.hpp"

#include "mechanics/contact_table.hpp"
#include "mechanics/zone_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace kaya {

namespace {

/// How a property gets weaker by a factor: the name that it begins with, and the unit that it then has.
struct Strength {
    std::string_view name, unit;
    double (*divided)(double value, double factor);
};

double divided(double value, double factor) { return value / factor; }

double with_tangent_divided(double degrees, double factor) {
    constexpr double radian = std::numbers::pi / 180;
    return std::atan(std::tan(degrees * radian) / factor) / radian;
}

constexpr std::array<Strength, 3> strengths{{
    {"friction", "angle", with_tangent_divided},
    {"cohesion", "stress", divided},
    {"tension", "stress", divided},
}};

const Strength* strength_of(const JointModel::Property& property) {
    const auto found = std::ranges::find_if(strengths, [&](const Strength& strength) {
        return property.name.starts_with(strength.name) && property.unit == strength.unit;
    });
    return found == strengths.end() ? nullptr : &*found;
}

/// Below this the model counts as at rest when the command does not say.
constexpr double default_ratio = 1e-5;
/// Cycles after which a model that cannot fail ought to be at rest.
constexpr std::int64_t patience = 100000;
constexpr std::int64_t shortest_span = 100;
/// Spans that one trial may take, the part of its unbalanced force that each should take away, and how many in a row may
/// fail to: near the limit a block sticks and slips, and the force goes up and down.
constexpr int spans = 12;
constexpr double gain = 0.1;
constexpr int most_without_gain = 2;
/// Factors beyond which nobody looks.
constexpr double largest = 64;

/// Trials of one model; each begins with the model as it was in the beginning, and so does what comes after the last.
class Trials {
public:
    Trials(Session& session, const lang::Solve& command, const Limits& limits)
        : session_(session), file_(command.file), ratio_(limits.ratio.value_or(default_ratio)) {
        session.cycle->prepare(); // contacts must have their properties
        check_strengths(command.place);
        if (session.model.settings.damping == Damping::none)
            throw Diagnostic("without damping a model never comes to rest, and no factor of safety can be found",
                             "write before it, for example: damp local")
                .at(command.place);
        start_ = session.model;
        try {
            span_ = command.cycles ? *command.cycles : characteristic_span(command.place);
        } catch (...) {
            go_back();
            throw;
        }
        go_back();
    }
    ~Trials() { go_back(); }
    Trials(const Trials&) = delete;
    Trials& operator=(const Trials&) = delete;

    /// Whether the model comes to rest with its strength divided by the factor. It stands when the ratio is reached; it
    /// fails when its unbalanced force does not get smaller from one span to the next.
    bool stands(double factor) {
        go_back();
        for (const Row row : property_sets_in_use(session_.model)) {
            auto& set = session_.model.joint_properties[row];
            const JointModel& joint = session_.joints.get(set.model);
            for (std::size_t i = 0; i < joint.properties.size(); ++i)
                if (const Strength* strength = strength_of(joint.properties[i]))
                    set.values[i] = strength->divided(set.values[i], factor);
        }
        session_.model.settings.strength_factor = factor;
        session_.model.properties_changed = true;
        bool at_rest = false;
        std::optional<MovingBody> moving;
        std::int64_t cycles = 0;
        double least = INFINITY;
        for (int i = 0, without_gain = 0; i < spans && without_gain <= most_without_gain; ++i) {
            const RestSpan span = advance_span(session_, span_, ratio_);
            cycles += span.cycles;
            at_rest = span.at_rest;
            moving = span.moving;
            if (at_rest || moving) break;
            without_gain = span.mean_ratio > (1 - gain) * least ? without_gain + 1 : 0;
            least = std::min(least, span.mean_ratio);
        }
        session_.output.say(fmt::format("strength divided by {:.6g}: {} after {}, ratio {:.3e}{}", factor,
                                        at_rest ? "stands" : "fails", counted(cycles, "cycle"), session_.model.clock.average_ratio,
                                        moving ? "; " + body_text(session_.model, *moving) + " moves on" : ""));
        if (!at_rest && !file_.empty()) run(session_, lang::Save{file_});
        return at_rest;
    }

private:
    void go_back() {
        session_.model = start_;
        session_.model.lists_changed = true;
    }

    void check_strengths(const Place& place) {
        std::string without;
        bool any = false;
        for (const Row row : property_sets_in_use(session_.model)) {
            const JointModel& joint = session_.joints.get(session_.model.joint_properties[row].model);
            const bool strong = std::ranges::any_of(joint.properties, [](const auto& p) { return strength_of(p) != nullptr; });
            any = any || strong;
            if (!strong) without = joint.name;
        }
        for (const auto& name : zone_models_in_use(session_.model)) {
            const ZoneModel& zones = session_.joints.zones.get(name);
            any = any || can_be_reduced(zones);
            if (zones.flows() && !can_be_reduced(zones))
                session_.warn(Diagnostic(fmt::format("zone model '{}' has no strength that could be divided", name),
                                         "its strength stays as it is in all trials")
                                  .at(place));
        }
        if (!any)
            throw Diagnostic(without.empty() ? "there is no joint whose strength could be divided"
                                             : fmt::format("joint model '{}' has no strength that could be divided", without),
                             "a factor of safety needs joints with friction, cohesion or tension")
                .at(place);
        if (!without.empty())
            session_.warn(Diagnostic(fmt::format("joint model '{}' has no friction, cohesion or tension", without),
                                     "its strength stays as it is in all trials")
                              .at(place));
    }

    /// How many cycles the model needs to come to rest when half of all its inner forces are taken away and nothing
    /// can fail.
    std::int64_t characteristic_span(const Place& place) {
        Model& model = session_.model;
        const ElasticJoints strong(session_);
        model.settings.strength_factor = 0.01; // zones a hundred times as strong do not yield
        for (double& force : model.sub_contacts.normal_force) force *= 0.5;
        for (auto& column : model.sub_contacts.shear_force.component)
            for (double& force : column) force *= 0.5;
        for (Stress& stress : model.zones.stress) stress *= 0.5;
        initialise_sub_contacts(model, session_.joints, std::vector<char>(model.sub_contacts.size(), 1));
        model.properties_changed = true;
        const RestSpan span = advance_span(session_, patience, ratio_);
        if (!span.at_rest)
            throw Diagnostic(fmt::format("with joints that cannot fail the model is not at rest after {} cycles: the ratio "
                                         "is {:.3e}",
                                         span.cycles, model.clock.average_ratio),
                             "hold it so that only joints can let it go, or give a larger `ratio`, or the `cycles` of a span")
                .at(place);
        return std::max(span.cycles, shortest_span);
    }

    Session& session_;
    std::string file_;
    double ratio_;
    Model start_;
    std::int64_t span_ = 0;
};

/// Factors where the model stands and where it fails.
struct Bracket {
    double stands, fails;
};

Bracket given_bracket(Trials& trials, const lang::Solve& command) {
    const Bracket bracket{(*command.bracket)[0], (*command.bracket)[1]};
    if (!trials.stands(bracket.stands))
        throw Diagnostic(fmt::format("the model fails with its strength divided by {:.6g}, where it should stand", bracket.stands),
                         "give a smaller first number behind bracket")
            .at(command.place);
    if (trials.stands(bracket.fails))
        throw Diagnostic(fmt::format("the model stands with its strength divided by {:.6g}, where it should fail", bracket.fails),
                         "give a greater second number behind bracket")
            .at(command.place);
    return bracket;
}

/// By doubling and halving; a side that was not found is 0 or infinite.
Bracket found_bracket(Trials& trials) {
    if (trials.stands(1)) {
        for (double factor = 1; factor < largest; factor *= 2)
            if (!trials.stands(2 * factor)) return {factor, 2 * factor};
        return {largest, INFINITY};
    }
    for (double factor = 1; factor > 1 / largest; factor /= 2)
        if (trials.stands(factor / 2)) return {factor / 2, factor};
    return {0, 1 / largest};
}

Bracket narrowed(Trials& trials, Bracket bracket, double resolution) {
    while (bracket.fails - bracket.stands > resolution * bracket.stands) {
        const double middle = 0.5 * (bracket.stands + bracket.fails);
        (trials.stands(middle) ? bracket.stands : bracket.fails) = middle;
    }
    return bracket;
}

} // namespace

void find_factor_of_safety(Session& session, const lang::Solve& command, const Limits& limits) {
    Bracket bracket;
    {
        Trials trials(session, command, limits);
        bracket = command.bracket ? given_bracket(trials, command) : found_bracket(trials);
        const bool closed = bracket.stands > 0 && std::isfinite(bracket.fails);
        if (closed) bracket = narrowed(trials, bracket, command.resolution);
    }
    double& factor = session.model.clock.factor_of_safety;
    if (bracket.stands == 0) {
        factor = bracket.fails;
        session.output.say(fmt::format("factor of safety: below {:.6g}", bracket.fails));
    } else if (!std::isfinite(bracket.fails)) {
        factor = bracket.stands;
        session.output.say(fmt::format("factor of safety: above {:.6g}", bracket.stands));
    } else {
        factor = 0.5 * (bracket.stands + bracket.fails);
        session.output.say(fmt::format("factor of safety: {:.4g}, between {:.6g}, where it stands, and {:.6g}, where it fails", factor,
                                       bracket.stands, bracket.fails));
    }
}

} // namespace kaya
