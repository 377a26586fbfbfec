#include "commands/review/deck_needs.hpp"

#include "commands/review/deck_finding.hpp"
#include "commands/review/property_meaning.hpp"

#include <algorithm>
#include <any>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <tuple>

namespace kaya {

namespace {

/// Lines that make several blocks.
using Cutters = lang::CommandList<lang::PolyTunnel, lang::JointSetCommand, lang::TunnelCommand, lang::CutGround,
                                  lang::CutSurface, lang::CutPolygons, lang::CutFractures, lang::Densify, lang::Copy>;
using Joiners = lang::CommandList<lang::Join, lang::JoinContact>;
constexpr std::string_view missing = "property-missing";

/// Held blocks need no density.
using Holders = lang::CommandList<lang::Fix, lang::Boundary, lang::Apply>;
/// The material of what these make is not in the deck, or each block gets its own.
using Unknown = lang::CommandList<lang::Restore, lang::Import, lang::LuaFile>;

template <class... Made> std::optional<std::int64_t> material_of(const std::any& command, lang::CommandList<Made...>) {
    std::optional<std::int64_t> number;
    const auto read = [&](const auto* made) {
        if (made != nullptr) number = made->options.material;
    };
    (read(std::any_cast<Made>(&command)), ...);
    return number;
}

bool is_density(const std::string& word) {
    const auto property = find_block_property(word);
    return property && *property == lang::BlockProperty::density;
}

} // namespace

void DeckNeeds::check_script(std::string_view text) {
    constexpr std::array<std::string_view, 8> giving{"prop", "dens",    "material", "_mat",
                                                     ".mat", "command", "capture",  "call"};
    const std::string folded = lang::fold(text);
    open_ = open_ || std::ranges::any_of(giving, [&](auto word) { return folded.find(word) != folded.npos; });
}

void DeckNeeds::check(const lang::BoundCommand& command, bool inside) {
    const auto& any = command.command;
    if (const auto* function = std::any_cast<lang::FishDefinition>(&any)) return check_script(function->text);
    if (const auto* chunk = std::any_cast<lang::LuaChunk>(&any)) return check_script(chunk->text);
    if (is_one_of(any, Unknown{}) || inside) open_ = true;
    if (any.type() == typeid(lang::New)) {
        auto found = std::move(found_);
        *this = DeckNeeds();
        found_ = std::move(found);
    }
    if (open_) return;
    learn_structures(command);
    if (is_one_of(any, CyclingCommands{})) check_structures();
    if (checked_) return;
    if (is_one_of(any, CyclingCommands{})) return check_needs(command.place);
    learn(command);
    learn_materials(command);
}

void DeckNeeds::learn(const lang::BoundCommand& command) {
    const auto& any = command.command;
    if (is_one_of(any, lang::ShapeCommands{}) || is_one_of(any, Cutters{})) blocks_ = true;
    if (is_one_of(any, Cutters{})) cut_ = true;
    const auto* fix = std::any_cast<lang::Fix>(&any);
    if (fix != nullptr && !fix->range.place) all_held_ = true;
    if (is_one_of(any, Holders{})) some_held_ = true;
    if (any.type() == typeid(lang::BlockDensity)) dense_by_range_ = true;
    if (const auto* brick = std::any_cast<lang::PolyBrick>(&any); brick != nullptr && !command.late)
        bricks_.push_back({Vec3(brick->x[0], brick->y[0], brick->z[0]), Vec3(brick->x[1], brick->y[1], brick->z[1])});
    if (is_one_of(any, Joiners{})) joined_ = true;
    if (any.type() == typeid(lang::JointRuleCommand)) joint_properties_ = true;
    if (const auto* joint = std::any_cast<lang::JointModelCommand>(&any); joint != nullptr && !joint->items.empty())
        joint_properties_ = true;
    if (const auto* to_come = std::any_cast<lang::NewContacts>(&any); to_come != nullptr && !to_come->items.empty())
        joint_properties_ = true;
    const auto* zone = std::any_cast<lang::ZoneModelCommand>(&any);
    if (zone != nullptr && zone->density) dense_by_range_ = true;
    const auto* property = std::any_cast<lang::Property>(&any);
    if (zone != nullptr) learn_moduli(zone->items);
    if (property == nullptr) return;
    learn_moduli(property->items);
    if (command.late && property->items.empty()) open_ = true;
    for (const auto& item : property->items) {
        if (property->joint || !find_block_property(item.word)) joint_properties_ = true;
        if (!property->joint && is_density(item.word)) dense_.insert(property->number);
    }
}

void DeckNeeds::learn_moduli(const std::vector<lang::Property::Item>& items) {
    for (const auto& item : items)
        if (const auto property = find_block_property(item.word)) moduli_.try_emplace(*property, item.place);
}

void DeckNeeds::learn_structures(const lang::BoundCommand& command) {
    const auto& any = command.command;
    const auto use = [&](const auto* made) {
        if (made != nullptr && !command.late) structures_.try_emplace(made->property, command.place);
    };
    use(std::any_cast<lang::StructureCable>(&any));
    use(std::any_cast<lang::StructureBeam>(&any));
    use(std::any_cast<lang::StructureLiner>(&any));
    const auto* property = std::any_cast<lang::StructureProperty>(&any);
    if (property == nullptr) return;
    structure_properties_.insert(property->number);
    if (command.late) open_ = true;
}

/// One of two elastic constants.
void DeckNeeds::check_moduli() {
    using enum lang::BlockProperty;
    for (const auto& [one, other, name] :
         {std::tuple(bulk, shear, "shear"), std::tuple(shear, bulk, "bulk"), std::tuple(young, poisson, "poisson"),
          std::tuple(poisson, young, "young")}) {
        const auto given = moduli_.find(one);
        if (given == moduli_.end() || moduli_.contains(other)) continue;
        found_.push_back(finding(fmt::format("no line gives {} before the cycles", name),
                                 "elastic blocks need both: bulk and shear, or young and poisson", missing,
                                 Severity::warning)
                             .at(given->second));
    }
}

void DeckNeeds::check_structures() {
    for (const auto& [number, place] : structures_)
        if (!structure_properties_.contains(number))
            found_.push_back(finding(fmt::format("no line gives property {} of structures before the cycles", number),
                                     fmt::format("give it: structure property {} area 5e-4 young 2e11 ...", number),
                                     missing, Severity::warning)
                                 .at(place));
    structures_.clear();
}

void DeckNeeds::learn_materials(const lang::BoundCommand& command) {
    if (command.late) {
        if (command.command.type() == typeid(lang::Change)) open_ = true;
        return;
    }
    auto number = material_of(command.command, lang::ShapeCommands{});
    if (const auto* change = std::any_cast<lang::Change>(&command.command); change != nullptr && change->material)
        number = change->material;
    if (number) used_.try_emplace(*number, command.place);
}

void DeckNeeds::check_needs(const Place& cycle) {
    checked_ = true;
    if (!blocks_) return;
    check_moduli();
    const auto hint = [](std::int64_t number) { return fmt::format("give it before: prop mat {} dens 2600", number); };
    if (!dense_by_range_ && dense_.empty() && !all_held_) {
        const std::int64_t number = used_.empty() ? 1 : used_.begin()->first;
        found_.push_back(finding("no block has a density here", hint(number), missing,
                                 some_held_ ? Severity::warning : Severity::error)
                             .at(cycle));
    } else if (!dense_by_range_ && !all_held_) {
        for (const auto& [number, place] : used_) {
            // All blocks may have changed from material 1 to another one.
            if (dense_.contains(number) || (number == 1 && used_.size() > 1)) continue;
            found_.push_back(finding(fmt::format("material {} has no density when the cycles begin", number),
                                     hint(number), missing, Severity::warning)
                                 .at(place));
        }
    }
    if (joint_properties_ || joined_ || !(cut_ || !overlapping_boxes(bricks_).empty())) return;
    found_.push_back(finding("no line gives the joints a stiffness before these cycles",
                             "give it before: jmodel jkn 1e10 jks 1e10 jfric 30", missing, Severity::warning)
                         .at(cycle));
}

} // namespace kaya
