#include "study/local_runs.hpp"
#include "study/search.hpp"

#include <cmath>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

namespace kaya {
namespace {

namespace fs = std::filesystem;

class LocalRunsTest : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("kaya-runs-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        std::ofstream(folder_ / "a.3dd") << "param x = 1\n";
        study_.file = (folder_ / "a.toml").string(), study_.text = "text", study_.deck = (folder_ / "a.3dd").string();
        for (int i = 1; i <= 8; ++i) {
            Case one;
            one.number = static_cast<std::size_t>(i);
            one.values = {{"x", StudyValue(0.5 * i)}, {"name", StudyValue(std::string("a \"quoted\" one"))}};
            cases_.push_back(one);
        }
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::vector<Outcome> all(const RunCase& run, LocalRuns::Options options = {2, false, {}, {}}) {
        StudyProgress progress(true);
        const StudyFolder folder(folder_ / "study", study_, "1", false);
        LocalRuns runs(folder, std::move(options), run, progress);
        return runs.all(cases_);
    }
    static int double_of(const Case& one, const fs::path& file) {
        Outcome outcome;
        outcome.results = {{"twice", StudyValue(2 * number_of(one.values[0].second))},
                           {"none", StudyValue()},
                           {"truth", StudyValue(true)}};
        std::ofstream("started", std::ios::app) << "x";
        write_outcome(file, one, outcome);
        return 0;
    }
    std::size_t starts(std::size_t number) const {
        std::error_code none;
        const auto size = fs::file_size(folder_ / "study/runs" / ("00000" + std::to_string(number)) / "started", none);
        return none ? 0 : size;
    }

    fs::path folder_;
    Study study_;
    std::vector<Case> cases_;
};

TEST_F(LocalRunsTest, EachRunIsDoneOnceAndItsOutcomeKept) {
    for (int call = 0; call < 2; ++call) {
        const auto outcomes = all(double_of);
        ASSERT_EQ(outcomes.size(), cases_.size());
        for (std::size_t i = 0; i < cases_.size(); ++i) {
            EXPECT_EQ(number_of(result_of(outcomes[i], "twice")), static_cast<double>(i + 1));
            EXPECT_EQ(result_of(outcomes[i], "truth"), StudyValue(true));
            EXPECT_EQ(result_of(outcomes[i], "none"), StudyValue());
            EXPECT_EQ(starts(i + 1), 1U);
        }
    }
}

TEST_F(LocalRunsTest, ARunThatCrashesIsARowAndOneThatIsKilledIsTriedAgain) {
    const auto outcomes = all([](const Case& one, const fs::path& file) {
        if (one.number == 3) ::raise(SIGABRT);
        if (one.number == 5) {
            std::ofstream("started", std::ios::app) << "x";
            ::raise(SIGKILL);
        }
        return double_of(one, file);
    });
    EXPECT_EQ(outcomes[2].end, Outcome::End::crashed);
    EXPECT_THAT(outcomes[2].message, testing::HasSubstr("signal 6"));
    EXPECT_EQ(outcomes[4].end, Outcome::End::lost);
    EXPECT_EQ(starts(5), 3U);
    EXPECT_EQ(outcomes[5].end, Outcome::End::done);
}

TEST_F(LocalRunsTest, ARunThatTakesTooLongIsEnded) {
    const auto outcomes = all(
        [](const Case& one, const fs::path& file) {
            if (one.number == 2) {
                std::signal(SIGTERM, SIG_DFL);
                for (;;) ::pause();
            }
            return double_of(one, file);
        },
        {2, false, {.seconds = 0.2, .megabytes = 0, .cycles = 0}, {}});
    EXPECT_EQ(outcomes[1].end, Outcome::End::limit);
    EXPECT_THAT(outcomes[1].message, testing::HasSubstr("more than 0.2 s"));
    EXPECT_EQ(outcomes[7].end, Outcome::End::done);
}

TEST_F(LocalRunsTest, FilesThatNobodyWantsGo) {
    const fs::path run = folder_ / "study/runs/000001";
    for (int call = 0; call < 2; ++call) {
        all(
            [](const Case& one, const fs::path& file) {
                std::ofstream("a.png") << "x";
                std::ofstream("b.csv") << "x";
                return double_of(one, file);
            },
            {1, false, {}, std::vector<std::string>{"*.png", "started"}});
        for (const char* kept : {"a.png", "output.txt", "outcome.toml"}) EXPECT_TRUE(fs::exists(run / kept)) << kept;
        for (const char* gone : {"b.csv", ".lock"}) EXPECT_FALSE(fs::exists(run / gone)) << gone;
        // As if the study had been killed after the outcome of the run.
        for (const char* left : {"b.csv", ".lock"}) std::ofstream(run / left) << "";
    }
    EXPECT_EQ(starts(1), 1U);
}

TEST_F(LocalRunsTest, AnotherStudyOrDeckInOneFolderIsRefused) {
    all(double_of);
    study_.text = "another text";
    EXPECT_THROW(all(double_of), Diagnostic);
    study_.text = "text";
    std::ofstream(folder_ / "a.3dd") << "param x = 2\n";
    EXPECT_THROW(all(double_of), Diagnostic);
}

TEST_F(LocalRunsTest, ADamagedOutcomeIsSaid) {
    all(double_of);
    std::ofstream(folder_ / "study/runs/000004/outcome.toml") << "end = \"do";
    EXPECT_THROW(all(double_of), Diagnostic);
}

/// A function in place of runs.
class Computed : public Runs {
public:
    explicit Computed(std::function<double(const std::map<std::string, double>&)> f) : f_(std::move(f)) {}
    std::vector<Outcome> all(const std::vector<Case>& cases) override {
        std::vector<Outcome> outcomes;
        for (const auto& one : cases) {
            std::map<std::string, double> values;
            for (const auto& [name, value] : one.values) values[name] = number_of(value);
            outcomes.emplace_back();
            outcomes.back().results = {{"f", StudyValue(f_(values))},
                                       {"g", StudyValue(values["a"] - values["b"])},
                                       {"h", StudyValue(values["a"] * values["b"])}};
        }
        return outcomes;
    }

private:
    std::function<double(const std::map<std::string, double>&)> f_;
};

TEST(SearchTest, ACriticalValueIsEnclosed) {
    Study study;
    for (const double root : {-2.5, 0.1, 7.77}) {
        study.critical = Critical{"a", "f", -3, 11, 1e-3, {}};
        Computed runs([root](auto values) { return values["a"] - root; });
        const auto answer = find_critical(study, runs);
        EXPECT_LE(answer.below, root);
        EXPECT_GE(answer.above, root);
        EXPECT_LE(answer.above - answer.below, 1e-3);
        EXPECT_LE(answer.cases.size(), 20U); // two ends and two for each factor of three: 14 / 3^9 < 0.001
    }
    study.critical->from = 8;
    Computed runs([](auto values) { return values["a"] - 1; });
    EXPECT_THROW(find_critical(study, runs), Diagnostic);
}

TEST(SearchTest, AFitFindsParametersAndTheirUncertainty) {
    for (const char* method : {"bobyqa", "cobyla", "sbplx"}) {
        Study study;
        study.fit.emplace();
        study.fit->method = method;
        study.fit->tolerance = 1e-6;
        study.fit->most_runs = 1000;
        study.fit->unknowns = {{"a", 0, 10, 5}, {"b", 0, 4, 1}};
        study.fit->observations = {{"f", 3 + 2 * 2.0, 0.1}, {"g", 3 - 2.0, 0.2}};
        Computed runs([](auto values) { return values["a"] + 2 * values["b"]; });
        const auto answer = fit_parameters(study, runs);
        EXPECT_TRUE(answer.converged);
        ASSERT_EQ(answer.found.size(), 2U);
        EXPECT_NEAR(answer.found[0].value, 3, 1e-3) << method;
        EXPECT_NEAR(answer.found[1].value, 2, 1e-3) << method;
        // b = (f - g)/3 and a = (f + 2 g)/3 exactly, so their deviations follow from those of f and g.
        EXPECT_NEAR(answer.found[1].deviation, std::hypot(0.1, 0.2) / 3, 1e-6);
        EXPECT_NEAR(answer.found[0].deviation, std::hypot(0.1, 0.4) / 3, 1e-6);
        EXPECT_FALSE(answer.found[0].at_bound);
    }
}

TEST(SearchTest, OneParameterAndAnAnswerOutsideOfTheBounds) {
    Study study;
    study.fit.emplace();
    study.fit->unknowns = {{"a", 0, 10, 5}};
    study.fit->observations = {{"f", 20, 0}};
    Computed runs([](auto values) { return values["a"]; });
    const auto answer = fit_parameters(study, runs);
    EXPECT_NEAR(answer.found[0].value, 10, 1e-2);
    EXPECT_TRUE(std::isnan(answer.found[0].deviation)); // one observation, one parameter, unknown error
}

} // namespace
} // namespace kaya
