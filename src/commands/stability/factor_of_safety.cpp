#include "commands/stability/factor_of_safety.hpp"

#include "commands/list/stability.hpp"
#include "commands/stability/fine_zones.hpp"
#include "commands/stability/strength_search.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Ratio of a model at rest when the command gives none.
constexpr double default_ratio = 1e-5;
/// If a model that has slid is stable only below this part of its factor, it has fallen, not only slid.
constexpr double fallen_part = 0.5;
constexpr double largest = 64; ///< largest factor of the search
/// A bracket that begins with a guess has this half width, and is widened so many times as much each time.
constexpr double first_width = 0.03, widening = 4;

/// A factor at which the model is stable, and one at which it fails.
struct Bracket {
    double stands, fails;
};
bool closed(const Bracket& bracket) { return bracket.stands > 0 && std::isfinite(bracket.fails); }
double middle(const Bracket& bracket) { return 0.5 * (bracket.stands + bracket.fails); }

Bracket given_bracket(StrengthSearch& search, const lang::Solve& command) {
    const Bracket bracket{(*command.bracket)[0], (*command.bracket)[1]};
    if (!search.stands(bracket.stands))
        throw Diagnostic(fmt::format("the model fails with its strength divided by {:.6g}, where it should be stable",
                                     bracket.stands),
                         "give a smaller first number after bracket")
            .at(command.place);
    if (search.stands(bracket.fails))
        throw Diagnostic(
            fmt::format("the model is stable with its strength divided by {:.6g}, where it should fail", bracket.fails),
            "give a greater second number after bracket")
            .at(command.place);
    return bracket;
}

/// By doubling and halving; a side that was not found is 0 or infinite.
Bracket found_bracket(StrengthSearch& search) {
    if (search.stands(1)) {
        for (double factor = 1; factor < largest; factor *= 2)
            if (!search.stands(2 * factor)) return {factor, 2 * factor};
        return {largest, INFINITY};
    }
    for (double factor = 1; factor > 1 / largest; factor /= 2)
        if (search.stands(factor / 2)) return {factor / 2, factor};
    return {0, 1 / largest};
}

/// From a guess outward; a side that was not found is 0 or infinite.
Bracket bracket_around(StrengthSearch& search, double guess) {
    double width = first_width;
    Bracket bracket{guess * (1 - width), guess * (1 + width)};
    if (search.stands(bracket.stands)) {
        for (; bracket.fails < largest; width *= widening, bracket.stands = bracket.fails, bracket.fails *= 1 + width)
            if (!search.stands(bracket.fails)) return bracket;
        return {bracket.stands, INFINITY};
    }
    for (bracket.fails = bracket.stands; bracket.fails > 1 / largest; bracket.fails = bracket.stands) {
        width = std::min(0.5, width * widening);
        bracket.stands = bracket.fails * (1 - width);
        if (search.stands(bracket.stands)) return bracket;
    }
    return {0, bracket.fails};
}

/// The least factor of a block that can leave its place, by block theory; infinite without one.
double factor_of_weakest_block(Session& session) {
    double least = INFINITY;
    for (const BodyStability& body : stability_of(session.engine.model, session.engine.joints))
        if (!body.fixed && body.stage == 1 && body.answer.factor) least = std::min(least, *body.answer.factor);
    return least;
}

/// Initial guess: the factor of the weakest block, else the last result of `limit equilibrium` or of an earlier search; 0 without either.
double guessed_factor(const Session& session, double of_weakest_block) {
    constexpr double least = 0.1, most = 10;
    const double guess =
        std::isfinite(of_weakest_block) ? of_weakest_block : session.engine.model.clock.factor_of_safety;
    return guess >= least && guess <= most ? guess : 0;
}

/// Contacts that block theory does not have, such as the edge of a block on the face of another one, hold a block that can leave its place.
void doubt_held_block(Session& session, double factor, double of_weakest_block, const Place& place) {
    constexpr double noticeable = 1.1;
    // Bolts take up load during motion, and block theory has only the tension that they have.
    if (!(factor > noticeable * of_weakest_block) || session.engine.model.structures.stand()) return;
    session.warn(
        Diagnostic(
            fmt::format("the factor is {:.4g}, and a block can leave its place at {:.4g} (list stability)", factor,
                        of_weakest_block),
            "in the model something else holds that block, often one of its edges on a face of another block with "
            "zones, whose stiffness follows from the size of the zones: look at `list contacts`")
            .at(place));
}

