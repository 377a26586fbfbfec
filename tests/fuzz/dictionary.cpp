// Writes the words of the language as a dictionary of libFuzzer, one quoted word in a line.
#include "lang/commands/language.hpp"
#include "lang/fish/reserved.hpp"

#include <cstdio>
#include <set>
#include <string>

namespace {

using namespace kaya;
using Words = std::set<std::string>;

void add(Words& words, const std::vector<lang::Spelling>& spellings) {
    for (const auto& spelling : spellings) words.emplace(spelling.word);
}

void add(Words& words, const std::vector<lang::KeywordSpec>& keywords) {
    for (const auto& keyword : keywords) {
        add(words, keyword.words);
        add(words, keyword.keywords);
    }
}

} // namespace

int main() {
    Words words{"def",   "end",     "loop",       "while",     "foreach", "endloop",       "if",   "then", "else",
                "endif", "case_of", "case",       "endcase",   "section", "endsection",    "exit", "return",
                "array", "local",   "global",     "argument",  "command", "endcommand",    "continue",
                "lua",   "endlua",  "cx_nforce(", "b_extra(",  "string(", "whilestepping", "range", "@", "[", "]", "&", "...",
                "1e308", "99999999999999999999",  "-1",        "'",       "\\\"",          ";"};
    for (const auto& family : lang::classic().families)
        for (const auto& command : family.commands) {
            add(words, command.words);
            add(words, command.form);
            add(words, command.keywords);
        }
    add(words, lang::classic().range_elements);
    for (const auto& reserved : fish::reserved_names()) words.emplace(reserved.name);
    for (const auto& word : words) std::printf("\"%s\"\n", word.c_str());
    return 0;
}
