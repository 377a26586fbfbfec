#include "deck_lines.hpp"

#include "lang/interp/binder.hpp"
#include "lang/interp/deck.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

bool is_number(const std::string& word) {
    double value = 0;
    const char* last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), last, value);
    return error == std::errc() && end == last;
}

/// Names defined by the scenes of decks.cpp, and files that a case has or may write.
constexpr std::array names{"low",      "upper",    "out",       "here",      "block.stl", "waves.tab",
                           "part.3dd", "slip.lua", "block.msh", "block.ply", "stone.obj", "crest.pit",
                           "mohr",     "elastic",  "joints",    "zones"};
constexpr std::array symbols{"@v", "@load", "@twice(2)", "[1+1]", "@here", "[twice(3)]", "[1/0]", "@nothing"};

std::string within(const lang::Limits& limits, Chance& c) {
    const double low = std::max(limits.low, -2.0), high = std::min(limits.high, 3.0);
    if (low < high && c.heads(0.7)) return fmt::format("{:.3g}", c.between(low, high));
    const double edge = std::isfinite(limits.low) && c.heads() ? limits.low : limits.high;
    if (!std::isfinite(edge)) return plain_number(c);
    return fmt::format("{:.6g}", edge + (c.heads() ? 0 : c.heads() ? 1e-3 : -1e-3));
}

/// Commands that end a session or delete its model are rarer, because little would follow them.
double share(const lang::CommandSpec& command) {
    static constexpr std::array rare{"quit", "new", "return", "pause", "restore", "?"};
    const std::string name = command.name();
    if (std::ranges::find(rare, name) != rare.end()) return 0.05;
    return command.support == lang::Support::not_yet ? 0.05 : 1;
}

} // namespace

DeckLines::DeckLines(const lang::Language& language) : language_(language) {
    lang::for_each_command(language, [&](const lang::CommandSpec& command) {
        commands_.push_back(&command);
        for (const auto& example : command.right)
            for (const auto& word : split(std::string(example.text)))
                if (!is_number(word)) words_.push_back(word);
    });
}

std::string DeckLines::word(Chance& c) const { return c.heads(0.3) ? std::string(c.of(names)) : c.of(words_); }

std::string DeckLines::argument(const lang::ArgumentSpec& a, Chance& c, double odd) const {
    const int times = a.repeated ? 1 + c.below(4) : a.count;
    std::string text;
    for (int k = 0; k < times; ++k) {
        if (c.heads(0.2 * odd)) continue; // missing
        if (k > 0) text += ' ';
        if (c.heads(0.03)) text += c.of(symbols);
        else if (c.heads(0.2 * odd)) text += c.heads() ? odd_word(c) : word(c);
        else if (c.heads(odd)) text += odd_number(c);
        else switch (a.kind) {
            case lang::ArgumentKind::real: text += within(a.limits, c); break;
            case lang::ArgumentKind::integer: text += std::to_string(c.below(5)); break;
            case lang::ArgumentKind::text: text += word(c); break;
            case lang::ArgumentKind::on_off: text += c.heads() ? "on" : "off"; break;
            }
    }
    return text;
}

std::string DeckLines::keyword(const lang::KeywordSpec& k, Chance& c, double odd, int depth) const {
    std::string text(
        k.words[c.heads(0.8) ? 0 : static_cast<std::size_t>(c.below(static_cast<int>(k.words.size())))].word);
    for (const auto& a : k.arguments)
        if (!a.optional || c.heads()) text += ' ' + argument(a, c, odd);
    if (depth < 3)
        for (const auto& inner : k.keywords)
            if (c.heads(0.7)) text += ' ' + keyword(inner, c, odd, depth + 1);
    return text;
}

std::string DeckLines::range(const std::vector<lang::KeywordSpec>& elements, Chance& c, double odd) const {
    std::string text = " range";
    const int count = c.heads(0.1) ? 0 : 1 + c.below(3);
    for (int k = 0; k < count; ++k) text += ' ' + keyword(c.of(elements), c, odd, 0);
    return text;
}

std::string DeckLines::by_table(const lang::CommandSpec& command, Chance& c, double odd) const {
    std::string text(c.of(command.words).word);
    for (const auto& form : command.form) text += ' ' + std::string(c.of(form).word);
    for (const auto& positional : command.arguments)
        if (!positional.argument.optional || c.heads()) text += ' ' + argument(positional.argument, c, odd);
    if (!command.keywords.empty())
        for (int k = c.below(4); k > 0; --k) text += ' ' + keyword(c.of(command.keywords), c, odd, 0);
    for (const auto& a : command.otherwise_arguments)
        if (c.heads()) text += ' ' + argument(a, c, odd);
    if (command.range_elements != nullptr && c.heads()) text += range(*command.range_elements, c, odd);
    if (!command.body_end.empty()) text += fmt::format("\n  v = {}\n{}", c.heads() ? "1" : "urand", command.body_end);
    return text;
}

std::string DeckLines::by_example(const lang::CommandSpec& command, Chance& c, double odd) const {
    if (command.right.empty()) return by_table(command, c, odd);
    const std::string example(c.of(command.right).text);
    if (example.find('\n') != std::string::npos) return example;
    std::vector<std::string> words = split(example);
    for (std::string& word : words)
        if (is_number(word) && c.heads(0.5)) word = c.heads(odd) ? odd_number(c) : plain_number(c);
    if (c.heads(odd) && words.size() > 1) {
        const auto at = 1 + static_cast<std::size_t>(c.below(static_cast<int>(words.size()) - 1));
        switch (c.below(4)) {
        case 0: words.erase(words.begin() + static_cast<std::ptrdiff_t>(at)); break;
        case 1: words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), words[at]); break;
        case 2: words[at] = odd_word(c); break;
        default: words.resize(at); break;
        }
    }
    std::string text = join(words);
    if (command.range_elements != nullptr && text.find(" range") == std::string::npos && c.heads(0.3))
        text += range(*command.range_elements, c, odd);
    return text;
}

bool DeckLines::binds(const std::string& line) const {
    try {
        lang::Lexer lexer(lang::source_from_text("line", line));
        for (lang::Statement statement; lang::next_statement(language_, lexer, statement);)
            (void)lang::bind_statement(language_, statement);
        return true;
    } catch (const Diagnostic&) { return false; }
}

std::string DeckLines::any(Chance& c, double odd) const {
    const lang::CommandSpec* command = c.of(commands_);
    while (!c.heads(share(*command))) command = c.of(commands_);
    return c.heads() ? by_table(*command, c, odd) : by_example(*command, c, odd);
}

std::string DeckLines::line(Chance& c, double odd) const {
    for (int attempt = 0; attempt < 50; ++attempt) {
        std::string text = any(c, odd);
        if (odd > 0.5 || binds(text)) return text;
    }
    return "; nothing";
}

std::string DeckLines::short_line(Chance& c, double odd) const {
    for (;;)
        if (std::string text = line(c, odd); text.find('\n') == std::string::npos) return text;
}

} // namespace kaya::soak
