// Words of a line that is printed from the struct of a command.
#pragma once

#include "lang/interp/value.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

struct PrintedWord {
    std::string text;
    bool name = false; ///< a text of the user, in quotes where the line needs them
};
using PrintedWords = std::vector<PrintedWord>;

/// Words that may follow in a line, and the struct after they are read.
struct Wording {
    PrintedWords words;
    std::shared_ptr<void> after;
};

/// Wordings that lead from the present struct towards the wanted one; none when the words cannot say it.
using Write = std::function<std::vector<Wording>(const void* wanted, const void* present)>;

/// Adds the words of a value, which read back to the last bit. False when no line holds it: infinity, NaN, an empty text.
bool print_value(PrintedWords& to, double value);
bool print_value(PrintedWords& to, std::int64_t value);
bool print_value(PrintedWords& to, bool value);
bool print_value(PrintedWords& to, const std::string& value);
bool print_value(PrintedWords& to, const Vec3& value);
template <std::size_t size> bool print_value(PrintedWords& to, const std::array<double, size>& values) {
    for (const double value : values)
        if (!print_value(to, value)) return false;
    return true;
}
/// A value whose kind is read from its form: 2.0 is a number and 2 a whole one.
bool print_any(PrintedWords& to, const Value& value);

/// The words with blanks between them. Names are in quotes, or only where a bare word would not do.
std::string joined(const PrintedWords& words, bool quote_all_names);

} // namespace kaya::lang
