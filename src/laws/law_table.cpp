#include "laws/law_table.hpp"

#include "base/abbreviation.hpp"
#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "laws/property_roles.hpp"
#include "system/crash_report.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <sstream>

namespace kaya {

const LawKind joint_law{"joint model", "kaya_joint_model",    "kaya/jmodel.h",
                        "joint-model", KAYA_JMODEL_INTERFACE, KAYA_JMODEL_OLDEST};
const LawKind zone_law{"zone model", "kaya_zone_model", "kaya/zmodel.h", "zone-model", KAYA_ZMODEL_INTERFACE, 1};

namespace {

std::string text_or_empty(const char* text) { return text ? text : ""; }

std::vector<std::string> words_of(const char* text) {
    std::istringstream stream(text_or_empty(text));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// Decks fold case and split at blanks, so any other word could never be typed.
bool is_keyword(std::string_view word) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    return !word.empty() && word.front() >= 'a' && word.front() <= 'z' &&
           std::all_of(word.begin(), word.end(), allowed);
}

/// Size of a descriptor of its interface version: new members are only added at the end.
std::size_t size_of_version(const kaya_jmodel& d) {
    return d.interface_version == 2 ? offsetof(kaya_jmodel, fields) : sizeof d;
}
std::size_t size_of_version(const kaya_zmodel& d) { return sizeof d; }

std::uint32_t reduction_of(const kaya_jproperty&) { return KAYA_ZREDUCE_NONE; }
std::uint32_t reduction_of(const kaya_zproperty& p) { return p.reduction; }

constexpr std::uint32_t roles_since = 4; // interface version: in older tables these bytes are padding

/// KAYA_JROLE_BY_NAME where the table states no role.
std::uint32_t stated_role(const kaya_jmodel& d, const kaya_jproperty& p) {
    return d.interface_version < roles_since ? 0 : p.role;
}
std::uint32_t stated_role(const kaya_zmodel&, const kaya_zproperty&) { return KAYA_JROLE_NONE; }

/// The words of a table with their properties, and conflicts between them.
struct Words {
    std::map<std::string, std::string> owner; ///< word -> property

