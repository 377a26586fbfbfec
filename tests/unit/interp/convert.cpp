// `kaya convert`: a deck in the words of the other dialect fills the same structs.
#include "bound.hpp"

#include "lang/commands/struct_text.hpp"
#include "lang/modern/convert.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <random>

namespace kaya::lang {
namespace {

using testing::HasSubstr;

constexpr const char* note = "; kept: no {} words for the command below\n";

std::string converted(const std::string& text, To to) { return convert_deck(source_from_text("deck", text), to).text; }

/// A number for each expression, by its text.
Value stand_in(const std::string& expression, const Place&) {
    std::int64_t sum = 1;
    for (const char c : expression) sum = (sum * 31 + c) % 1009;
    return Value(sum + 1);
}

/// The structs of a deck in the order of its commands; nothing when it does not bind.
std::vector<std::string> structs_of(const Source& source) {
    std::vector<std::string> structs;
    Lexer lexer(source);
    Statement statement;
    BareNames names;
    const ValueSource values = stand_in;
    while (next_statement(language(), lexer, statement)) {
        BoundCommand bound;
        try {
            bound = bind_with_names(language(), statement, names);
        } catch (const Diagnostic& problem) {
            if (problem.code != "not-supported-yet") throw;
            structs.push_back(statement.raw(0));
            continue;
        }
        names.learn(*bound.spec, statement);
        // The command that names the dialects is changed.
        if (bound.command.type() == typeid(ReadDialect)) continue;
        std::string text = fmt::format("{} {}", bound.spec->index, struct_text(bound.command));
        for (const BareName& name : bound.bare) read_as_name(statement, name);
        if (bound.late) try {
                text += struct_text(bind_statement(language(), statement, &values).command);
            } catch (const Diagnostic&) {} // an expression that must be a text
        structs.push_back(std::move(text));
        if (bound.spec->flow == Flow::leave_file) break;
    }
    return structs;
}
std::vector<std::string> structs_of(const std::string& text) { return structs_of(source_from_text("deck", text)); }

struct Counts {
    int changed = 0, kept = 0;
};

Counts expect_same_structs(const std::string& text, To to) {
    const ConvertedDeck one = convert_deck(source_from_text("deck", text), to);
    EXPECT_EQ(structs_of(one.text), structs_of(text));
    return {one.changed, static_cast<int>(one.kept.size())};
}

TEST(Convert, RightLinesOfBothDialectsHaveATwin) {
    int count = 0;
    for_each_command(modern(), [&](const CommandSpec& command) {
        for (const auto& example : command.right) {
            if (example.classic.empty()) continue;
            for (const auto& [text, to] : {std::pair{example.text, To::classic}, {example.classic, To::modern}}) {
                SCOPED_TRACE(std::string(text));
                EXPECT_EQ(expect_same_structs(std::string(text), to).kept, 0);
                ++count;
            }
        }
    });
    EXPECT_GT(count, 260);
}

/// The numbers of a right line replaced; the line itself when the numbers are out of their limits.
std::string with_other_numbers(const std::string& line, const Language& dialect, std::mt19937& random) {
    const auto words = Lexer(source_from_text("", line)).words_of_line(1);
    std::string text = line;
    for (auto word = words.rbegin(); word != words.rend(); ++word) {
        if (word->kind != WordKind::number) continue;
        const double factor = 0.5 + static_cast<double>(random() % 1000) / 1000;
        const std::string number = word->whole && word->integer != 0
                                       ? fmt::format("{}", word->integer + static_cast<std::int64_t>(random() % 9))
                                       : fmt::format("{:.6g}", word->number * factor);
        text.replace(static_cast<std::size_t>(word->place.column - 1), static_cast<std::size_t>(word->place.length),
                     number);
    }
    try {
        bound(text, nullptr, dialect);
        return text;
    } catch (const Diagnostic&) { return line; }
}

TEST(Convert, LinesWithRandomNumbersKeepTheirStructs) {
    std::mt19937 random{20261127};
    Counts all;
    int lines = 0;
    for (int round = 0; round < 10; ++round)
        for (const auto& way : {std::pair{&classic(), To::modern}, {&modern(), To::classic}})
            for_each_command(*way.first, [&](const CommandSpec& command) {
                if (!command.body_end.empty()) return;
                for (const auto& example : command.right) {
                    const std::string line = with_other_numbers(std::string(example.text), *way.first, random);
                    SCOPED_TRACE(line);
                    const Counts counts = expect_same_structs(line, way.second);
                    all.changed += counts.changed;
                    all.kept += counts.kept;
                    ++lines;
                }
            });
    EXPECT_GT(lines, 5000);
    EXPECT_GT(all.changed, lines / 3);
}

/// All decks of the tests and examples, to the other words and back.
TEST(Convert, DecksThereAndBackKeepTheirStructs) {
    namespace fs = std::filesystem;
    int decks = 0;
    for (const char* folder : {KAYA_DECKS, KAYA_EXAMPLES})
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() != ".3dd" && entry.path().extension() != ".dat") continue;
            SCOPED_TRACE(entry.path().string());
            const Source source = read_source(entry.path(), entry.path().filename().string());
            std::vector<std::string> structs;
            try {
                structs = structs_of(source);
            } catch (const Diagnostic&) { continue; } // a deck of mistakes
            ++decks;
            for (const To to : {To::modern, To::classic}) {
                const To back = to == To::modern ? To::classic : To::modern;
                const std::string there = convert_deck(source, to).text;
                EXPECT_EQ(structs_of(there), structs);
                const std::string again = converted(converted(there, back), to);
                EXPECT_EQ(structs_of(again), structs);
                EXPECT_EQ(converted(converted(again, back), to), again) << "there, back and there again";
            }
        }
    EXPECT_GT(decks, 100);
}