Bracket narrowed(StrengthSearch& search, Bracket bracket, double resolution) {
    constexpr double rounding = 1e-9;
    while (bracket.fails - bracket.stands > (1 + rounding) * resolution * bracket.stands) {
        search.expect(1 + static_cast<int>(std::ceil(std::log2((bracket.fails / bracket.stands - 1) / resolution))));
        const double factor = middle(bracket);
        (search.stands(factor) ? bracket.stands : bracket.fails) = factor;
    }
    return bracket;
}

/// The model is stable where an early-ended trial failed: the search continues upward.
Bracket bracket_above(StrengthSearch& search, double stands, double resolution) {
    Bracket bracket{stands, stands};
    for (double width = widening * resolution; bracket.fails < largest; width *= 2) {
        bracket.stands = bracket.fails;
        bracket.fails *= 1 + width;
        if (!search.stands(bracket.fails)) return narrowed(search, bracket, resolution);
    }
    return {bracket.fails, INFINITY};
}

/// The lower end of the bracket may be unstable: the search continues downward in doubling steps, and gives up below `least` with a lower
/// end of 0.
Bracket bracket_below(StrengthSearch& search, Bracket bracket, double resolution, double least) {
    if (search.stands(bracket.stands)) return bracket;
    double width = resolution;
    for (bracket.fails = bracket.stands; bracket.stands > least; bracket.fails = bracket.stands) {
        bracket.stands /= 1 + width;
        width = std::min(1.0, 2 * width);
        if (search.stands(bracket.stands)) return narrowed(search, bracket, resolution);
    }
    return {0, bracket.fails};
}

/// The result must not depend on early ends, nor on the order of trials. The failing factor is tried again, to the end and from the stable one, where its
/// trial ended early or began with more strength; the stable one is tried again with other beginnings, and so is the failing one where slip in earlier trials
/// counts. If either changes, the search continues from there.
Bracket confirmed(StrengthSearch& search, Bracket bracket, double resolution) {
    if (search.failed() && (search.failed()->goes_on || search.failed()->began < bracket.stands)) {
        search.enter(StrengthSearch::Stage::patient);
        if (search.stands(bracket.fails)) bracket = bracket_above(search, bracket.fails, resolution);
    }
    if (!closed(bracket)) return bracket;
    const bool slip_counts = search.slip_counts();
    if (!slip_counts && search.enter_sliding()) {
        const Bracket below = bracket_below(search, bracket, resolution, fallen_part * bracket.stands);
        if (closed(below)) return below;
    }
    search.enter(StrengthSearch::Stage::from_start);
    const Bracket below = bracket_below(search, bracket, resolution, 1 / largest);
    if (below.fails != bracket.fails || !slip_counts || !search.stands(below.fails)) return below;
    return bracket_above(search, below.fails, resolution);
}

/// The middle of the bracket when flowing zones share their strains with their neighbours, searched from below the factor of the mesh.
/// None where it has none.
std::optional<double> shared_factor(const TrialBench& bench, ModelOnTrial& model, const lang::Solve& command,
                                    double factor) {
    constexpr double guess = 0.9;
    ReducedModel initial = bench.initial;
    initial.model.unreduced |= strains_are_shared;
    const TrialBench sharing{bench.session, bench.asked, initial, bench.ratio, bench.span, bench.progress};
    lang::Solve quiet = command;
    quiet.keep = false;
    quiet.file.clear();
    StrengthSearch search(sharing, model, quiet);
    Bracket bracket = bracket_around(search, guess * factor);
    if (closed(bracket)) bracket = confirmed(search, narrowed(search, bracket, command.resolution), command.resolution);
    return closed(bracket) ? std::optional(middle(bracket)) : std::nullopt;
}

/// Searches and prints the factor on fine zones; none where there is none, which is printed too. `own` is that of the mesh.
std::optional<double> factor_on_fine_zones(const TrialBench& bench, ModelOnTrial& model, const lang::Solve& command,
                                           double own, const FailureMode::Shares& mode) {
    Output& output = bench.session.program.output;
    if (mode.zones_high < fewest_zones) {
        output.say("no factor of safety on fine zones: too few zones moved; try a finer mesh");
        return std::nullopt;
    }
    output.say(
        "the search is repeated with strains that zones share with their neighbours (extrapolate off: it is not)");
    const std::optional<double> shared = shared_factor(bench, model, command, own);
    const auto fine = shared ? fine_factor(own, *shared, mode, command.resolution) : std::nullopt;
    if (!fine) {
        output.say(
            "no factor of safety on fine zones: sharing their strains does not make them weaker; try a finer mesh");
        return std::nullopt;
    }
    output.conclude(
        fmt::format("factor of safety on fine zones: {:.4g}, between {:.4g} and {:.4g}; {:.4g} with shared strains",
                    fine->factor, fine->factor - fine->error, fine->factor + fine->error, *shared));
    return fine->factor;
}

