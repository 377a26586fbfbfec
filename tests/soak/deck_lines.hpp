// Lines of decks from the tables of the language: any command with arguments that are valid, at their limits or odd.
#pragma once

#include "values.hpp"

#include "lang/interp/spec.hpp"

#include <string>
#include <vector>

namespace kaya::soak {

class DeckLines {
public:
    explicit DeckLines(const lang::Language& language);

    /// A line, or several for a command with a body; `odd` is the fraction of intentionally wrong arguments. With 0 the line binds.
    std::string line(Chance& c, double odd) const;
    /// A line without a body, for use in scripts.
    std::string short_line(Chance& c, double odd) const;

private:
    std::string any(Chance& c, double odd) const;
    std::string by_table(const lang::CommandSpec& command, Chance& c, double odd) const;
    std::string by_example(const lang::CommandSpec& command, Chance& c, double odd) const;
    std::string argument(const lang::ArgumentSpec& a, Chance& c, double odd) const;
    std::string keyword(const lang::KeywordSpec& k, Chance& c, double odd, int depth) const;
    std::string range(const std::vector<lang::KeywordSpec>& elements, Chance& c, double odd) const;
    std::string word(Chance& c) const;
    bool binds(const std::string& line) const;

    const lang::Language& language_;
    std::vector<const lang::CommandSpec*> commands_;
    std::vector<std::string> words_; ///< of right examples, without numbers
};

} // namespace kaya::soak
