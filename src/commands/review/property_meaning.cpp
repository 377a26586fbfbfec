#include "commands/review/property_meaning.hpp"

#include "base/diagnostic.hpp"
#include "commands/program/text_table.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

/// Joint words that every deck may use with `prop`, whatever joint model is loaded: those that the language explains, and two of joint
/// models of early versions.
const std::vector<std::string_view>& joint_words() {
    static const std::vector<std::string_view> words = [] {
        std::vector<std::string_view> list;
        for (const auto& known : lang::joint_property_words()) list.push_back(known.name);
        list.insert(list.end(), {"jphi", "jrdilation"});
        return list;
    }();
    return words;
}

/// The words of files for early versions, where no joint model has properties of these names.
using EarlyWord = std::pair<std::string_view, std::string_view>;
constexpr std::array<EarlyWord, 6> early_words{{{"kn", "jkn"},
                                                {"ks", "jks"},
                                                {"fric", "jfriction"},
                                                {"coh", "jcohesion"},
                                                {"ten", "jtension"},
                                                {"dil", "jdilation"}}};

/// A property of any zone model; the models that ship are loaded for their words.
const LawTable::Property* find_zone_property(ZoneModels& models, const std::string& word) {
    const auto among = [&](const auto& list) -> const LawTable::Property* {
        for (const auto& model : list)
            if (const auto found = model->find_property(word)) return &model->properties[*found];
        return nullptr;
    };
    if (const auto* found = among(models.loaded())) return found;
    for (const auto& name : models.available()) models.get(name);
    return among(models.loaded());
}

/// The property of blocks, such as `bcohesion`, that gives zones this one.
std::optional<lang::BlockProperty> block_property_of(const LawTable::Property& property) {
    const auto& known = lang::block_property_words();
    const auto is_name = [&](const auto& spelling) {
        return spelling.word == property.name ||
               std::ranges::find(property.aliases, spelling.word) != property.aliases.end();
    };
    const auto found =
        std::ranges::find_if(known, [&](const auto& p) { return std::ranges::any_of(p.words, is_name); });
    if (found == known.end()) return std::nullopt;
    return static_cast<lang::BlockProperty>(found - known.begin());
}

/// Letters of formulas, and the words that stand for them in a deck.
struct Symbol {
    std::string_view word, of_blocks, of_joints;
};
constexpr std::array<Symbol, 11> symbols{{{"e", "ymodulus, with pratio", ""},
                                          {"em", "ymodulus, with pratio", ""},
                                          {"emod", "ymodulus, with pratio", ""},
                                          {"nu", "pratio, with ymodulus", ""},
                                          {"v", "pratio, with ymodulus", ""},
                                          {"rho", "density", ""},
                                          {"gamma", "density: mass per volume, and not weight", ""},
                                          {"ro", "density", ""},
                                          {"phi", "bfriction for blocks, jfriction for joints", "jfriction"},
                                          {"c", "bcohesion for blocks, jcohesion for joints", "jcohesion"},
                                          {"psi", "bdilation for blocks, jdilation for joints", "jdilation"}}};

[[noreturn]] void refuse_word(const JointRegistry& models, const lang::Property::Item& item, bool joint_only) {
    std::vector<std::string_view> known = joint_words();
    known.push_back(joint_only ? "jmat" : "mat");
    if (!joint_only)
        for (const auto& property : lang::block_property_words())
            for (const auto& spelling : property.words) known.push_back(spelling.word);
    for (const auto& model : models.loaded()) {
        const auto words = model->property_words();
        known.insert(known.end(), words.begin(), words.end());
    }
    const auto near = did_you_mean(item.word, known);
    const auto symbol = std::ranges::find(symbols, std::string_view(item.word), &Symbol::word);
    const std::string_view meant = symbol == symbols.end() ? "" : joint_only ? symbol->of_joints : symbol->of_blocks;
    throw Diagnostic(
        fmt::format("'{}' is not a property of {}", item.word, joint_only ? "joints" : "blocks, nor of joints"),
        !meant.empty() ? fmt::format("write {}", meant)
        : near.empty() ? "if it belongs to a joint model, load that first: jmodel load NAME"
                       : fmt::format("did you mean '{}'?", near))
        .at(item.place);
}

} // namespace

std::optional<lang::BlockProperty> find_block_property(std::string_view word) {
    const auto& known = lang::block_property_words();
    const auto with = [&](auto fits) {
        return std::ranges::find_if(known, [&](const auto& p) { return std::ranges::any_of(p.words, fits); });
    };
    auto found = with([&](const auto& spelling) { return spelling.word == word; });
    if (found == known.end()) found = with([&](const auto& spelling) { return spelling.word.starts_with(word); });
    if (found == known.end()) return std::nullopt;
    return static_cast<lang::BlockProperty>(found - known.begin());
}

std::string_view name_of(lang::BlockProperty property) {
    return lang::block_property_words()[static_cast<std::size_t>(property)].name;
}

std::string_view whole_joint_word(std::string_view word) {
    const auto found = std::ranges::find_if(joint_words(), [&](auto known) { return known.starts_with(word); });
    return found != joint_words().end() ? *found : word;
}

bool is_joint_word(const JointRegistry& models, std::string_view word) {
    return std::ranges::any_of(joint_words(), [&](auto known) { return known.starts_with(word); }) ||
           std::ranges::any_of(models.loaded(),
                               [&](const auto& model) { return model->find_property(word).has_value(); });
}

std::string whole_property_word(std::string_view word) {
    if (const auto property = find_block_property(word)) return std::string(name_of(*property));
    const auto early = std::ranges::find(early_words, word, &EarlyWord::first);
    return std::string(whole_joint_word(early != early_words.end() ? early->second : word));
}

PropertyMeaning property_meaning(JointRegistry& models, const lang::Property::Item& item, bool joint_only) {
    if (!joint_only)
        if (const auto property = find_block_property(item.word)) return {property, nullptr, {}};
    if (is_joint_word(models, item.word)) return {{}, nullptr, item.word};
    const auto early = std::ranges::find(early_words, std::string_view(item.word), &EarlyWord::first);
    if (early != early_words.end()) return {{}, nullptr, std::string(early->second)};
    const auto* of_zones = joint_only ? nullptr : find_zone_property(models.zones, item.word);
    if (of_zones == nullptr) refuse_word(models, item, joint_only);
    if (const auto property = block_property_of(*of_zones)) return {property, nullptr, {}};
    return {{}, of_zones, {}};
}

void check_value(lang::BlockProperty property, const lang::Property::Item& item) {
    const auto& known = lang::block_property_words()[static_cast<std::size_t>(property)];
    if (known.limits.hold(item.value)) return;
    throw Diagnostic(
        fmt::format("'{}' is {}, but must be {}", item.word, number_text(item.value), known.limits_in_words))
        .at(item.place);
}

void check_value(const LawTable::Property& property, const lang::Property::Item& item) {
    if (property.holds(item.value)) return;
    throw Diagnostic(
        fmt::format("'{}' is {}, but must be {}", item.word, number_text(item.value), property.limits_in_words()))
        .at(item.place);
}

void refuse_unknown_number(const lang::Change& command) {
    if (command.constitutive && *command.constitutive > 2)
        throw Diagnostic(fmt::format("constitutive number {} means no zone model", *command.constitutive),
                         "1 is elastic, 2 is mohr-coulomb; others have names: `zone model NAME`");
}

} // namespace kaya