TEST(Convert, LayoutCommentsAndFunctionsStay) {
    const std::string deck = "; a wall\n\n  pol bri 0,1 0 1  (0 1) ; first\n"
                             "def f\n  command\n    cycle 1\n  endcommand\nend\n"
                             "bound xvel 0 &  ; on the left\n      range x -0.1 0.1\n@f\n[g = 3]\ncycle 10 ; ten\n";
    EXPECT_EQ(converted(deck, To::modern),
              "; a wall\n\n  block create brick 0,1 0 1  (0 1) ; first\n"
              "def f\n  command\n    cycle 1\n  endcommand\nend\n"
              "block gridpoint apply velocity-x 0 &  ; on the left\n      range position-x -0.1 0.1\n@f\n[g = 3]\n"
              "model cycle 10 ; ten\n");
    EXPECT_EQ(converted(converted(deck, To::modern), To::classic),
              "; a wall\n\n  poly brick 0,1 0 1  (0 1) ; first\n"
              "def f\n  command\n    cycle 1\n  endcommand\nend\n"
              "boundary xvel 0 &  ; on the left\n      range x -0.1 0.1\n@f\n[g = 3]\ncycle 10 ; ten\n");
}

/// Where words cannot be exchanged, the line is printed from its struct; comments and indentation stay.
TEST(Convert, LinesArePrintedFromTheirStructs) {
    constexpr std::pair<const char*, const char*> lines[] = {
        {"  apply xvel 1 hist table 2 range group plate ; shaken\n",
         "  block apply velocity-x 1 table '2' range group 'plate' ; shaken\n"},
        {"poly drum end1 0 0 0 end2 0 0 1 radius 0.5 0.4 group capital\n",
         "block create drum center-1 0 0 0 center-2 0 0 1 radius-2 0.4 group 'capital' radius-1 0.5\n"},
        {"initialize sxx -1e3 xgrad 10 zgrad -5 syz 7\n",
         "block zone initialize stress-xx -1000 gradient 10 0 -5 stress-yz 7\n"},
        {"bound str 0 0 0 0 1e4 0 & ; first\n  hist table 9 range z -1 1 ; second\n",
         "block face apply stress 0 0 0 0 10000 0 table '9' range position-z -1 1 ; first\n; second\n"},
        {"title\nIt's late\n", "model title 'It''s late'\n"},
        {"list block x 0 1 ; of the arch\n", "block list range position-x 0 1 ; of the arch\n"},
    };
    for (const auto& [in_classic, in_modern] : lines) {
        expect_same_structs(in_classic, To::modern);
        EXPECT_EQ(converted(in_classic, To::modern), in_modern);
    }
    EXPECT_EQ(converted("block water plane origin 0 0 10 normal 0 0 -1\n", To::classic), "water table 0 0 10\n");
    // @names and [expressions] have no value yet.
    EXPECT_EQ(converted("apply xvel @v hist table 2\n", To::modern),
              fmt::format(fmt::runtime(note), "modern") + "apply xvel @v hist table 2\n");
    // A long line is continued by the mark of its dialect.
    const std::string printed = converted(
        "poly face id 5 0 0 0 1 0 0 0 1 0 face 0 0 0 0 0 1 1 0 0 face 0 0 0 0 1 0 0 0 1 face id 6 1 0 0 0 0 1 0 1 0\n",
        To::modern);
    EXPECT_THAT(printed, HasSubstr(" ...\n     "));
    EXPECT_LT(printed.find('\n'), 130u);
    EXPECT_EQ(structs_of(converted(printed, To::classic)), structs_of(printed));
}

