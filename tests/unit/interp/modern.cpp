// The modern dialect: its lines among classic ones, and the structs that both dialects fill.
#include "bound.hpp"

#include "lang/commands/struct_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace kaya::lang {
namespace {

using testing::HasSubstr;

template <class Visit> void for_each_modern(Visit visit) {
    for_each_command(modern(), [&](const CommandSpec& command) {
        for (const auto& example : command.right) visit(command, example);
    });
}

TEST(Modern, BothSpellingsOfAMeaningFillTheSameStruct) {
    int count = 0;
    for_each_modern([&](const CommandSpec&, const Example& example) {
        if (example.classic.empty()) return;
        SCOPED_TRACE(std::string(example.text));
        ++count;
        try {
            const BoundCommand one = bound(std::string(example.text), nullptr, modern());
            const BoundCommand other = bound(std::string(example.classic), nullptr, classic());
            EXPECT_EQ(one.spec->index, other.spec->index);
            EXPECT_EQ(struct_text(one.command), struct_text(other.command));
            EXPECT_EQ(one.late, other.late);
        } catch (const Diagnostic& mistake) { ADD_FAILURE() << render(mistake); }
    });
    EXPECT_GT(count, 130);
}

TEST(Modern, DifferentLinesHaveDifferentStructs) {
    const auto text = [](const char* line) { return struct_text(bound(line).command); };
    EXPECT_NE(text("block hide range group 'a'"), text("block hide range group 'b'"));
    EXPECT_NE(text("model gravity 0 0 -9"), text("model gravity 0 0 -8"));
    EXPECT_NE(text("block gridpoint apply velocity-x 0 range id 1"),
              text("block gridpoint apply velocity-y 0 range id 1"));
    EXPECT_NE(text("block mechanical damping local 0.5"), text("block mechanical damping combined 0.5"));
    EXPECT_NE(text("history export '1'"), text("history export '2'"));
    EXPECT_NE(text("block apply velocity-x 1 table '1' range id 1"),
              text("block apply velocity-x 1 table '2' range id 1"));
}

/// Lines whose first words both dialects have, with the same meaning, are read by the classic tables.
TEST(Modern, LinesAreFoundAmongClassicOnes) {
    int modern_lines = 0;
    for_each_modern([&](const CommandSpec& command, const Example& example) {
        const BoundCommand found = bound(std::string(example.text));
        if (found.spec == &command) ++modern_lines;
        EXPECT_EQ(found.spec->index, command.index) << example.text;
        EXPECT_EQ(found.language, &language());
    });
    EXPECT_GT(modern_lines, 180);
    for_each_command(classic(), [](const CommandSpec& command) {
        for (const auto& example : command.right)
            EXPECT_EQ(bound(std::string(example.text)).spec->name(), command.name());
    });
}

TEST(Modern, WordsAreShortenedInEachPart) {
    EXPECT_EQ(bound("bl cont gen-sub").spec->name(), "block contact generate-subcontacts");
    EXPECT_EQ(bound("block mech damp global").spec->name(), "block mechanical damping");
    EXPECT_EQ(bound("mod cyc 5").spec->name(), "model cycle");
    EXPECT_EQ(bound("prog call 'a'").spec->name(), "program call");
    EXPECT_EQ(bound_as<Hide>("block hide range pos-z 0 1").range.elements.front().kind, RangeElement::Kind::z);
    EXPECT_EQ(bound("pro mat 1 dens 1").spec->name(), "property") << "a classic beginning stays one";
    EXPECT_EQ(bound("mo off").spec->name(), "movie");
}

TEST(Modern, RangesAreThoseOfTheClassicElements) {
    const auto phrase = [](const std::string& line) { return struct_text(bound_as<Hide>(line).range); };
    constexpr std::pair<const char*, const char*> same[] = {
        {"position-x 0 1", "x 0 1"},
        {"position-y 2", "y 2"},
        {"position-z 1 tolerance 0.25", "z 0.75 1.25"},
        {"position (0,0,0) (1,2,3)", "position 0 0 0 1 2 3"},
        {"position 1 1 1 tolerance 1", "position 0 0 0 2 2 2"},
        {"group 'North Wall' position-x 0 1 not", "group 'North Wall' x 0 1 not"},
        {"group 'a' slot Default matches 2", "group a matches 2"},
        {"group-intersection 'a' 'b'", "gintersection a b"},
        {"plane dip 30 dip-direction 90 origin 1 2 3 above", "plane dip 30 dd 90 origin 1 2 3 above"},
        {"plane origin 0 0 1 normal 0 0 1 distance 0.1", "plane normal 0 0 1 origin 0 0 1 distance 0.1"},
        {"cylinder end-1 0 0 0 end-2 0 0 9 radius 1 2", "cylinder end1 0 0 0 end2 0 0 9 radius 1 2"},
        {"sphere center 0 0 0 radius 2", "sphere center 0 0 0 radius 2"},
        {"id 3", "id 3"},
        {"id 3 5 union region 1", "id 3 5 union region 1"},
        {"id-list 1 4 7", "id-list 1 4 7"},
        {"joint-set 2", "jset 2"},
        {"named-range 'top'", "nrange top"},
        {"orientation dip 90 dip-direction 0", "orientation dip 90 dd 0 tolerance 2"},
        {"orientation dip 90 dip-direction 0 tolerance 5", "orientation dip 90 dd 0 tolerance 5"},
        {"volume 0 2", "volume 0 2"},
        {"deformable off", "deformable off"},
        {"extent position-x 0 1", "extent x 0 1"},
    };
    for (const auto& [modern_words, classic_words] : same)
        EXPECT_EQ(phrase(fmt::format("block hide range {}", modern_words)),
                  phrase(fmt::format("hide range {}", classic_words)))
            << modern_words;
}

TEST(Modern, MessagesNameTheWordsOfTheLine) {
    const Diagnostic slip = mistake("block gridpont apply velocity-x 0 range id 1");
    EXPECT_EQ(slip.message, "'gridpont' is not a kind of block");
    EXPECT_EQ(slip.hint, "did you mean 'gridpoint'?");
    EXPECT_EQ(mistake("blokc create brick 0 1").hint, "did you mean 'block'?");
    EXPECT_EQ(mistake("modl new").hint, "did you mean 'model'?");
    EXPECT_EQ(mistake("block hide range posit-x").message, "a number is missing after 'posit-x'");
    EXPECT_EQ(mistake("block hide range pozition-x 0 1").hint, "did you mean 'position-x'?");
    EXPECT_EQ(mistake("block hide range").hint, "write for example: range position-z 0 1");
    EXPECT_EQ(mistake("block fragment dump").message, "'block fragment' is known, but kaya does not support it yet");
    EXPECT_THAT(mistake("block").hint, HasSubstr("kaya help block"));
    EXPECT_EQ(mistake("block hide range fish 'f'").code, "not-supported-yet");
}

/// A keyword with more letters must not take the beginning of one that stands after it: `vel` for velocity-x, not for velocity.
TEST(Modern, BeginningsMeanTheShorterWord) {
    const auto check = [](const auto& self, const std::vector<KeywordSpec>& keywords,
                          const std::string& where) -> void {
        for (std::size_t i = 0; i < keywords.size(); ++i) {
            for (std::size_t later = i + 1; later < keywords.size(); ++later)
                for (const Spelling& before : keywords[i].words)
                    for (const Spelling& word : keywords[later].words)
                        EXPECT_FALSE(before.word.size() > word.word.size() && before.word.starts_with(word.word))
                            << where << ": " << before.word << " stands before " << word.word;
            self(self, keywords[i].keywords, where);
        }
    };
    for_each_command(modern(), [&](const CommandSpec& command) { check(check, command.keywords, command.name()); });
    check(check, modern().range_elements, "range");
}

} // namespace
} // namespace kaya::lang
