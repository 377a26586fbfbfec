#include "study/toml_section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace {

/// The keys in the order of the file: toml++ keeps them sorted by name.
std::vector<std::pair<const toml::key*, const toml::node*>> in_order(const toml::table& table) {
    std::vector<std::pair<const toml::key*, const toml::node*>> all;
    for (const auto& [key, value] : table) all.emplace_back(&key, &value);
    std::ranges::sort(all, [](const auto& one, const auto& other) {
        const auto a = one.first->source().begin, b = other.first->source().begin;
        return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    return all;
}

Place place_in(const std::shared_ptr<const SourceText>& source, const toml::source_region& region) {
    Place place{source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 1};
    if (region.end.line == region.begin.line && region.end.column > region.begin.column)
        place.length = static_cast<int>(region.end.column - region.begin.column);
    return place;
}

const char* kind_of(const toml::node& node) {
    if (node.is_string()) return "a text";
    if (node.is_boolean()) return "true or false";
    if (node.is_number()) return "a number";
    if (node.is_array()) return "a list";
    if (node.is_table()) return "a table";
    return "a date";
}

/// The end of the text in quotes, or of the comment, that begins at `at`; `at` itself where none does. Texts in one quote have no escapes.
std::size_t end_of_free_text(std::string_view text, std::size_t at) {
    if (text[at] == '#') return std::min(text.find('\n', at), text.size());
    if (text[at] != '"' && text[at] != '\'') return at;
    const std::string_view longer = text[at] == '"' ? R"(""")" : "'''";
    const bool many_lines = text.substr(at).starts_with(longer);
    const std::string_view quote = many_lines ? longer : longer.substr(0, 1);
    std::size_t end = at + quote.size();
    while (end < text.size() && !text.substr(end).starts_with(quote)) {
        if (text[end] == '\n' && !many_lines) return end;
        end += quote[0] == '"' && text[end] == '\\' ? 2 : 1;
    }
    return std::min(end + quote.size(), text.size());
}

/// TOML has letters beyond ASCII in quotes and comments only, and toml++ is not defined for some of them elsewhere.
void refuse_letters_outside_quotes(const std::shared_ptr<const SourceText>& source, std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    for (std::size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; at < text.size();) {
        if (const std::size_t end = end_of_free_text(text, at); end > at) {
            at = end;
            continue;
        }
        if (static_cast<unsigned char>(text[at]) >= 0x80) {
            const std::string_view before = text.substr(0, at);
            const auto line = std::ranges::count(before, '\n');
            const auto column = before.size() - (before.rfind('\n') + 1);
            throw Diagnostic("this is not valid TOML: a character that is not ASCII stands outside of quotes",
                             "names and texts with such characters stand in quotes")
                .at({source, static_cast<int>(line) + 1, static_cast<int>(column) + 1, 1});
        }
        ++at;
    }
}

} // namespace

std::shared_ptr<const SourceText> source_of(const std::string& name, const std::string& text) {
    auto source = std::make_shared<SourceText>();
    source->name = name;
    source->is_file = true;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        source->lines.push_back(line);
    }
    return source;
}

toml::table parse_toml(const std::shared_ptr<const SourceText>& source, const std::string& text) {
    refuse_letters_outside_quotes(source, text);
    try {
        return toml::parse(text, source->name);
    } catch (const toml::parse_error& error) {
        std::string said(error.description());
        throw Diagnostic(fmt::format("this is not valid TOML: {}", said),
                         "strings stand in quotes, lists in [ ], tables begin with [name]")
            .at(place_in(source, error.source()));
    }
}

TomlSection::TomlSection(const toml::table& table, std::shared_ptr<const SourceText> source, std::string name,
                         Place place)
    : table_(&table), source_(std::move(source)), name_(std::move(name)), place_(std::move(place)) {}

void TomlSection::fail(const Place& place, const std::string& message, const std::string& hint) const {
    throw Diagnostic(message, hint).at(place);
}

Place TomlSection::place_of(const toml::node& node) const { return place_in(source_, node.source()); }

Place TomlSection::place_of(std::string_view key) const {
    for (const auto& [name, value] : *table_)
        if (name == key) return place_in(source_, name.source());
    return place_;
}

const toml::node* TomlSection::find(std::string_view key) {
    known_.emplace_back(key);
    return table_->get(key);
}

std::optional<double> TomlSection::number(std::string_view key) {
    const auto* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<double>();
    if (!node->is_number() || !value || !std::isfinite(*value))
        fail(place_of(*node), fmt::format("expected a number for '{}', found {}", key, kind_of(*node)));
    return value;
}

std::optional<std::int64_t> TomlSection::count(std::string_view key) {
    const auto* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < 0)
        fail(place_of(*node), fmt::format("'{}' must be a whole number that is not negative", key));
    return value;
}

std::optional<std::string> TomlSection::text(std::string_view key) {
    const auto* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_string())
        fail(place_of(*node), fmt::format("expected a text for '{}', found {}", key, kind_of(*node)));
    return node->value<std::string>();
}

std::optional<TomlSection> TomlSection::section(std::string_view key) {
    const auto* node = find(key);
    if (node == nullptr) return std::nullopt;
    return section_of(std::string(key), *node);
}

TomlSection TomlSection::section_of(const std::string& key, const toml::node& value) const {
    if (!value.is_table())
        fail(place_of(value), fmt::format("expected a table for '{}', found {}", key, kind_of(value)),
             fmt::format("write {} = {{ ... }}", key));
    return TomlSection(*value.as_table(), source_, key, place_of(key));
}

std::string TomlSection::hint_for_missing(std::string_view key, std::string otherwise) const {
    for (const auto& [name, value] : *table_)
        if (!did_you_mean(name.str(), {key}).empty()) return fmt::format("did you mean '{}' by '{}'?", key, name.str());
    return otherwise;
}

double TomlSection::needed_number(std::string_view key) {
    const auto value = number(key);
    if (!value)
        fail(place_, fmt::format("'{}' needs '{}'", name_, key),
             hint_for_missing(key, fmt::format("write {} = ...", key)));
    return *value;
}

std::string TomlSection::needed_text(std::string_view key) {
    const auto value = text(key);
    if (!value)
        fail(place_, fmt::format("'{}' needs '{}'", name_, key),
             hint_for_missing(key, fmt::format("write {} = ...", key)));
    return *value;
}

void TomlSection::each(const std::function<void(const std::string&, const toml::node&)>& use) {
    for (const auto& [key, value] : in_order(*table_)) {
        known_.emplace_back(key->str());
        use(std::string(key->str()), *value);
    }
}

void TomlSection::finish() const {
    for (const auto& [key, value] : in_order(*table_)) {
        if (std::ranges::find(known_, key->str()) != known_.end()) continue;
        const std::vector<std::string_view> candidates(known_.begin(), known_.end());
        const auto near = did_you_mean(key->str(), candidates);
        fail(place_in(source_, key->source()),
             fmt::format("{} has no '{}'", name_.empty() ? "a study" : "'" + name_ + "'", key->str()),
             near.empty() ? fmt::format("known are {}", fmt::join(known_, ", "))
                          : fmt::format("did you mean '{}'?", near));
    }
}

} // namespace kaya
