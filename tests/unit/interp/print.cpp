// A struct of a command prints as a line that reads back as the same struct, to the last bit.
#include "bound.hpp"

#include "lang/commands/print.hpp"
#include "lang/commands/struct_text.hpp"

#include <array>
#include <bit>
#include <fmt/format.h>
#include <limits>
#include <random>
#include <set>

namespace kaya::lang {
namespace {

class Printed : public testing::TestWithParam<const Language*> {
protected:
    const Language& dialect() const { return *GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Dialects, Printed, testing::Values(&classic(), &modern()),
                         [](const auto& dialect) { return dialect.param == &modern() ? "Modern" : "Classic"; });

/// The struct has nothing of these lines.
const std::set<std::string_view> without_a_line = {
    "set pagination off", // without effect
    "dialect modern",     // the binder follows the line
    "dialect both",
};

TEST_P(Printed, RightLinesReadBackAsTheSameStruct) {
    int printed = 0;
    for_each_command(dialect(), [&](const CommandSpec& command) {
        for (const auto& example : command.right) {
            const BoundCommand read = bound(std::string(example.text), nullptr, dialect());
            const auto line = line_of(read.command, dialect());
            const bool wildcards = read.late && !line; // not all of its values are there
            EXPECT_EQ(line.has_value(), !without_a_line.contains(example.text) && !wildcards) << example.text;
            if (!line) continue;
            ++printed;
            EXPECT_EQ(struct_text(bound(*line, nullptr, dialect()).command), struct_text(read.command)) << *line;
        }
    });
    EXPECT_GT(printed, 300);
}

/// Lines of random words and values of the tables. Only the engine itself is used: distributions differ from one standard library to the next.
class RandomCommands {
public:
    std::string line(const CommandSpec& command) {
        std::string text = command.name();
        for (const auto& argument : command.arguments)
            if (!argument.argument.optional || pick(2) == 0) add_value(text, argument.argument);
        if (command.otherwise && pick(2) == 0)
            for (std::size_t i = pick(3); i-- > 0;)
                for (const ArgumentSpec& argument : command.otherwise_arguments) add_value(text, argument);
        add_keywords(text, command.keywords, pick(6));
        if (command.range_elements != nullptr && pick(2) == 0) {
            text += " range";
            add_keywords(text, *command.range_elements, 1 + pick(5));
        }
        return text;
    }
    std::size_t pick(std::size_t count) { return random_() % count; }

private:
    void add_keywords(std::string& text, const std::vector<KeywordSpec>& keywords, std::size_t count) {
        for (; count > 0 && !keywords.empty(); --count) {
            const KeywordSpec& keyword = keywords[pick(keywords.size())];
            if (keyword.support != Support::runs) continue;
            text += fmt::format(" {}", keyword.words.front().word);
            for (const ArgumentSpec& argument : keyword.arguments)
                if (!argument.optional || pick(2) == 0) add_value(text, argument);
            add_keywords(text, keyword.keywords, keyword.keywords.empty() ? 0 : 1 + pick(keyword.keywords.size()));
        }
    }
    void add_value(std::string& text, const ArgumentSpec& argument) {
        const std::size_t times = argument.repeated ? 3 + pick(2) : 1;
        for (std::size_t i = 0; i < times * static_cast<std::size_t>(argument.count); ++i) {
            switch (argument.kind) {
            case ArgumentKind::real: text += fmt::format(" {}", number(argument.limits)); break;
            case ArgumentKind::integer: text += fmt::format(" {}", whole(argument.limits)); break;
            case ArgumentKind::on_off: text += pick(2) == 0 ? " on" : " off"; break;
            case ArgumentKind::text: add_text(text, argument); break;
            }
        }
    }
    /// A name, or one of the alternatives of `uniform|fisher dip dd`.
    void add_text(std::string& text, const ArgumentSpec& argument) {
        std::vector<std::string> choices{""};
        for (const char c : argument.name) {
            if (c == '|') choices.emplace_back();
            else choices.back() += c;
        }
        static constexpr std::array names{"wall",  "'left wall'",        "'it''s'", "a.b-c", "'2'", "'range'", "slip",
                                          "'a;b'", "\"say \"\"no\"\"\"", "'&'",     "'[x]'", "'@y'"};
        if (choices.size() == 1 || argument.name.starts_with('@')) {
            text += fmt::format(" {}", names[pick(names.size())]);
            return;
        }
        const std::string& chosen = choices[pick(choices.size())];
        text += fmt::format(" {}", chosen.substr(0, chosen.find(' ')));
        for (const char c : chosen)
            if (c == ' ') text += fmt::format(" {}", number({.low = 1, .high = 20}));
    }
    double number(const Limits& limits) {
        static constexpr std::array values{0.0,   -0.0,   1.0,    2.0,  0.1,  1.0 / 3, -2.5, 1e-9,
                                           1e300, 1e-300, 5e-324, -1e6, 12.5, 7.25,    89.0, 0.30000000000000004};
        for (int attempt = 0; attempt < 20; ++attempt)
            if (const double value = values[pick(values.size())]; limits.hold(value)) return value;
        return 0.5 * (limits.low + limits.high);
    }
    std::int64_t whole(const Limits& limits) {
        static constexpr std::array<std::int64_t, 8> values{0, 1, 2, 3, 7, 40, 1000000, -5};
        for (int attempt = 0; attempt < 20; ++attempt)
            if (const auto value = values[pick(values.size())]; limits.hold(static_cast<double>(value))) return value;
        return 1;
    }

