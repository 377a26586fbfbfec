// Lines whose words stand in another order in the other dialect: `copy offset 0 0 1 range id 2` and `block copy id 2 translate 0 0 1`.
#pragma once

#include "lang/interp/binder.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace kaya::lang {

/// The beginning of a line in both dialects. {a} stands for one word, '{a}' for a text in quotes, {rest} for the rest of the line. Words
/// after the beginning are exchanged one by one.
struct LineShape {
    std::string_view classic, modern;
};

/// What the beginning of a line takes of it.
struct TakenWords {
    std::size_t count = 0;
    std::map<std::string, std::string, std::less<>> values; ///< by name
};

/// Nothing when the line begins in another way. `whole` are its words in full where they are words of the tables.
std::optional<TakenWords> take_beginning(std::string_view pattern, const Statement& statement, const CommandSpec& spec,
                                         const Spelled& whole);

/// The beginning of a line with these values.
std::string write_beginning(std::string_view pattern, const TakenWords& taken);

/// Calls visit(shape) until it returns true.
void for_each_shape(const std::function<bool(const LineShape&)>& visit);

} // namespace kaya::lang
