#include "base/pattern.hpp"

#include <regex>

namespace kaya {

struct Pattern::Expression {
    std::regex regex;
};

namespace {

std::regex::flag_type flags(Pattern::Letters letters) {
    const auto always = std::regex::ECMAScript | std::regex::multiline;
    return letters == Pattern::Letters::of_either_case ? always | std::regex::icase : always;
}

} // namespace

Pattern::Pattern(const std::string& expression, Letters letters)
    : expression_(std::make_unique<const Expression>(Expression{std::regex(expression, flags(letters))})) {}

Pattern::~Pattern() = default;

bool Pattern::matches(const std::string& text) const { return std::regex_match(text, expression_->regex); }

bool Pattern::is_in(const std::string& text) const { return std::regex_search(text, expression_->regex); }

std::vector<std::string> Pattern::all(const std::string& text, std::size_t group) const {
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), expression_->regex), end; at != end; ++at)
        found.push_back((*at)[group].str());
    return found;
}

} // namespace kaya
