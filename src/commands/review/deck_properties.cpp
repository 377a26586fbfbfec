#include "commands/review/deck_properties.hpp"

#include "base/diagnostic.hpp"
#include "commands/review/zone_moduli.hpp"
#include "laws/given_values.hpp"
#include "mechanics/common/property_sets.hpp"

#include <algorithm>
#include <any>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace kaya {

namespace fs = std::filesystem;

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

/// Whether blocks are made with a constitutive number.
template <class... Made> bool makes_numbered(const std::any& command, lang::CommandList<Made...>) {
    const auto numbered = [](const auto* made) { return made != nullptr && made->options.constitutive != 1; };
    return (numbered(std::any_cast<Made>(&command)) || ...);
}

/// A line that may choose a model by its number.
bool is_numbered(const std::any& command) {
    const auto* change = std::any_cast<lang::Change>(&command);
    const auto* set = std::any_cast<lang::Set>(&command);
    if (makes_numbered(command, lang::ShapeCommands{})) return true;
    return (change != nullptr && (change->constitutive || change->joint_constitutive)) ||
           (set != nullptr && set->default_joint_constitutive) || command.type() == typeid(lang::Import);
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
    if (is_numbered(any)) numbered_ = true;
    if (const auto* property = std::any_cast<lang::Property>(&any)) {
        add({property->joint ? Of::joint_material : Of::material, {}, property->items, inside});
    } else if (const auto* joint = std::any_cast<lang::JointModelCommand>(&any)) {
        name_model(joint->model, false, inside, joint->model_place);
        add({Of::joint_model, joint->model, joint->items, inside});
    } else if (const auto* test = std::any_cast<lang::JointModelTest>(&any)) {
        name_model(test->model, false, inside, test->model_place);
        add({Of::joint_model, test->model, test->items, inside});
    } else if (const auto* zone = std::any_cast<lang::ZoneModelCommand>(&any)) {
        if (zone->model == no_rock) return;
        name_model(zone->model, true, inside, zone->model_place);
        add({Of::zone_model, zone->model, zone->items, inside});
    }
}

void DeckProperties::add(Given given) {
    given.models_before = named_.size();
    given_.push_back(std::move(given));
}

void DeckProperties::name_model(std::string model, bool zone, bool inside, const Place& place) {
    if (!model.empty()) named_.push_back({std::move(model), zone, inside, place});
}

