#include "base/diagnostic.hpp"
#include "base/nearest_words.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace {

using namespace kaya;

/// A deck of one line.
Place place_in(std::string line, int column, int length) {
    auto source = std::make_shared<SourceText>();
    source->name = "tunnel.3dd";
    source->lines = {std::move(line)};
    return {source, 1, column, length};
}

Diagnostic unknown_word(Place place) {
    Diagnostic d("'brik' is not a kind of poly", "did you mean 'brick'?");
    d.at(std::move(place));
    return d;
}

TEST(Render, ShowsFileLineColumnAndUnderline) {
    EXPECT_EQ(render(unknown_word(place_in("poly brik 0,1", 6, 4))),
              "tunnel.3dd:1:6: error: 'brik' is not a kind of poly\n"
              "     1 | poly brik 0,1\n"
              "       |      ^^^^ did you mean 'brick'?");
}

TEST(Render, WithoutAPlaceTheHintIsPrintedBelow) {
    EXPECT_EQ(render(Diagnostic("the disk is full", "free some space")), "error: the disk is full\n  free some space");
}

TEST(Render, ContextLinesFollow) {
    Diagnostic d("the stress is not a number");
    d.add("contact 3").add("cycle 20");
    EXPECT_EQ(render(d), "error: the stress is not a number\n  contact 3\n  cycle 20");
}

TEST(Render, TabsKeepTheUnderlineBelowItsWord) {
    EXPECT_EQ(render(unknown_word(place_in("\tpoly\tbrik", 7, 4))),
              "tunnel.3dd:1:7: error: 'brik' is not a kind of poly\n"
              "     1 | \tpoly\tbrik\n"
              "       | \t    \t^^^^ did you mean 'brick'?");
}

// Two bytes, one column on the screen.
TEST(Render, UmlautTakesOneColumn) {
    EXPECT_EQ(render(unknown_word(place_in("title \xC3\xBC x brik", 12, 4))),
              "tunnel.3dd:1:12: error: 'brik' is not a kind of poly\n"
              "     1 | title \xC3\xBC x brik\n"
              "       |           ^^^^ did you mean 'brick'?");
}

TEST(Render, LongLineIsCutAroundThePlace) {
    const std::string text =
        render(unknown_word(place_in(std::string(3000, 'a') + " brik " + std::string(3000, 'b'), 3002, 4)));
    EXPECT_LT(text.size(), 400u);
    const auto first_line_end = text.find('\n'), second_line_end = text.find('\n', first_line_end + 1);
    const std::string line = text.substr(first_line_end + 1, second_line_end - first_line_end - 1);
    const std::string below = text.substr(second_line_end + 1);
    EXPECT_EQ(line.substr(below.find('^'), 4), "brik");
}

TEST(Render, PlaceBehindTheEndOfTheLineIsUnderlined) {
    const std::string text = render(unknown_word(place_in("poly", 5, 1)));
    EXPECT_NE(text.find("\n       |     ^"), std::string::npos) << text;
}

TEST(Render, MissingLineShowsTheMessageOnly) {
    Place place = place_in("poly", 1, 1);
    place.line = 9;
    EXPECT_EQ(render(unknown_word(place)),
              "tunnel.3dd:9:1: error: 'brik' is not a kind of poly\n  did you mean 'brick'?");
}

TEST(Render, ColourChangesTheKindOnly) { EXPECT_EQ(render(Diagnostic("no"), true), "\033[31merror\033[0m: no"); }

TEST(Diagnostic, FirstPlaceStays) {
    Diagnostic d("no");
    d.at(place_in("a b", 1, 1)).at(place_in("a b", 3, 1));
    EXPECT_EQ(d.place.column, 1);
}

TEST(DidYouMean, FindsTheNearest) {
    EXPECT_EQ(did_you_mean("brik", {"prism", "brick", "face"}), "brick");
    EXPECT_EQ(did_you_mean("jfirc", {"jkn", "jfric", "jcoh"}), "jfric");
    EXPECT_EQ(did_you_mean("barton_bandis", {"mohr", "barton-bandis"}), "barton-bandis");
}

TEST(DidYouMean, SaysNothingWhenNothingIsNear) {
    EXPECT_EQ(did_you_mean("excavate", {"brick", "prism"}), "");
    EXPECT_EQ(did_you_mean("x", {"y"}), "");
    EXPECT_EQ(did_you_mean("", {"a", "brick"}), "");
    EXPECT_EQ(did_you_mean("brick", {}), "");
}

TEST(NearestWords, AreSortedByMistakesAndKeepTheirOrderOtherwise) {
    using Words = std::vector<std::string_view>;
    const Words words = {"xvel", "yvel", "xload", "stress", "range"};
    EXPECT_EQ(nearest_words("xlod", words, 2), (Words{"xload", "xvel"}));
    EXPECT_EQ(nearest_words("vel", words, 3), (Words{"xvel", "yvel", "xload"}));
    EXPECT_EQ(nearest_words("stre", words, 1), (Words{"stress"})) << "the beginning of a word is no mistake";
    EXPECT_EQ(nearest_words("", words, 9).size(), 5u);
    EXPECT_EQ(nearest_words(std::string(1 << 20, 'x'), words, 6).size(), 5u);
    EXPECT_TRUE(nearest_words("x", {}, 6).empty());
}

TEST(DidYouMean, AWordAsLongAsAFileTakesNoTime) {
    EXPECT_EQ(did_you_mean(std::string(std::size_t{1} << 28, 'b'), {"brick"}), "");
}

TEST(DidYouMean, BetweenEqualsTakesTheOneThatStartsLikeTheWord) {
    EXPECT_EQ(did_you_mean("cycl", {"bycl", "cyco"}), "cyco");
}

TEST(Diagnostic, AMessageThatHoldsAWholeFileIsCut) {
    const std::string text = render(Diagnostic("'" + std::string(100000, 'a') + "' is not a command"));
    EXPECT_LT(text.size(), 600u);
    EXPECT_TRUE(text.starts_with("error: 'aaa"));
    EXPECT_TRUE(text.ends_with("aaa' is not a command"));
}

} // namespace