    std::mt19937 random_{20261128};
};

TEST_P(Printed, RandomCommandsReadBackAsTheSameStruct) {
    std::vector<const CommandSpec*> commands;
    for_each_command(dialect(), [&](const CommandSpec& command) {
        const bool of_words = command.support == Support::runs && !command.raw && command.body_end.empty();
        if (of_words && command.make().type() != typeid(ReadDialect)) commands.push_back(&command);
    });
    RandomCommands random;
    constexpr int wanted = 5000;
    int read = 0, printed = 0, tried = 0;
    for (; read < wanted && tried < 40 * wanted; ++tried) {
        const CommandSpec& command = *commands[random.pick(commands.size())];
        const std::string text = random.line(command);
        BoundCommand one;
        try {
            one = bound(text, nullptr, dialect());
        } catch (const Diagnostic&) { continue; }
        if (one.late) continue;
        ++read;
        const auto line = line_of(one.command, dialect());
        printed += line.has_value();
        EXPECT_TRUE(line) << text;
        if (!line) continue;
        EXPECT_EQ(struct_text(bound(*line, nullptr, dialect()).command), struct_text(one.command)) << *line;
    }
    EXPECT_EQ(printed, wanted);
}

TEST_P(Printed, NamesAreQuotedWhereNeeded) {
    for (const char* name : {"it's", "two words", "a\tb",   "'",        "\"",   "''",  "a;b", "range", "&",
                             "...",  "=",         "(1,2)",  "\xC3\xA9", "\x01", "nan", "inf", "1e5",   "-0",
                             "@x",   "[x",        "slot=a", "remove",   "on",   " ",   "-",   "a.b",   "5"}) {
        Group group;
        group.name = name;
        const auto line = line_of(std::any(group), dialect());
        ASSERT_TRUE(line) << name;
        const BoundCommand read = bound(*line, nullptr, dialect());
        EXPECT_EQ(std::any_cast<const Group&>(read.command).name, name) << *line;
    }
    for (const char* name : {"", "two\nlines", "a\rb"}) {
        Group group;
        group.name = name;
        EXPECT_FALSE(line_of(std::any(group), dialect())) << name;
    }
    Group with_nul;
    with_nul.name = std::string("a\0b", 3);
    EXPECT_FALSE(line_of(std::any(with_nul), dialect()));
}

TEST_P(Printed, NumbersKeepTheirBits) {
    using Numbers = std::numeric_limits<double>;
    for (const double value :
         {0.0, -0.0, 1.0, 0.1 + 0.2, 1 / 3.0, 1e22, 1e23, 123456789012345680.0, Numbers::max(), Numbers::lowest(),
          Numbers::min(), Numbers::denorm_min(), Numbers::epsilon(), 5e-5, 1e100, 1e-100}) {
        const auto line = line_of(std::any(Gravity{Vec3(value, -value, 1)}), dialect());
        ASSERT_TRUE(line) << value;
        const auto read = std::any_cast<Gravity>(bound(*line, nullptr, dialect()).command);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(read.value.x()), std::bit_cast<std::uint64_t>(value)) << *line;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(read.value.y()), std::bit_cast<std::uint64_t>(-value)) << *line;
    }
    for (const double value : {Numbers::infinity(), -Numbers::infinity(), Numbers::quiet_NaN()})
        EXPECT_FALSE(line_of(std::any(Gravity{Vec3(0, value, 0)}), dialect()));
}

TEST(Print, LinesAreAsUsersWriteThem) {
    constexpr std::array<std::array<const char*, 3>, 9> lines{{
        {"boundary xvelocity 0.001 hist sin 5 2 ra z 0 .1", "boundary xvel 0.001 hist sine 5 2 range z 0 0.1", "none"},
        {"solve ratio 1e-5 and cyc 100", "solve ratio 1e-5 and cycles 100", "model solve ratio 1e-5 and cycles 100"},
        {"title 'A wall'", "title 'A wall'", "model title 'A wall'"},
        {"poly region 0 brick (0,1) (0,1) (0,2) group a", "poly brick 0 1 0 1 0 2 group a",
         "block create brick 0 1 0 1 0 2 group 'a'"},
        {"hide mat 1 not union plane dip 30 dd 90 org 0 0 1 above",
         "hide range union material 1 not plane dip 30 dd 90 origin 0 0 1 above",
         "block hide range union bmaterial 1 not plane dip 30 dd 90 origin 0 0 1 above"},
        {"group block left slot side", "group block 'side=left'", "block group 'side=left'"},
        {"water table 0 0 5", "water table 0 0 5", "block water plane origin 0 0 5"},
        {"densify 2 2 1", "densify 2 2 1", "block densify segments 2 2 1"},
        {"damp local", "damp local", "block mechanical damping local"},
    }};
    for (const auto& [text, in_classic, in_modern] : lines) {
        const std::any command = bound(text).command;
        EXPECT_EQ(line_of(command, classic()).value_or("none"), in_classic);
        EXPECT_EQ(line_of(command, modern()).value_or("none"), in_modern);
    }
}

} // namespace
} // namespace kaya::lang