void DeckProperties::check_script(std::string_view text) {
    const auto holds = [&](std::string_view word) { return text.find(word) != text.npos; };
    constexpr std::array<std::string_view, 5> loading{"model", "call", "restore", "zone", "lua"};
    const bool commands = holds("command") || holds("capture"); // of Lua; those of FISH are statements
    if (holds("restore") || (commands && std::ranges::any_of(loading, holds))) open_ = true;
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

/// Loading takes longer than reading: only what the words need. A word that is unknown otherwise makes `models` load all zone models.
bool DeckProperties::needs_joints() const {
    const auto by_joint = [](const lang::Property::Item& item) { return !find_block_property(item.word); };
    return std::ranges::any_of(named_, [](const Named& named) { return !named.zone; }) ||
           std::ranges::any_of(given_, [&](const Given& given) {
               return given.of != Of::zone_model && !given.items.empty() &&
                      (given.of != Of::material || std::ranges::any_of(given.items, by_joint));
           });
}

/// False when nothing is known of the model; a name that no file has is a finding.
bool DeckProperties::load(const Named& named, JointRegistry& models, const std::vector<fs::path>& folders,
                          std::vector<Diagnostic>& found) {
    // Libraries of 3DEC, libjmodelslip009.so, have other names than their models.
    const auto is_in = [&](const fs::path& folder) {
        std::error_code failed;
        for (const auto& entry : fs::directory_iterator(folder, failed)) {
            const std::string stem = entry.path().stem().string(), ending = entry.path().extension().string();
            if ((ending == ".so" || ending == ".lua") && (stem == named.model || stem.find("jmodel") != stem.npos))
                return true;
        }
        return false;
    };
    try {
        if (named.zone) models.zones.get(named.model);
        else models.get(named.model);
        return true;
    } catch (Diagnostic& mistake) {
        // Files in other folders are not loaded before their line runs.
        const bool unknown = mistake.code == "joint-model-unknown" || mistake.code == "zone-model-unknown";
        const bool elsewhere = std::getenv("KAYA_JOINTS") != nullptr || std::ranges::any_of(folders, is_in);
        if (unknown && !elsewhere) {
            if (named.inside) mistake.severity = Severity::warning;
            found.push_back(mistake.at(named.place));
        }
        return false;
    }
}

/// Which of the models named further down has the property.
std::string DeckProperties::early_hint(const Given& given, const std::string& word, const JointRegistry& models) const {
    for (std::size_t i = given.models_before; i < named_.size(); ++i) {
        const Named& named = named_[i];
        if (named.zone != (given.of == Of::zone_model)) continue;
        const LawTable* law = named.zone ? static_cast<const LawTable*>(models.zones.find(named.model))
                                         : static_cast<const LawTable*>(models.find(named.model));
        if (law != nullptr && law->find_property(word))
            return fmt::format("{} has it: line {} names it, and must come first", named.model, named.place.line);
    }
    const auto of_kind = [&](const Named& named) { return named.zone == (given.of == Of::zone_model); };
    const auto end = named_.begin() + static_cast<std::ptrdiff_t>(given.models_before);
    return std::any_of(named_.begin(), end, of_kind) ? "name its model on a line before this one" : "";
}

DeckProperties::Mistakes DeckProperties::mistakes_of(const Given& given, JointRegistry& models) {
    Mistakes mistakes;
    try {
        for (const auto& item : items_of(given, models)) {
            try {
                check_item(given, item, models);
                mistakes.push_back({item.word, std::nullopt});
            } catch (Diagnostic& mistake) { mistakes.push_back({item.word, mistake.at(item.place)}); }
        }
    } catch (const Diagnostic& mistake) { mistakes.push_back({{}, mistake}); }
    return mistakes;
}

std::vector<Diagnostic> DeckProperties::findings(JointRegistry& models, const std::vector<fs::path>& folders) const {
    std::vector<Diagnostic> found;
    // A file is loaded when its line runs, after the checks for foreign code.
    const auto is_file = [](const Named& named) {
        const fs::path path(named.model);
        return path.has_parent_path() || path.has_extension();
    };
    if (open_ || (given_.empty() && named_.empty()) || std::ranges::any_of(named_, is_file)) return found;
    const auto of_zones = [](const Given& given) { return given.of == Of::zone_model && given.model.empty(); };
    const bool zones = std::ranges::any_of(given_, of_zones);
    bool known = true;
    try {
        if (needs_joints()) models.get(default_joint_model(Model()));
        if (zones) models.zones.get("elastic");
    } catch (const Diagnostic&) { return found; }
    // In their order first: a property before the line that names its model is refused when it is reached.
    std::vector<Mistakes> in_order;
    std::size_t loaded = 0;
    for (const auto& given : given_) {
        for (; loaded < given.models_before; ++loaded) known = load(named_[loaded], models, folders, found) && known;
        in_order.push_back(mistakes_of(given, models));
    }
    for (; loaded < named_.size(); ++loaded) known = load(named_[loaded], models, folders, found) && known;
    if (!known) return found;
    try {
        if (zones)
            for (const auto& name : models.zones.available()) models.zones.get(name);
    } catch (const Diagnostic&) { return found; }
    const bool order_is_known = !numbered_ && std::ranges::none_of(named_, &Named::inside);
    for (std::size_t line = 0; line < given_.size(); ++line) {
        const Given& given = given_[line];
        const bool by_order = order_is_known && given.model.empty() && !given.inside &&
                              (given.of == Of::joint_model || given.of == Of::zone_model);
        for (auto& [word, mistake] : mistakes_of(given, models)) {
            const auto early = std::ranges::find(in_order[line], word, &Checked::word);
            if (by_order && early != in_order[line].end() && early->mistake) {
                // Where no model is named, another deck may have chosen one.
                const std::string hint = mistake ? early->mistake->hint : early_hint(given, word, models);
                if (mistake || !hint.empty()) mistake = early->mistake;
                if (mistake) mistake->hint = hint;
            }
            if (!mistake) continue;
            if (given.inside) mistake->severity = Severity::warning;
            found.push_back(std::move(*mistake));
        }
    }
    return found;
}

} // namespace kaya
