#include "commands/deck_properties.hpp"

#include "base/diagnostic.hpp"
#include "commands/zone_moduli.hpp"
#include "laws/given_values.hpp"
#include "mechanics/property_sets.hpp"

#include <algorithm>
#include <any>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

namespace kaya {

namespace {

/// Returns if one of the laws takes the item. Throws the last refusal of a value, or else the first one of a word.
template <class Law> void accepted_by_one(const std::vector<std::unique_ptr<Law>>& laws, const char* noun,
                                          const lang::Property::Item& item) {
    std::optional<Diagnostic> refusal;
    for (const auto& law : laws) {
        const bool known = law->find_property(item.word).has_value();
        try {
            accepting_property(*law, noun, item.word, item.value);
            return;
        } catch (const Diagnostic& mistake) {
            if (known || !refusal) refusal = mistake;
        }
    }
    if (refusal) throw Diagnostic(*refusal).at(item.place);
}

} // namespace

void DeckProperties::check(const lang::BoundCommand& command, bool inside) {
    const auto& any = command.command;
    if (any.type() == typeid(lang::Restore)) restored_ = true; // the save may name any model
    if (restored_) return;
    if (command.late) {
        // Which model it names is known when it runs.
        if (any.type() == typeid(lang::JointModelCommand) || any.type() == typeid(lang::ZoneModelCommand)) open_ = true;
        return;
    }
    if (const auto* property = std::any_cast<lang::Property>(&any)) {
        given_.push_back({property->joint ? Of::joint_material : Of::material, {}, property->items, inside});
    } else if (const auto* joint = std::any_cast<lang::JointModelCommand>(&any)) {
        if (!joint->model.empty()) joint_models_.insert(joint->model);
        given_.push_back({Of::joint_model, joint->model, joint->items, inside});
    } else if (const auto* test = std::any_cast<lang::JointModelTest>(&any)) {
        joint_models_.insert(test->model);
        given_.push_back({Of::joint_model, test->model, test->items, inside});
    } else if (const auto* zone = std::any_cast<lang::ZoneModelCommand>(&any)) {
        if (zone->model == no_rock) return;
        if (!zone->model.empty()) zone_models_.insert(zone->model);
        given_.push_back({Of::zone_model, zone->model, zone->items, inside});
    }
}

void DeckProperties::check_script(std::string_view text) {
    constexpr std::array<std::string_view, 5> loading{"model", "call", "restore", "zone", "lua"};
    if (std::ranges::any_of(loading, [&](auto word) { return text.find(word) != text.npos; })) open_ = true;
}

void DeckProperties::check_item(const Given& given, const lang::Property::Item& item, JointRegistry& models) {
    if (given.of == Of::joint_model) {
        if (given.model.empty()) accepted_by_one(models.loaded(), joint_law.noun, item);
        else accepting_property(models.get(given.model), joint_law.noun, item.word, item.value);
    } else if (given.of == Of::zone_model) {
        if (given.model.empty()) accepted_by_one(models.zones.loaded(), zone_law.noun, item);
        else accepting_property(models.zones.get(given.model), zone_law.noun, item.word, item.value);
    } else {
        const auto meaning = property_meaning(models, item, given.of == Of::joint_material);
        if (meaning.block) check_value(*meaning.block, item);
        else if (meaning.zone) check_value(*meaning.zone, item);
        else if (std::ranges::any_of(models.loaded(), [&](const auto& model) {
                     return model->find_property(meaning.joint).has_value();
                 }))
            accepted_by_one(models.loaded(), joint_law.noun, {meaning.joint, item.value, item.place});
    }
}

std::vector<lang::Property::Item> DeckProperties::items_of(const Given& given, JointRegistry& models) {
    if (given.of != Of::zone_model) return given.items;
    return with_moduli(given.items, [&](const std::string& word) {
        if (!given.model.empty()) return models.zones.get(given.model).find_property(word).has_value();
        return std::ranges::any_of(models.zones.loaded(),
                                   [&](const auto& model) { return model->find_property(word).has_value(); });
    });
}

std::vector<Diagnostic> DeckProperties::findings(JointRegistry& models) const {
    std::vector<Diagnostic> found;
    // A file is loaded when its line runs, after the checks for foreign code.
    const auto is_file = [](const std::string& name) {
        const std::filesystem::path path(name);
        return path.has_parent_path() || path.has_extension();
    };
    if (open_ || given_.empty() || std::ranges::any_of(joint_models_, is_file) ||
        std::ranges::any_of(zone_models_, is_file))
        return found;
    // Loading takes longer than reading: only what the words need. A word that is unknown otherwise makes `models` load all zone models.
    const auto needs_joints = [](const Given& given) {
        return given.of != Of::zone_model && std::ranges::any_of(given.items, [&](const auto& item) {
                   return given.of != Of::material || !find_block_property(item.word);
               });
    };
    const auto needs_all_zones = [](const Given& given) { return given.of == Of::zone_model && given.model.empty(); };
    try {
        if (std::ranges::any_of(given_, needs_joints)) {
            models.get(default_joint_model(Model()));
            for (const auto& name : joint_models_) models.get(name);
        }
        for (const auto& name : zone_models_) models.zones.get(name);
        if (std::ranges::any_of(given_, needs_all_zones))
            for (const auto& name : models.zones.available()) models.zones.get(name);
    } catch (const Diagnostic&) { return found; }
    for (const auto& given : given_) {
        const auto report = [&](Diagnostic mistake, const Place& place) {
            if (given.inside) mistake.severity = Severity::warning;
            found.push_back(mistake.at(place));
        };
        try {
            for (const auto& item : items_of(given, models)) {
                try {
                    check_item(given, item, models);
                } catch (const Diagnostic& mistake) { report(mistake, item.place); }
            }
        } catch (const Diagnostic& mistake) { report(mistake, mistake.place); }
    }
    return found;
}

} // namespace kaya