/// What moved, how, and in which mesh.
void say_failure(Output& output, const StrengthSearch& search, const std::optional<FailureMode::Shares>& mode,
                 FineZones fine) {
    if (const std::string moving = search.mechanism(); !moving.empty()) output.conclude(moving);
    if (!mode) return;
    output.conclude(mode_text(*mode));
    if (const std::string mesh = mesh_text(*mode, fine); !mesh.empty()) output.conclude(mesh);
}

/// What a search finds from the initial state of its bench.
Bracket searched(StrengthSearch& search, const lang::Solve& command, double guess) {
    const Bracket bracket = command.bracket ? given_bracket(search, command)
                            : guess > 0     ? bracket_around(search, guess)
                                            : found_bracket(search);
    if (!closed(bracket)) return bracket;
    return confirmed(search, narrowed(search, bracket, command.resolution), command.resolution);
}

/// Says what the search found; returns the factor, or the nearest one that was tried.
double say_factor(Output& output, const Bracket& bracket) {
    if (bracket.stands == 0) {
        output.conclude(fmt::format("factor of safety: below {:.6g}", bracket.fails));
        return bracket.fails;
    }
    if (!std::isfinite(bracket.fails)) {
        output.conclude(fmt::format("factor of safety: above {:.6g}", bracket.stands));
        return bracket.stands;
    }
    output.conclude(
        fmt::format("factor of safety: {:.4g}, between {:.6g}, where it is stable, and {:.6g}, where it fails",
                    middle(bracket), bracket.stands, bracket.fails));
    return middle(bracket);
}

/// The ratio of the limits that shows rest, the average one where none is given.
RestRatio ratio_of(const Limits& limits) {
    if (limits.local_ratio) return {*limits.local_ratio, &Clock::local_ratio};
    if (limits.maximum_ratio) return {*limits.maximum_ratio, &Clock::maximum_ratio};
    return {limits.ratio.value_or(default_ratio)};
}

} // namespace

void find_factor_of_safety(Session& session, const lang::Solve& command, const Limits& limits) {
    Output& output = session.program.output;
    const bool whole = command.included.empty() && command.excluded.empty();
    const double of_weakest_block = whole || !command.bracket ? factor_of_weakest_block(session) : INFINITY,
                 guess = command.bracket ? 0 : guessed_factor(session, of_weakest_block);
    if (guess > 0) output.say(fmt::format("the search begins at a factor of {:.4g}", guess));
    double factor = 0;
    {
        make_ready(session); // contacts must have their properties
        const Asked asked(command);
        check_for_trials(session, asked, command.place);
        if (command.associated) check_for_associated_flow(session, command.place);
        const FineZones fine = fine_zones(session, asked, command);
        Progress progress(output, session.engine.model, {});
        const RestRatio ratio = ratio_of(limits);
        ModelOnTrial model(session, asked, command.associated);
        const std::int64_t span =
            command.cycles ? *command.cycles : characteristic_span(session, progress, ratio, command.place);
        const TrialBench bench{session, asked, model.initial(), ratio, span, progress};
        std::optional<StrengthSearch> search(std::in_place, bench, model, command);
        Bracket bracket = searched(*search, command, guess);
        // A model that was never at rest may take longer to come to rest than a span shows, at any strength: what it takes with its strength as it is.
        std::optional<ReducedModel> rested;
        std::optional<TrialBench> from_rest;
        if (bracket.stands == 0 && (rested = brought_to_rest(bench))) {
            output.say("no strength holds the model where it is: the search is repeated from where it comes to rest");
            const std::int64_t taken = rested->model.clock.cycle - bench.initial.model.clock.cycle;
            from_rest.emplace(TrialBench{session, asked, *rested, ratio, std::max(span, taken), progress});
            search.emplace(*from_rest, model, command);
            bracket = searched(*search, command, guess);
        }
        const auto mode = search->failed() ? search->failed()->mode : std::nullopt;
        say_failure(output, *search, mode, fine);
        factor = say_factor(output, bracket);
        if (fine == FineZones::searched && closed(bracket))
            factor = factor_on_fine_zones(from_rest ? *from_rest : bench, model, command, factor,
                                          mode.value_or(FailureMode::Shares{}))
                         .value_or(factor);
    }
    session.engine.model.clock.factor_of_safety = factor;
    if (whole) doubt_held_block(session, factor, of_weakest_block, command.place);
}

} // namespace kaya