    std::string add(const std::string& property, const std::string& word) {
        if (!is_keyword(word))
            return fmt::format(
                "'{}' cannot be typed as a property: use lower-case letters, digits, hyphens and underscores, "
                "a letter first",
                word);
        const auto [place, is_new] = owner.emplace(word, property);
        return is_new ? "" : fmt::format("the word '{}' stands for '{}' and for '{}'", word, place->second, property);
    }
};

std::string repeated(std::vector<std::string> names, const char* things) {
    std::sort(names.begin(), names.end());
    const auto other = std::adjacent_find(names.begin(), names.end());
    return other == names.end() ? "" : fmt::format("it has two {} named '{}'", things, *other);
}

} // namespace

void LawTable::refuse(const LawKind& kind, const std::string& what) const {
    Diagnostic error(
        fmt::format("the table of {} {} is wrong: {}", kind.noun, file.string(), what),
        fmt::format("correct the descriptor that {}() returns and build the library again", kind.entry_point));
    error.code = fmt::format("{}-table", kind.code);
    throw error;
}

template <class Descriptor> Descriptor LawTable::understood(const LawKind& kind, const Descriptor* d) const {
    if (!d) refuse(kind, fmt::format("{}() returned NULL", kind.entry_point));
    if (d->interface_version < kind.oldest_version || d->interface_version > kind.interface_version) {
        const bool newer = d->interface_version > kind.interface_version;
        Diagnostic error(fmt::format("{} {} was built for interface version {}, this program has version {}", kind.noun,
                                     file.string(), d->interface_version, kind.interface_version),
                         newer ? "use a newer program, or build the model with the header of this one"
                               : fmt::format("build the model again with the {} of this program", kind.header));
        error.code = fmt::format("{}-version", kind.code);
        throw error;
    }
    const std::size_t size = size_of_version(*d);
    if (d->size != size) refuse(kind, fmt::format("its size is {} bytes, it must be {}", d->size, size));
    Descriptor copy{};
    std::memcpy(&copy, d, size);
    return copy;
}

template <class Descriptor> void LawTable::read_table(const LawKind& kind, const Descriptor& d) {
    const auto refuse_if = [&](const std::string& complaint) {
        if (!complaint.empty()) refuse(kind, complaint);
    };
    struct Count {
        const char* things;
        std::size_t count, maximum;
        const void* table;
    };
    for (const Count& c : {Count{"properties", d.property_count, KAYA_JMODEL_MAX_PROPERTIES, d.properties},
                           Count{"history variables", d.history_count, KAYA_JMODEL_MAX_HISTORY, d.history}}) {
        if (c.count > c.maximum)
            refuse(kind, fmt::format("it has {} {}, {} at most are possible", c.count, c.things, c.maximum));
        if (c.count > 0 && !c.table) refuse(kind, fmt::format("it says {} {} but gives no table", c.count, c.things));
    }
    name = d.name;
    title = text_or_empty(d.title);
    version = text_or_empty(d.version);
    if (!is_keyword(name))
        refuse(kind,
               fmt::format("'{}' cannot be typed as the name of a {}: use lower-case letters, digits, hyphens and "
                           "underscores, a letter first",
                           name, kind.noun));
    who_ = called(name, file.string(), kind.noun);
    for (std::size_t i = 0; i < d.property_count; ++i) {
        const auto& p = d.properties[i];
        if (!p.name) refuse(kind, fmt::format("property {} has no name", i + 1));
        if (std::isnan(p.minimum) || std::isnan(p.maximum) || p.minimum > p.maximum)
            refuse(kind, fmt::format("the limits of property '{}' are {} and {}", p.name, p.minimum, p.maximum));
        if (p.initial < p.minimum || p.initial > p.maximum)
            refuse(kind, fmt::format("the initial value of property '{}' is {}, outside its limits {} and {}", p.name,
                                     p.initial, p.minimum, p.maximum));
        const std::uint32_t role = stated_role(d, p);
        if (role > KAYA_JROLE_STRENGTH_FACTOR)
            refuse(kind, fmt::format("the role of property '{}' is {}, which means nothing", p.name, role));
        properties.push_back(
            {p.name, words_of(p.aliases), text_or_empty(p.unit), text_or_empty(p.help), p.initial, p.minimum, p.maximum,
             p.optional != 0, reduction_of(p),
             role == KAYA_JROLE_BY_NAME ? role_by_name(p.name, text_or_empty(p.unit)) : static_cast<kaya_jrole>(role)});
    }
    Words words;
    for (const auto& property : properties) {
        refuse_if(words.add(property.name, property.name));
        for (const auto& alias : property.aliases) refuse_if(words.add(property.name, alias));
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < d.history_count; ++i) {
        const auto& h = d.history[i];
        if (!h.name) refuse(kind, fmt::format("history variable {} has no name", i + 1));
        history.push_back({h.name, text_or_empty(h.unit), text_or_empty(h.help)});
        names.push_back(h.name);
    }
    refuse_if(repeated(names, "history variables"));
    states = words_of(d.state_names);
    if (states.size() > KAYA_JMODEL_MAX_STATES)
        refuse(kind, fmt::format("it has {} states, {} at most are possible", states.size(), KAYA_JMODEL_MAX_STATES));
    refuse_if(repeated(states, "states"));
}

template kaya_jmodel LawTable::understood(const LawKind&, const kaya_jmodel*) const;
template kaya_zmodel LawTable::understood(const LawKind&, const kaya_zmodel*) const;
template void LawTable::read_table(const LawKind&, const kaya_jmodel&);
template void LawTable::read_table(const LawKind&, const kaya_zmodel&);

std::string LawTable::Property::limits_in_words() const {
    if (std::isinf(maximum)) return std::isinf(minimum) ? "a number" : fmt::format("at least {:.6g}", minimum);
    if (std::isinf(minimum)) return fmt::format("at most {:.6g}", maximum);
    return fmt::format("from {:.6g} to {:.6g}", minimum, maximum);
}

std::vector<std::string_view> LawTable::property_words() const {
    std::vector<std::string_view> words;
    for (const auto& p : properties) {
        words.push_back(p.name);
        words.insert(words.end(), p.aliases.begin(), p.aliases.end());
    }
    return words;
}

std::optional<std::size_t> LawTable::find_property(std::string_view typed) const {
    const std::string word = lower_case(typed);
    if (word.empty()) return std::nullopt;
    std::optional<std::size_t> beginning;
    bool ambiguous = false;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        const auto& p = properties[i];
        const auto is_word = [&](const std::string& name_) { return name_ == word; };
        const auto begins = [&](const std::string& name_) {
            return name_.starts_with(word) || shortens_each_part(word, name_, '-');
        };
        if (is_word(p.name) || std::any_of(p.aliases.begin(), p.aliases.end(), is_word)) return i;
        if (!begins(p.name) && std::none_of(p.aliases.begin(), p.aliases.end(), begins)) continue;
        // `frict` is friction, not friction-residual.
        if (beginning && p.name.starts_with(properties[*beginning].name)) continue;
        ambiguous = ambiguous || (beginning && !properties[*beginning].name.starts_with(p.name));
        beginning = i;
    }
    return ambiguous ? std::nullopt : beginning;
}

std::vector<std::string> LawTable::missing(const std::vector<double>& values) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (std::isnan(values[i]) && !properties[i].optional) names.push_back(properties[i].name);
    return names;
}

} // namespace kaya
