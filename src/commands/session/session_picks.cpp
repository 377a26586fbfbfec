// Which objects a range of a command picks.
#include "commands/session/new_contacts.hpp"
#include "commands/session/session.hpp"

#include <fmt/format.h>
#include <utility>

namespace kaya {

std::vector<Row> Session::pick_rows(ObjectKind kind, const lang::RangePhrase& range, bool hidden_too) {
    if (info_of(kind).found_late) find_joints(*this);
    auto rows = select(engine.model, kind, test_of(kind, range), hidden_too);
    if (!rows.empty()) return rows;
    const std::size_t tested = select(engine.model, kind, {}, hidden_too).size();
    const std::size_t hidden = hidden_too ? 0 : select(engine.model, kind, {}, true).size() - tested;
    const char* things = info_of(kind).plural;
    std::string text = tested > 0   ? fmt::format("0 of {} {} matched", tested, things)
                       : hidden > 0 ? fmt::format("all {} are hidden", things)
                                    : fmt::format("there are no {}", things);
    std::string hint = "the command has no effect";
    if (tested > 0 && hidden > 0) hint += fmt::format("; {} hidden {} were ignored", hidden, things);
    warn(Diagnostic(std::move(text), std::move(hint)).at(range.place));
    return rows;
}

RangeExtras Session::range_extras(bool excavated) {
    return {.joints = &engine.joints,
            .ground = [this](const std::string& file) { return read_ground(input_file(file).string()); },
            .surfaces = [this](const std::string& name) -> const PolygonSet* {
                const auto found = deck.surface_sets.surfaces.find(name);
                return found == deck.surface_sets.surfaces.end() ? nullptr : &found->second;
            },
            .networks = [this]() -> const auto& {return deck.surface_sets.networks;
}
, .excavated = excavated
}; // namespace kaya
}

RangeTest Session::test_of(ObjectKind kind, const lang::RangePhrase& range) {
    // Surface elements need contacts.
    if (has_element(deck.ranges, range, lang::RangeElement::Kind::surface)) find_joints(*this);
    RangeTest test = range_test(engine.model, deck.ranges, range, kind, range_extras(false));
    if (!test) return test;
    constexpr int rows_between = 256; // rows between two checks for interruption
    return [this, test = std::move(test), left = rows_between](const Model& of, ObjectKind of_kind, Row row) mutable {
        if (--left == 0) {
            left = rows_between;
            stop_if_interrupted();
        }
        return test(of, of_kind, row);
    };
}

std::vector<Row> Session::pick(ObjectKind kind, const lang::RangePhrase& range) {
    return pick_rows(kind, range, false);
}

std::vector<Row> Session::pick_hidden_too(ObjectKind kind, const lang::RangePhrase& range) {
    return pick_rows(kind, range, true);
}

} // namespace kaya
