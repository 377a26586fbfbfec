// Lines of decks by the tables of the language: any command with arguments that are right, at their limits or odd.
#pragma once

#include "values.hpp"

#include "lang/interp/spec.hpp"

#include <string>
#include <vector>

namespace kaya::soak {

class DeckLines {
public:
    explicit DeckLines(const lang::Language& language);

    /// A line, or several of a command with a body; `odd` is the part of arguments that are wrong on purpose. Where there is none
    /// it binds.
    std::string line(Chance& c, double odd) const;
    /// One without a body, fit for the commands of a script.
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
    std::vector<std::string> words_; ///< of right examples that are no numbers
};

} // namespace kaya::soak
