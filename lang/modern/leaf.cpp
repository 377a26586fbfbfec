#include "lang/modern/leaf.hpp"

#include "lang/commands/list_subjects.hpp"
#include "lang/interp/binder.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// Cuts the text before the separator off, and the separator.
std::string_view take_part(std::string_view& text, char separator) {
    const auto end = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return part;
}

/// Letters that are enough for a word; fewer would be those of classic commands.
Spelling spelling(std::string_view word, bool first) {
    if (first && word == "model") return {word, 3};
    if (first && word == "program") return {word, 4};
    // `generate` is not short for generate-new: hyphens are typed.
    if (const auto hyphen = word.find('-'); hyphen != word.npos) return {word, hyphen + 2};
    return {word, 2};
}

} // namespace

std::vector<std::vector<Spelling>> tree_words(std::string_view words) {
    std::vector<std::vector<Spelling>> all;
    while (!words.empty()) {
        std::string_view alternatives = take_part(words, ' ');
        std::vector<Spelling> spellings;
        while (!alternatives.empty()) spellings.push_back(spelling(take_part(alternatives, '|'), all.empty()));
        all.push_back(std::move(spellings));
    }
    return all;
}

const CommandSpec& classic_command(std::string_view name) {
    const CommandSpec* found = nullptr;
    for_each_command(classic(), [&](const CommandSpec& command) {
        if (found == nullptr && command.name() == name) found = &command;
    });
    if (found == nullptr) throw std::logic_error(fmt::format("there is no classic command '{}'", name));
    return *found;
}

const KeywordSpec& classic_keyword(const CommandSpec& command, std::string_view word) {
    for (const KeywordSpec& keyword : command.keywords)
        for (const Spelling& s : keyword.words)
            if (s.word == word) return keyword;
    throw std::logic_error(fmt::format("'{}' has no keyword '{}'", command.name(), word));
}

CommandSpec ignored_line(std::string_view words, std::string_view help, const char* instead, std::string_view example) {
    Leaf<Ignored> leaf(words);
    leaf.help(help).raw().support(Support::ignored);
    leaf.whole_line([](const Ignored& command) { return command.word; });
    std::string name;
    for (const auto& spellings : tree_words(words))
        name += (name.empty() ? "" : " ") + std::string(spellings.front().word);
    leaf.start([name, instead](const Statement&, Ignored& command) { command = {name, instead}; });
    leaf.right(example);
    return leaf;
}

void add_subjects(Leaf<List>& leaf, List::What what) {
    for (const ListSubject& subject : list_subjects(what)) {
        leaf.action(
            tree_words(subject.word).front(),
            [word = subject.word](List& command) { command.subjects.emplace_back(word); }, subject.help);
        leaf.said(fmt::format("show {}", subject.word));
    }
    using enum List::What;
    if (!list_subjects(what).empty()) leaf.no_effect("information", "the usual columns");
    if (what == contacts) leaf.no_effect("summary|total|face|face-face|edges|common-plane", "the usual columns");
    if (what == faces) leaf.no_effect("check|rigid", "the usual columns");
    constexpr std::string_view none = "values that kaya does not have";
    if (what == blocks) leaf.not_yet({"wall", "at-v", "brick", "profile", "water-table"}, none);
    if (what == gridpoints) leaf.not_yet({"stress", "temperature", "join", "density-scaling-factor"}, none);
    if (what == zones) leaf.not_yet({"displacement", "ratio", "fluid", "thermal"}, none);
}

CommandSpec list_line(std::string_view words, List::What what, std::string_view help, std::string_view example,
                      std::string_view classic, Example wrong) {
    Leaf<List> leaf(words);
    leaf.means(classic.substr(0, std::min(classic.find(" range"), classic.find(" show")))).help(help);
    leaf.start([what](const Statement&, List& command) { command.what = what; });
    add_subjects(leaf, what);
    leaf.ranged(&List::range);
    leaf.right(example, classic);
    if (!wrong.text.empty()) leaf.wrong(wrong.text, wrong.message);
    return leaf;
}

CommandSpec unsupported_line(std::string_view words, std::string_view about) {
    Leaf<NotSupportedYet> leaf(words);
    leaf.help(about).support(Support::not_yet);
    return leaf;
}

} // namespace kaya::lang
