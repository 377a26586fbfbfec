// A table of a TOML file that is read key by key: each mistake is reported with its place, and so are unknown keys.
#pragma once

#include "base/diagnostic.hpp"

// Its assertions fail for some wrong texts, for which it has messages as well.
#define TOML_ASSERT(expr) static_cast<void>(expr)
#define TOML_ENABLE_FORMATTERS 1
#include <toml++/toml.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Throws Diagnostic where the text is not valid TOML.
toml::table parse_toml(const std::shared_ptr<const SourceText>& source, const std::string& text);

/// The text as lines that messages can show.
std::shared_ptr<const SourceText> source_of(const std::string& name, const std::string& text);

class TomlSection {
public:
    /// `name` is how messages call it: "[design]".
    TomlSection(const toml::table& table, std::shared_ptr<const SourceText> source, std::string name, Place place);

    const std::string& name() const { return name_; }
    const Place& place() const { return place_; }
    Place place_of(std::string_view key) const;
    Place place_of(const toml::node& node) const;

    /// The value of a key, which is then known; nullptr when it is missing.
    const toml::node* find(std::string_view key);
    /// Throw Diagnostic when the value is of another kind.
    std::optional<double> number(std::string_view key);
    std::optional<std::int64_t> count(std::string_view key); ///< whole and not negative
    std::optional<std::string> text(std::string_view key);
    std::optional<TomlSection> section(std::string_view key);
    /// The same, and when it is not there.
    double needed_number(std::string_view key);
    std::string needed_text(std::string_view key);

    /// Calls for each key in the order of the file; all keys are then known.
    void each(const std::function<void(const std::string& key, const toml::node& value)>& use);
    /// The section of a value that was found by `each`.
    TomlSection section_of(const std::string& key, const toml::node& value) const;

    /// Throws Diagnostic at the first unknown key.
    void finish() const;

    /// What to write for a key that is not there: the key of nearly this name may be meant.
    std::string hint_for_missing(std::string_view key, std::string otherwise) const;
    [[noreturn]] void fail(const Place& place, const std::string& message, const std::string& hint = {}) const;

private:
    const toml::table* table_;
    std::shared_ptr<const SourceText> source_;
    std::string name_;
    Place place_;
    std::vector<std::string> known_;
};

} // namespace kaya