TEST(Convert, WordsInAnotherOrder) {
    constexpr std::pair<const char*, const char*> lines[] = {
        {"title A wall, second try", "model title 'A wall, second try'"},
        {"table 3 0 1 2.5 -4", "table '3' add 0 1 2.5 -4"},
        {"copy offset 0 @dy 0 range id 3", "block copy id 3 translate 0 @dy 0"},
        {"densify 2 1 3 join range z 0 1", "block densify segments 2 1 3 join range position-z 0 1"},
        {"import rocks.obj", "block generate from-vrml filename rocks.obj"},
        {"export wall.3dgrid range region 2", "block export filename wall.3dgrid range region 2"},
        {"vtk write final", "block vtk filename final"},
        {"list blocks range group a union z 1", "block list range group a union position-z 1"},
        {"list contacts range x 0 1", "block list contacts range position-x 0 1"},
        {"list zones range x 0 [d]", "block zone list range position-x 0 [d]"},
        {"history write wall.csv", "history export file wall.csv"},
        {"list blocks show velocity show moment range z 1", "block list velocity moment range position-z 1"},
        {"list subcontacts show force show state", "block contact list subcontacts force state"},
        {"fraction 0.4", "model mechanical timestep safety-factor 0.4"},
        {"solve fos resolution 0.02 cycles 300", "model factor-of-safety resolution 0.02 step-limit 300"},
        {"structure property 1 area 2e-4 young 1e11", "structure cable property cross-sectional-area 2e-4 young 1e11"},
        {"boundary stress 0 0 -7 0 0 0 range z 2", "block face apply stress 0 0 -7 0 0 0 range position-z 2"},
        {"water table 0 0 [h] density 1025", "block water plane normal 0 0 -1 origin 0 0 [h] density 1025"},
        {"initialize pp 5e4 zgradient -1e4", "block gridpoint initialize pore-pressure 5e4 gradient 0 0 -1e4"},
        {"set compatibility 3dec", "model compatibility 3dec"},
        {"cut geometry bed range z 0 1", "block cut geometry bed range position-z 0 1"},
    };
    for (const auto& [in_classic, in_modern] : lines) {
        EXPECT_EQ(converted(fmt::format("{} ; why\n", in_classic), To::modern), fmt::format("{} ; why\n", in_modern));
        EXPECT_EQ(converted(fmt::format("  {}\n", in_modern), To::classic), fmt::format("  {}\n", in_classic));
    }
    // The words of the other dialect that the line comes back with are another spelling.
    EXPECT_EQ(converted("damp 0.05 @f mass\n", To::modern), "block mechanical damping rayleigh 0.05 @f mass\n");
    EXPECT_EQ(converted("list hist\n", To::modern), "history list\n");
    // Lines that begin with `fish` belong to both dialects.
    EXPECT_EQ(converted("print @a @b\n", To::modern), "fish list @a @b\n");
    EXPECT_EQ(converted("set @f 3 @g 2.5\n", To::modern), "fish set @f 3 @g 2.5\n");
    EXPECT_EQ(converted("fish list @a @b\n", To::classic), "fish list @a @b\n");
    EXPECT_EQ(converted("title Temple, north row,\n", To::modern), "model title 'Temple, north row'\n");
    EXPECT_EQ(converted("title A wall's foot\n", To::modern), "model title 'A wall''s foot'\n");
    // Only one way: the values of the other line say it in another form.
    EXPECT_EQ(converted("model gravity 9.8\n", To::classic), "gravity 0 0 -9.8\n");
    EXPECT_EQ(converted("block hide on range region 1\n", To::classic), "hide range region 1\n");
    EXPECT_EQ(converted("block face apply stress-normal [p] range position-z 2\n", To::classic),
              "boundary stress [p] [p] [p] 0 0 0 range z 2\n");
}

