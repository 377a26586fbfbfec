// Regular expressions. The templates of std::regex are compiled in pattern.cpp alone, since they take as long as a large file.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace kaya {

/// An ECMAScript expression; ^ and $ are ends of lines.
class Pattern {
public:
    enum class Letters { as_written, of_either_case };

    explicit Pattern(const std::string& expression, Letters letters = Letters::as_written);
    ~Pattern();

    bool matches(const std::string& text) const; ///< all of it
    bool is_in(const std::string& text) const;   ///< a part of it
    /// Group `group` of the expression at each place where it is found; 0: all that was found.
    std::vector<std::string> all(const std::string& text, std::size_t group = 0) const;

private:
    struct Expression;
    std::unique_ptr<const Expression> expression_;
};

} // namespace kaya
