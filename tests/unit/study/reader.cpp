#include "study/study.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

namespace kaya {
namespace {

using testing::HasSubstr;

class Reader : public testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("kaya-study-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "a.3dd") << "param friction = 30\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    Study read(const std::string& text) const { return read_study((folder_ / "a.toml").string(), text); }

    std::filesystem::path folder_;
};

TEST_F(Reader, ReadsAllThatAStudyCanSay) {
    const Study study = read(R"(title = "T"
deck = "a.3dd"
keep = ["*.png"]
[parameters]
friction = { distribution = "normal", mean = 30, deviation = 3, least = 20 }
cohesion = { from = 0, to = 1e5 }
law = "mohr"
[design]
method = "sobol"
samples = 64
seed = 9
correlation = [["friction", "cohesion", -0.3]]
[results]
slip = "@slip"
slides = { lua = "fish.slip() > 1" }
[ask]
probability = "slides"
tornado = "slip"
response = "slip"
[limits]
seconds = 60
megabytes = 500
cycles = 1000
)");
    EXPECT_EQ(study.title, "T");
    ASSERT_EQ(study.factors.size(), 2U);
    EXPECT_EQ(study.factors[0].distribution->least, 20);
    EXPECT_EQ(study.factors[1].distribution->kind, Distribution::Kind::uniform);
    ASSERT_EQ(study.fixed.size(), 1U);
    EXPECT_EQ(study.design.method, Design::Method::sobol);
    EXPECT_EQ(study.design.samples, 64U);
    ASSERT_EQ(study.design.correlations.size(), 1U);
    EXPECT_EQ(study.design.correlations[0].value, -0.3);
    ASSERT_EQ(study.asked.size(), 2U);
    EXPECT_TRUE(study.asked[1].lua);
    EXPECT_EQ(study.probability_of, "slides");
    EXPECT_EQ(study.limits.cycles, 1000);
    ASSERT_TRUE(study.kept);
}

TEST_F(Reader, TextsOfValuesGiveBackTheSameBitsAndKind) {
    EXPECT_EQ(text_of(StudyValue(30.0)), "30.0");
    EXPECT_EQ(text_of(StudyValue(std::int64_t{30})), "30");
    EXPECT_EQ(text_of(StudyValue(0.1)), "0.1");
    EXPECT_EQ(text_of(StudyValue(1e300)), "1e+300");
    EXPECT_EQ(text_of(StudyValue(true)), "true");
}

TEST_F(Reader, StepsIncludeBothEnds) {
    for (const auto& [from, to, by, count] : {std::tuple{20.0, 40.0, 5.0, 5U},
                                              {0.0, 1.0, 0.1, 11U},
                                              {-0.3, 0.6, 0.3, 4U},
                                              {1e5, 3e5, 2e5, 2U},
                                              {1.1, 1.4, 0.1, 4U},
                                              {0.0, 1.0, 0.333333333333, 4U},
                                              {0.0, 7.0, 0.007, 1001U}}) {
        const auto values = read(fmt::format("deck = \"a.3dd\"\nresults = {{ slip = \"@slip\" }}\n[parameters]\n"
                                             "f = {{ from = {}, to = {}, by = {} }}\n",
                                             from, to, by))
                                .factors[0]
                                .values;
        ASSERT_EQ(values.size(), count) << by;
        EXPECT_EQ(number_of(values.front()), from);
        EXPECT_EQ(number_of(values.back()), to);
        EXPECT_NEAR(number_of(values[1]), from + by, 1e-12 * std::abs(by));
    }
}

struct Wrong {
    const char* text; ///< after deck and results
    int line;
    const char* message;
    const char* hint = "";
};

class WrongStudies : public Reader, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongStudies, AreRefusedAtTheirPlace) {
    const Wrong& wrong = GetParam();
    try {
        read(std::string("deck = \"a.3dd\"\nresults = { slip = \"@slip\" }\n") + wrong.text);
        FAIL() << wrong.text;
    } catch (const Diagnostic& error) {
        EXPECT_THAT(error.message, HasSubstr(wrong.message));
        EXPECT_THAT(error.hint, HasSubstr(wrong.hint));
        EXPECT_EQ(error.place.line, wrong.line) << error.message;
    }
}

constexpr const char* two =
    "[parameters]\na = { distribution = \"normal\", mean = 1, deviation = 1 }\nb = { distribution = \"normal\", mean = 1, deviation = 1 }\n";
std::string with_two(const char* rest) { return std::string(two) + rest; }
const std::string same_with_itself =
    with_two("[design]\nmethod = \"random\"\nsamples = 5\ncorrelation = [[\"a\", \"a\", 0.5]]\n");
const std::string too_much =
    with_two("[design]\nmethod = \"random\"\nsamples = 5\ncorrelation = [[\"a\", \"b\", 1.5]]\n");
const std::string no_such =
    with_two("[design]\nmethod = \"random\"\nsamples = 5\ncorrelation = [[\"a\", \"bb\", 0.5]]\n");
const std::string no_samples = with_two("[design]\nmethod = \"random\"\n");
const std::string misspelt_method = with_two("[design]\nmethod = \"latin-hypercub\"\nsamples = 5\n");
const std::string zero_samples = with_two("[design]\nmethod = \"random\"\nsamples = 0\n");

INSTANTIATE_TEST_SUITE_P(
    All, WrongStudies,
    testing::Values(
        Wrong{"", 1, "no parameter varies"}, Wrong{"[parameters]\nf = [", 4, "this is not valid TOML"},
        Wrong{"[parameters]\nf = []\n", 4, "the list of 'f' is empty"},
        Wrong{"[parameters]\n# caf\u00e9\nf = [21.\u00e9, \"\u00e9\"]\n", 5,
              "a character that is not ASCII stands outside of quotes", "stand in quotes"},
        Wrong{"title = \"\"\"\n\\\"\"\" \u00e9 \"\"\"\n[parameters]\nf\u00e9 = 1\n", 6,
              "a character that is not ASCII"},
        Wrong{"[parametres]\nf = [1]\n", 1, "no parameter varies"},
        Wrong{"[parameters]\nf = [1]\n[limit]\nseconds = 1\n", 5, "a study has no 'limit'", "limits"},
        Wrong{"[parameters]\n\"1f\" = [1]\n", 4, "'1f' is not a valid name of a parameter"},
        Wrong{"[parameters]\nf = { distribution = \"norml\", mean = 1, deviation = 1 }\n", 4,
              "there is no distribution 'norml'", "normal"},
        Wrong{"[parameters]\nf = { distribution = \"normal\", mean = 1, deviation = 0 }\n", 4,
              "the deviation must be above 0"},
        Wrong{"[parameters]\nf = { distribution = \"gamma\", mean = 38.9, deviation = 1e300, least = 9.52 }\n", 4,
              "too far apart to compute with"},
        Wrong{"[parameters]\nf = { distribution = \"normal\", mean = 1 }\n", 4, "needs 'deviation'"},
        Wrong{"[parameters]\nf = { distribution = \"normal\", mean = \"1\", deviation = 1 }\n", 4,
              "expected a number for 'mean', found a text"},
        Wrong{"[parameters]\nf = { distribution = \"normal\", mean = 1, deviation = 1, sd = 1 }\n", 4, "has no 'sd'"},
        Wrong{"[parameters]\nf = { distribution = \"normal\", mean = 1, deviation = 1 }\n", 4, "no [design] says how"},
        Wrong{"[parameters]\nf = { from = 2, to = 1 }\n", 4, "'to' must be above 'from'"},
        Wrong{"[parameters]\nf = { from = 1, to = 2, by = -1 }\n", 4, "'by' must lead"},
        Wrong{"[parameters]\nf = { from = 1, to = 10, by = 4 }\n", 4, "steps of 4 from 1 do not end at 10",
              "write by = 4.5 or by = 3, or count = 4"},
        Wrong{"[parameters]\nf = { from = 20, to = 40, by = 25 }\n", 4, "steps of 25 from 20 do not end at 40",
              "write by = 20, or count = 2"},
        Wrong{"[parameters]\nf = { from = -0.1, to = 0.2, by = 0.0999 }\n", 4, "do not end at 0.2",
              "write by = 0.1 or by = 0.075, or count = 5"},
        Wrong{"[parameters]\nf = { from = 1, to = 2, count = 1 }\n", 4, "'count' must be"},
        Wrong{"[parameters]\nf = { from = nan, to = 2 }\n", 4, "expected a number"},
        Wrong{same_with_itself.c_str(), 9, "not correlated with itself"},
        Wrong{too_much.c_str(), 9, "lies between -1 and 1"}, Wrong{no_such.c_str(), 9, "no parameter 'bb'"},
        Wrong{no_samples.c_str(), 6, "'design' needs 'samples'"},
        Wrong{misspelt_method.c_str(), 7, "there is no method 'latin-hypercub'", "latin-hypercube"},
        Wrong{zero_samples.c_str(), 8, "'samples' must be 1"},
        Wrong{"[parameters]\nf = [1, 2]\n[ask]\ntornado = \"slp\"\n", 6, "there is no result 'slp'", "slip"},
        Wrong{"[parameters]\nf = [1, 2]\n[limits]\nseconds = -1\n", 6, "'seconds' must be above 0"},
        Wrong{
            "[parameters]\nf = [1, 2]\n[critical]\nparameter = \"g\"\nof = \"slip\"\nfrom = 0\nto = 1\ntolerance = 0.1\n",
            4, "'f' varies in addition to a search"},
        Wrong{"[critical]\nparameter = \"g\"\nof = \"slip\"\nfrom = 0\nto = 1\n", 3, "needs 'tolerance'"},
        Wrong{"[parameters]\nf = [1, 2]\ng = [1]\n[design]\nmethod = \"list\"\n", 5, "a list needs as many values"},
        Wrong{"[parameters]\nf = [1, 2]\n[design]\nmethod = \"one-at-a-time\"\n", 4, "needs the base of 'f'"},
        Wrong{"[fit.parameters]\nf = { from = 0, to = 1, start = 2 }\n[fit.observed]\nslip = 1\n", 4,
              "'start' must lie between"}));

TEST_F(Reader, ADeckThatIsNotThereIsSaid) {
    try {
        read("deck = \"b.3dd\"\n");
        FAIL();
    } catch (const Diagnostic& error) {
        EXPECT_THAT(error.message, HasSubstr("there is no deck 'b.3dd'"));
        EXPECT_EQ(error.place.line, 1);
    }
}

TEST_F(Reader, AnyTextIsAStudyOrAMessage) {
    const std::string good =
        "deck = \"a.3dd\"\nkeep = [\"*\"]\n[parameters]\nf = { distribution = \"beta\", from = 1, to = 2, alpha = 2, beta = 3 }\ng = [1, 2.5, \"x\"]\n[design]\n"
        "method = \"list\"\n[results]\nslip = \"@slip\"\n[ask]\nresponse = \"slip\"\n";
    unsigned random = 1;
    const auto next = [&] { return random = random * 1664525U + 1013904223U, random >> 8; };
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        for (unsigned changes = 1 + next() % 4; changes > 0; --changes) {
            const std::size_t at = next() % text.size();
            switch (next() % 3) {
            case 0: text[at] = static_cast<char>(next() % 256); break;
            case 1: text.erase(at, 1 + next() % 10); break;
            default: text.insert(at, good.substr(next() % good.size(), next() % 12)); break;
            }
            if (text.empty()) text = " ";
        }
        try {
            read(text);
        } catch (const Diagnostic& error) { EXPECT_FALSE(error.message.empty()); }
    }
}

} // namespace
} // namespace kaya
