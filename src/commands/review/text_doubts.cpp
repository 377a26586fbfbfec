#include "commands/review/text_doubts.hpp"

#include "commands/program/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace kaya {

namespace {

template <class Command> void add_doubts(const std::any& command, std::vector<Diagnostic>& all) {
    const auto* found = std::any_cast<Command>(&command);
    if (found == nullptr) return;
    for (auto& doubt : doubts_of(*found)) all.push_back(std::move(doubt));
}

void add_angles(const std::vector<lang::Property::Item>& items, std::vector<Diagnostic>& all) {
    constexpr std::string_view classic = "jfriction";
    constexpr std::size_t shortest = 3;
    for (const auto& item : items)
        if (item.word.size() >= shortest && (classic.starts_with(item.word) || item.word == "friction") &&
            may_be_radians(item))
            all.push_back(radian_doubt(item));
}

} // namespace

Diagnostic implausible(std::string message, std::string hint) {
    Diagnostic d(std::move(message), std::move(hint));
    d.code = "implausible";
    return d;
}

std::vector<Diagnostic> doubts_of(const lang::JointSetCommand& command) {
    const double dip = command.dip[0], direction = command.dip_direction[0];
    const auto is_radian = [](double angle, double most) {
        return angle > 0 && angle <= most && angle != std::round(angle);
    };
    std::vector<Diagnostic> found;
    const auto add = [&](std::string message, std::string hint) {
        found.push_back(implausible(std::move(message), std::move(hint)).at(command.place));
    };
    if (dip < 0)
        add(fmt::format("a dip of {} is negative", number_text(dip)),
            fmt::format("the plane is that of dip {} with dd turned by 180", number_text(-dip)));
    if (dip > 90)
        add(fmt::format("a dip of {} is more than vertical", number_text(dip)),
            fmt::format("the plane is that of dip {} with dd turned by 180", number_text(180 - dip)));
    if (std::abs(direction) > 360)
        add(fmt::format("a dip direction of {} is more than a full turn", number_text(direction)),
            fmt::format("it is taken as {}", number_text(std::fmod(direction, 360))));
    if (is_radian(dip, std::numbers::pi / 2) && is_radian(direction, 2 * std::numbers::pi))
        add(fmt::format("dip {} and dd {} are nearly 0: angles are in degrees", number_text(dip),
                        number_text(direction)),
            fmt::format("as radians they would be dip {:.4g} and dd {:.4g}", dip * 180 / std::numbers::pi,
                        direction * 180 / std::numbers::pi));
    return found;
}

std::vector<Diagnostic> doubts_of(const lang::InSitu& command) {
    const auto pulls = [](double stress) { return stress > 0; };
    if (!command.stress || !std::all_of(command.stress->begin(), command.stress->begin() + 3, pulls)) return {};
    return {implausible("all normal stresses are positive: the ground is pulled in all directions",
                        "compression is negative: insitu stress -1e6 -1e6 -1e6 0 0 0")
                .at(command.place)};
}

std::vector<Diagnostic> doubts_of(const lang::Damp& command) {
    using enum lang::Damp::Kind;
    if ((command.kind != local && command.kind != combined) || command.value.value_or(0) < 1) return {};
    return {implausible(
        fmt::format("a damping factor of {} takes all force from moving bodies", number_text(*command.value)),
        "0.8 is usual")};
}

std::vector<Diagnostic> doubts_of(const lang::HistoryWrite& command) {
    for (const std::string_view other : {".xls", ".xlsx", ".mat", ".ods"})
        if (command.file.ends_with(other))
            return {implausible(fmt::format("'{}' gets text: histories are written with commas", command.file),
                                "a name with .csv opens as a table")};
    return {};
}

std::vector<Diagnostic> doubts_of(const lang::Solve& command) {
    if (command.ratio.value_or(0) < 1) return {};
    return {implausible(fmt::format("a ratio of {} is reached before the first cycle", number_text(*command.ratio)),
                        "the unbalanced force is a part of the acting forces: 1e-5 is usual")
                .at(command.place)};
}

bool may_be_radians(const lang::Property::Item& item) { return item.value > 0 && item.value < std::numbers::pi / 2; }

Diagnostic radian_doubt(const lang::Property::Item& item) {
    const double degrees = item.value * 180 / std::numbers::pi;
    return implausible(fmt::format("{} {}: angles are in degrees, and this one is nearly 0", item.word,
                                   number_text(item.value)),
                       fmt::format("as radians it would be {} degrees, as a coefficient {}",
                                   number_text(std::round(degrees * 10) / 10),
                                   number_text(std::round(std::atan(item.value) * 1800 / std::numbers::pi) / 10)))
        .at(item.place);
}

std::vector<Diagnostic> text_doubts(const std::any& command) {
    std::vector<Diagnostic> all;
    add_doubts<lang::JointSetCommand>(command, all);
    add_doubts<lang::InSitu>(command, all);
    add_doubts<lang::Damp>(command, all);
    add_doubts<lang::Solve>(command, all);
    add_doubts<lang::HistoryWrite>(command, all);
    if (const auto* property = std::any_cast<lang::Property>(&command)) add_angles(property->items, all);
    if (const auto* joint = std::any_cast<lang::JointModelCommand>(&command)) add_angles(joint->items, all);
    return all;
}

} // namespace kaya