TEST(Convert, NamesWithoutMarksGetThem) {
    const std::string deck = "def width\n  width = 2\nend\nrange name low z 0 1\npoly brick 0 width 0 1 0 1\n"
                             "hide range low\nwidth\n";
    const std::string there = converted(deck, To::modern);
    EXPECT_THAT(there, HasSubstr("block create brick 0 @width 0 1 0 1\n"));
    EXPECT_THAT(there, HasSubstr("block hide range named-range low\nwidth\n"));
}

TEST(Convert, LinesWithoutATwinStayBelowAComment) {
    const std::string deck = "block tolerance 0.01\nblock tolerance 0.02\nmodel cycle 1\nblock tolerance 0.03\n";
    const ConvertedDeck there = convert_deck(source_from_text("deck", deck), To::classic);
    const std::string above = fmt::format(fmt::runtime(note), "classic");
    EXPECT_EQ(there.text,
              above + "block tolerance 0.01\nblock tolerance 0.02\ncycle 1\n" + above + "block tolerance 0.03\n");
    ASSERT_EQ(there.kept.size(), 3u);
    EXPECT_EQ(there.kept[2].message, "classic words of 'block' are not known");
    EXPECT_EQ(there.kept[2].place.line, 4);
    EXPECT_EQ(converted(there.text, To::modern), deck) << "the comments go with the reason for them";
    EXPECT_EQ(converted(there.text, To::classic), there.text) << "and are not written twice";
}

TEST(Convert, WhatIsNotSupportedStays) {
    EXPECT_EQ(converted("block fragment compute\n", To::modern), "block fragment compute\n");
    EXPECT_EQ(converted("block fragment compute\n", To::classic),
              fmt::format(fmt::runtime(note), "classic") + "block fragment compute\n");
    EXPECT_EQ(converted("model new\nprogram return\nany thing\n", To::classic), "new\nreturn\nany thing\n");
}

TEST(Convert, ADeckOfOneDialectBecomesOneOfBoth) {
    EXPECT_EQ(converted("dialect modern\nmodel new\n", To::classic), "dialect both\nnew\n");
    EXPECT_EQ(converted("dialect classic\nnew\n", To::modern), "dialect both\nmodel new\n");
}

TEST(Convert, MistakesAreReported) {
    for (const To to : {To::modern, To::classic}) {
        EXPECT_EQ(converted("", to), "");
        EXPECT_EQ(converted("\n; only\n", to), "\n; only\n");
        try {
            converted("poly brik 0 1\nmodl new\n[a = \n", to);
            ADD_FAILURE() << "accepted";
        } catch (const DeckErrors& errors) { EXPECT_EQ(errors.all.size(), 3u); }
    }
}

} // namespace
} // namespace kaya::lang
