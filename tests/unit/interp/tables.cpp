// Tests of the tables: every right example binds, every wrong one gives exactly its message.
#include "bound.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace kaya::lang {
namespace {

/// Each test of the tables runs for both dialects.
class EachDialect : public testing::TestWithParam<const Language*> {
protected:
    const Language& dialect() const { return *GetParam(); }
    bool is_modern() const { return GetParam() == &modern(); }

    template <class Visit> void for_each_command(Visit visit) {
        for (const auto& family : dialect().families)
            for (const auto& command : family.commands) visit(command);
    }
    /// The name of a command, with a value for each that must stand before its keywords.
    static std::string begun(const CommandSpec& command) {
        std::string line = command.name();
        for (const auto& [argument, read, write] : command.arguments) {
            if (argument.optional) continue;
            const bool number = argument.kind == ArgumentKind::real || argument.kind == ArgumentKind::integer;
            for (int i = 0; i < argument.count; ++i)
                line += number ? fmt::format(" {}", i + 1) : argument.kind == ArgumentKind::text ? " 'a'" : " on";
        }
        return line;
    }
};

INSTANTIATE_TEST_SUITE_P(Tables, EachDialect, testing::Values(&classic(), &modern()),
                         [](const auto& dialect) { return dialect.param == &modern() ? "Modern" : "Classic"; });

TEST_P(EachDialect, RightExamplesBindToTheirCommand) {
    int count = 0;
    for_each_command([&](const CommandSpec& command) {
        EXPECT_EQ(command.right.empty(), command.support == Support::not_yet) << command.name() << " has no example";
        for (const auto& example : command.right) {
            ++count;
            SCOPED_TRACE(std::string(example.text));
            try {
                EXPECT_EQ(bound(std::string(example.text), nullptr, dialect()).spec, &command);
            } catch (const Diagnostic& d) { ADD_FAILURE() << render(d); }
        }
    });
    EXPECT_GT(count, 80);
}

TEST_P(EachDialect, WrongExamplesGiveTheirMessageAndPlace) {
    int count = 0;
    for_each_command([&](const CommandSpec& command) {
        for (const auto& example : command.wrong) {
            ++count;
            SCOPED_TRACE(std::string(example.text));
            const Diagnostic d = mistake(std::string(example.text), dialect());
            EXPECT_EQ(d.message, example.message);
            EXPECT_TRUE(d.place) << "no place";
            EXPECT_GE(d.place.column, 1);
            EXPECT_FALSE(d.hint.empty() && d.code.empty());
        }
    });
    EXPECT_GT(count, 80);
}

TEST_P(EachDialect, CommandsThatTakeWordsHaveWrongExamples) {
    for_each_command([](const CommandSpec& command) {
        if (command.raw || command.otherwise) return; // these accept any word
        if (command.support == Support::not_yet) return;
        if (command.arguments.empty() && command.keywords.empty()) return;
        EXPECT_FALSE(command.wrong.empty()) << command.name();
    });
}

TEST_P(EachDialect, UnsupportedCommandsSaySo) {
    int count = 0;
    for_each_command([&](const CommandSpec& command) {
        if (command.support == Support::not_yet) {
            ++count;
            const Diagnostic d = mistake(command.name() + " 1 2 &\n 3", dialect());
            EXPECT_EQ(d.message, "'" + command.name() + "' is known, but kaya does not support it yet");
            EXPECT_EQ(d.code, "not-supported-yet");
            EXPECT_NE(d.hint, "");
        }
        for (const auto& keyword : command.keywords) {
            if (keyword.support != Support::not_yet) continue;
            ++count;
            const std::string line = fmt::format("{} {}", begun(command), keyword.words.front().word);
            EXPECT_EQ(mistake(line, dialect()).code, "not-supported-yet")
                << command.name() << ' ' << keyword.words.front().word;
        }
    });
    const std::string range = is_modern() ? "block hide range position-z 0 " : "hide range z 0 ";
    for (const auto& element : dialect().range_elements)
        if (element.support == Support::not_yet) {
            ++count;
            EXPECT_EQ(mistake(range + std::string(element.words.front().word), dialect()).code, "not-supported-yet");
        }
    EXPECT_GT(count, 30);
}

TEST_P(EachDialect, EverythingIsExplained) {
    for_each_command([](const CommandSpec& command) {
        EXPECT_FALSE(command.help.empty()) << command.name();
        for (const auto& keyword : command.keywords) EXPECT_FALSE(keyword.help.empty()) << command.name();
    });
    for (const auto& element : dialect().range_elements) EXPECT_FALSE(element.help.empty());
}

/// A word that an earlier entry accepts could never be reached.
void expect_distinct(const std::vector<KeywordSpec>& keywords, const std::string& where) {
    std::set<std::string_view> seen;
    for (const auto& keyword : keywords) {
        for (const Spelling& s : keyword.words) EXPECT_TRUE(seen.insert(s.word).second) << where << ": " << s.word;
        expect_distinct(keyword.keywords, where + " " + std::string(keyword.words.front().word));
    }
}

TEST_P(EachDialect, NoWordIsListedTwice) {
    for_each_command([](const CommandSpec& command) { expect_distinct(command.keywords, command.name()); });
    expect_distinct(dialect().range_elements, "range");
}

TEST(Tables, ShortSpellingsResolveInTableOrder) {
    // Several to a line.
    // clang-format off
    const std::pair<const char*, const char*> spellings[] = {
        {"pro mat 1 k 1", "property"}, {"prop mat 1 k 1", "property"}, {"pri max", "list"},
        {"chang mat 1", "change"}, {"grav 0 0 1", "gravity"}, {"his unbal", "history"},
        {"hist unbal", "history"}, {"cyc 5", "cycle"}, {"st 5", "cycle"}, {"rest a", "restore"},
        {"ret", "return"}, {"pl block", "plot"}, {"po br 0 1", "poly brick"}, {"ge ed 1", "generate edge"},
        {"bo xv 0", "boundary"}, {"ini xv 0", "initialize"}, {"DAMP LOCAL", "damp"}, {"so", "solve"},
        {"see", "seek"}, {"sho", "seek"}, {"se dyn on", "set"}, {"del", "delete"},
        {"def f\nend", "define"}, {"jm jkn 1", "jmodel"}, {"hist wr a", "history write"},
        {"ti x", "title"},
        // Spellings of users' decks, and the shortest forms of the other commands.
        {"prop mat 1 dens 1", "property"}, {"property mat 1 density 1", "property"}, {"change mat 1", "change"},
        {"DAMP LOCAL 0.8", "damp"}, {"damp auto", "damp"}, {"cycle 1", "cycle"}, {"step 1", "cycle"},
        {"insitu str 0 0 0 0 0 0", "insitu"}, {"ins st 0 0 0 0 0 0", "insitu"}, {"bound stress 0 0 0 0 0 0", "boundary"},
        {"bou str 0 0 0 0 0 0", "boundary"}, {"app xv 1", "apply"}, {"fr", "free"}, {"free", "free"}, {"fi", "fix"},
        {"frac 0.3", "fraction"}, {"hi", "hide"}, {"hide", "hide"}, {"his wr", "history write"},
        {"hist lab 1 a", "history label"}, {"res disp", "reset"}, {"reset disp", "reset"}, {"sa a", "save"},
        {"sav a", "save"}, {"re disp", "reset"}, {"quit", "quit"}, {"qu", "quit"}, {"sto", "quit"}, {"ex", "quit"},
        {"pa", "pause"}, {"ca a", "call"}, {"ne", "new"}, {"conf dyn", "config"}, {"co", "config"},
        {"tab 1 0 0 1 1", "table"}, {"ta 1 clear", "table"}, {"js", "jset"}, {"jse dip 1", "jset"},
        {"tu a 0 0 0 1 0 0 0 1 0 b 0 0 1 1 0 1 0 1 1", "tunnel"}, {"dens 2 2 2", "densify"}, {"mar reg 1", "mark region"},
        {"joi", "join"}, {"join_c", "join_contact"}, {"fac rad8", "facetri rad8"}, {"fac rad", "facetri radial"}, {"gro bl a", "group block"},
        {"gr block a", "group block"}, {"ra na a z 0", "range name"}, {"rem", "excavate"}, {"exc", "excavate"}, {"fil", "fill"}, {"gr jo a", "group joint"},
        {"fin", "find"}, {"wat off", "water"}, {"wa off", "water"}, {"msc on", "mscale"}, {"ms on", "mscale"},
        {"sol", "solve"}, {"lis max", "list"}, {"li max", "list"}, {"print max", "list"}, {"prin max", "list"},
        {"vt wr a", "vtk write"}, {"mov on", "movie"}, {"lab a", "label"}, {"plo", "plot"},
        {"pol prism a 0 0 0 1 0 0 0 1 0 b 0 0 1 1 0 1 0 1 1", "poly prism"}, {"poly fa @a @b @c fa @a @b @d fa @a @c @d fa @b @c @d", "poly face"},
        {"imp a.stl", "import"}, {"exp a.3dgrid", "export"}, {"jmod model a", "jmodel model"},
    };
    // clang-format on
    for (const auto& [typed, meant] : spellings) {
        try {
            EXPECT_EQ(bound(typed).spec->name(), meant) << typed;
        } catch (const Diagnostic& d) { ADD_FAILURE() << typed << ": " << d.message; }
    }
}

TEST(Tables, ShortKeywordsResolveInTableOrder) {
    EXPECT_EQ(bound_as<List>("pri ma").what, List::What::extremes);
    EXPECT_EQ(bound_as<List>("list sub").what, List::What::sub_contacts);
    EXPECT_EQ(bound_as<HistoryWrite>("hist wr 1 vs 2").versus, 2);
    EXPECT_EQ(bound_as<HistoryWrite>("hist write 1 v 2 a.csv").versus, 2);
    EXPECT_EQ(bound_as<HistoryAdd>("his nc 5 unb").interval, 5);
    EXPECT_EQ(bound_as<HistoryAdd>("hist xd 0 0 0 ydisp 0 0 0 zv 0 0 0").items.size(), 3u);
    EXPECT_EQ(bound_as<Reset>("reset ti hi di ve jd").what.size(), 5u);
    EXPECT_EQ(bound_as<JointSetCommand>("jset di 1 dd 2 sp 3 nu 4 or 0 0 1 id 5 pe 0.5").number, 4);
    EXPECT_EQ(bound_as<Solve>("solve rat 1e-3 fo 1 cyc 2 ti 3 cl 4").cycles, 2);
    EXPECT_EQ(bound_as<Boundary>("bound xlo 1 yl 2 zload 3").load[1], 2.0);
    EXPECT_EQ(bound_as<Boundary>("bou str 1 2 3 4 5 6 xgr 1 0 0 0 0 0").x_gradient[0], 1.0);
    for (const char* word :
         {"jk", "jkn", "jf", "jfr", "jfric", "jfriction", "jco", "jcoh", "jte", "jten", "jdil", "zd"})
        EXPECT_EQ(bound_as<Property>("prop jmat 1 " + std::string(word) + " 1").items.size(), 1u) << word;
    for (const char* range : {"x 0 1",
                              "xr 0 1",
                              "zr 0",
                              "mat 1",
                              "reg 1",
                              "gro a",
                              "pos 0 0 0 1 1 1",
                              "bid 1",
                              "jma 1",
                              "sph c 0 0 0 r 1",
                              "cyl end1 0 0 0 end2 0 0 1 rad 1",
                              "pl di 0 dd 0 or 0 0 0 ab",
                              "un z 0 reg 1",
                              "min 1 2",
                              "rin 1 2",
                              "nr a",
                              "vol 0 1",
                              "def",
                              "ext z 0 1",
                              "ann c 0 0 0 r 1 2"})
        EXPECT_FALSE(bound_as<Hide>("hide range " + std::string(range)).range.elements.empty()) << range;
}

TEST(Tables, HyphenatedWordsAreShortenedPartByPart) {
    EXPECT_TRUE(shortens_each_part("pos-x", "position-x", '-'));
    EXPECT_TRUE(shortens_each_part("d-d", "dip-direction", '-'));
    EXPECT_TRUE(shortens_each_part("a-b-c", "a-b-c", '-'));
    EXPECT_FALSE(shortens_each_part("pos", "position-x", '-'));
    EXPECT_FALSE(shortens_each_part("pos-", "position-x", '-'));
    EXPECT_FALSE(shortens_each_part("pos-y", "position-x", '-'));
    EXPECT_FALSE(shortens_each_part("pos-x-x", "position-x", '-'));
    EXPECT_FALSE(shortens_each_part("a-b", "a-b-c", '-'));
    EXPECT_FALSE(shortens_each_part("pos-x", "position", '-'));
    using Kind = RangeElement::Kind;
    EXPECT_EQ(bound_as<Hide>("hide range pos-z 0 1").range.elements[0].kind, Kind::z);
    EXPECT_EQ(bound_as<Hide>("hide range plane d-d 90 dip 30 above").range.elements[0].kind, Kind::plane);
    EXPECT_EQ(bound_as<Hide>("hide range gr-int a b").range.elements[0].kind, Kind::group_intersection);
    EXPECT_EQ(bound_as<Solve>("solve rat-loc 1e-4").local_ratio, 1e-4);
    EXPECT_EQ(bound_as<JointSetCommand>("jset dip 30 dip-dir 90").dip_direction[0], 90.0);
    EXPECT_EQ(bound("join-c range jset 1").spec->name(), "join_contact");
}

TEST(Tables, OneLetterIsNoAbbreviation) {
    EXPECT_EQ(mistake("p mat 1").message, "'p' is ambiguous: several commands begin with it");
    EXPECT_EQ(mistake("poly b 0 1").message, "'b' is not a kind of poly");
}

} // namespace
} // namespace kaya::lang
