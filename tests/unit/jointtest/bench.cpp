// The bench for joint models: paths, findings, and fits.
#include "base/diagnostic.hpp"
#include "jointtest/bench.hpp"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <unistd.h>

namespace kaya {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

double tan_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

class JointBench : public testing::Test {
protected:
    JointBench() {
        folder = fs::temp_directory_path() / ("kaya-bench-" + std::to_string(getpid()));
        fs::create_directories(folder);
        registry.set_path({KAYA_SHIPPED_MODELS, KAYA_TEST_PLUGINS});
    }
    ~JointBench() override { fs::remove_all(folder); }

    fs::path file(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }

    JointCurve follow(const std::string& model, const std::vector<std::pair<std::string, double>>& values,
                      const std::string& path_text, std::size_t steps = 200) {
        BenchOrder o = order(model, values, path_text);
        std::vector<double> all;
        const auto& m = registry.get(model);
        for (const auto& p : m.properties) all.push_back(p.initial);
        for (const auto& [word, value] : values) all[*m.find_property(word)] = value;
        CurveSettings settings;
        settings.steps = steps;
        return follow_path(m, all, read_load_path(o.path), settings);
    }

    BenchOrder order(const std::string& model, const std::vector<std::pair<std::string, double>>& values,
                     const std::string& path_text) {
        BenchOrder o;
        o.model = model;
        o.path = file("path.csv", path_text);
        o.values = values;
        o.output = folder / "curve";
        return o;
    }

    std::string refusal(const BenchOrder& o) {
        try {
            run_bench(registry, o);
        } catch (const Diagnostic& error) { return error.message; }
        return "";
    }

    fs::path folder;
    JointRegistry registry;
    const std::vector<std::pair<std::string, double>> coulomb = {
        {"jkn", 1e4}, {"jks", 5e3}, {"jfric", 30}, {"jcoh", 0.5}};
};

TEST_F(JointBench, ConstantNormalLoadGivesThePeakAndTheResidualStrength) {
    const auto curve = follow("mohr", coulomb, "normal_stress,shear_displacement\n2,0\n2,0.002\n");
    double peak = 0;
    for (const auto& p : curve.points) {
        EXPECT_NEAR(p.normal_stress, 2, 1e-12);
        peak = std::max(peak, p.resistance[0]);
    }
    EXPECT_NEAR(peak, 0.5 + 2 * tan_degrees(30), 1e-12);
    EXPECT_NEAR(curve.points.back().resistance[0], 2 * tan_degrees(30), 1e-12);
    ASSERT_EQ(curve.findings.size(), 1u); // the drop to the residual strength
    EXPECT_THAT(curve.findings[0].text, HasSubstr("jumps from 1.655 to 1.155"));
    EXPECT_EQ(curve.at_path.back(), curve.points.size() - 1);
}

TEST_F(JointBench, ConstantNormalStiffnessMeetsTheSpring) {
    // A dilating Coulomb joint with a spring K: d sigma = K (tan psi du - d sigma/kn).
    const auto curve = follow("mohr", {{"jkn", 1e4}, {"jks", 1e6}, {"jfric", 30}, {"jdil", 10}},
                              "normal_stress,boundary_stiffness,shear_displacement\n1,500,0\n1,500,0.01\n", 2000);
    const auto& last = curve.points.back();
    const double slip = 0.01 - last.resistance[0] / 1e6;
    EXPECT_NEAR((last.normal_stress - 1) / (slip * tan_degrees(10) / (1 / 500.0 + 1 / 1e4)), 1, 1e-9);
    EXPECT_NEAR(last.resistance[0] / (last.normal_stress * tan_degrees(30)), 1, 1e-12);
}

TEST_F(JointBench, APathOfDisplacementOpensAndCloses) {
    const auto curve = follow("mohr", coulomb, "normal_displacement\n0\n-1e-4\n2e-4\n-1e-4\n");
    EXPECT_NEAR(curve.points[curve.at_path[1]].normal_stress, 1, 1e-12);
    EXPECT_EQ(curve.points[curve.at_path[2]].normal_stress, 0);
    EXPECT_NEAR(curve.points[curve.at_path[3]].normal_stress, 1, 1e-9);
    EXPECT_TRUE(curve.findings.empty());
}

TEST_F(JointBench, TangentsAreThoseThatAreMet) {
    const auto curve = follow("nonlinear", {{"jkn", 1e4}, {"jks", 5e3}, {"exponent-normal", 0.5}, {"fric", 30}},
                              "normal_stress,shear_displacement\n1,0\n4,0\n4,1e-4\n");
    const auto& closed = curve.points[curve.at_path[1]];
    EXPECT_NEAR(closed.normal_tangent / 2e4, 1, 1e-4);
    EXPECT_NEAR(closed.normal_stiffness / 2e4, 1, 1e-9);
    EXPECT_NEAR(curve.points.back().shear_tangent / 5e3, 1, 1e-9);
}

TEST_F(JointBench, EnergyIsThatOfTheLoop) {
    // One closed loop of a Coulomb joint: a work of 4 tau (u - tau/ks), all of it dissipated.
    const auto curve = follow("mohr", {{"jkn", 1e4}, {"jks", 5e3}, {"jfric", 30}},
                              "normal_stress,shear_displacement\n2,0\n2,1e-3\n2,-1e-3\n2,1e-3\n", 1000);
    const auto& from = curve.points[curve.at_path[1]];
    const auto& to = curve.points.back();
    const double strength = 2 * tan_degrees(30);
    EXPECT_NEAR((to.put_in - from.put_in) / (4 * strength * (1e-3 - strength / 5e3)), 1, 1e-6);
    EXPECT_NEAR((to.taken_up - from.taken_up) / (to.put_in - from.put_in), 1, 1e-6);
    EXPECT_TRUE(curve.findings.empty());
}

TEST_F(JointBench, FindsAStiffnessThatIsReportedTooSmallAndEnergyFromNothing) {
    const auto weak =
        follow("understates", {}, "normal_displacement,shear_displacement\n-1e-4,0\n-1e-4,1e-4\n-1e-4,0\n");
    ASSERT_FALSE(weak.findings.empty());
    EXPECT_THAT(weak.findings[0].text, HasSubstr("normal stiffness is 1000, the model reports 10"));
    const auto giving = follow("understates", {}, "normal_displacement,shear_displacement\n0,0\n0,1e-4\n0,0\n");
    std::string all;
    for (const auto& f : giving.findings) all += f.text;
    EXPECT_THAT(all, HasSubstr("it creates energy"));
}

TEST_F(JointBench, AJumpIsNoStiffness) {
    auto dilating = coulomb;
    dilating.push_back({"jdil", 8});
    // The bond breaks along the path: shear drops, and dilation acts immediately. Each point is also tried with a small further step.
    for (const char* path : {"normal_displacement,shear_displacement\n-2e-4,0\n-2e-4,0.002\n",
                             "normal_stress,shear_displacement\n2,0\n2,0.002\n"}) {
        const auto curve = follow("mohr", dilating, path, 1000);
        bool jumps = false;
        for (const auto& finding : curve.findings) {
            EXPECT_THAT(finding.text, testing::Not(HasSubstr("stiffness is"))) << path;
            jumps = jumps || finding.text.find("shear stress jumps") != std::string::npos;
        }
        EXPECT_TRUE(jumps) << path;
        for (const auto& p : curve.points) {
            EXPECT_LE(p.normal_tangent, 1.02 * p.normal_stiffness);
            EXPECT_LE(std::abs(p.shear_tangent), 1.02 * p.shear_stiffness);
        }
    }
}

TEST_F(JointBench, NamesColumnsAndTablesThatItHasNot) {
    const auto report =
        run_bench(registry, order("mohr", coulomb,
                                  "normal_stress,shear_displacement,shear_disp,opening\n2,0,1,0\n2,0.001,1,0\n"));
    EXPECT_THAT(report.text, HasSubstr("not read          shear_disp; columns of a path are shear_displacement, "));
    EXPECT_THAT(report.text, testing::Not(HasSubstr("no tables")));
    auto asking = order("mohr", coulomb, "normal_stress,shear_displacement\n2,0\n2,0.001\n");
    asking.missed_tables->insert("7");
    EXPECT_THAT(run_bench(registry, asking).text, HasSubstr("the model asks for table 7, and the bench has none"));
}

TEST_F(JointBench, StopsAtAModelThatWritesWhereItMustNot) {
    const char* const path = "normal_displacement\n0\n-1e-4\n";
    EXPECT_THAT(refusal(order("writes-area", {{"k", 1}}, path)), HasSubstr("wrote to 'area', which it may only read"));
    EXPECT_THAT(refusal(order("writes-behind", {{"k", 1}}, path)), HasSubstr("wrote after the column 'shear_force'"));
    EXPECT_THAT(run_bench(registry, order("rounds-up", {{"k", 1}}, path)).text,
                HasSubstr("it changes how numbers are rounded"));
    EXPECT_THAT(run_bench(registry, order("works", {{"k", 1}}, path)).text, HasSubstr("found             no jump"));
}

TEST_F(JointBench, WritesCurveAndFigure) {
    auto o = order("mohr", coulomb, "# a comment\n\nnormal_stress, shear_displacement\n2, 0\n2, 0.002\n");
    o.settings.steps = 100;
    const auto report = run_bench(registry, o);
    EXPECT_TRUE(report.odd);
    const auto table = read_csv(report.curve);
    EXPECT_EQ(table.rows(), 101u);
    ASSERT_TRUE(table.find("slip"));
    EXPECT_GT(table.columns[*table.find("slip")].back(), 1e-3);
    EXPECT_TRUE(fs::exists(report.figure));
    EXPECT_THAT(report.text, HasSubstr("largest at"));
}

/// The number behind a text of the report.
double number_behind(const std::string& report, const std::string& text) {
    const auto found = report.find(text);
    if (found == report.npos) return std::nan("");
    return std::atof(report.c_str() + found + text.size());
}

TEST_F(JointBench, SaysHowMuchHalfTheStepsChange) {
    const std::string few = "half as many change the stress by ";
    auto o = order("mohr", coulomb, "normal_stress,shear_displacement\n2,0\n2,1e-4\n");
    o.settings.steps = 40;
    EXPECT_THAT(run_bench(registry, o).text,
                HasSubstr(few + "less than 1e-6, the opening by less than 1e-6 and the work by less than 1e-6 of"));
    o.settings.steps = 1;
    EXPECT_THAT(run_bench(registry, o).text, HasSubstr("the pieces of the path have one step"));
    // The shear stiffness grows with the normal stress, which rises with the shear.
    for (const auto* path : {"normal_stress,shear_displacement\n1,0\n4,1e-3\n",
                             "normal_displacement,shear_displacement\n-1e-4,0\n-4e-4,1e-3\n"}) {
        const std::vector<std::pair<std::string, double>> values{
            {"jkn", 1e4}, {"jks", 1e3}, {"exponent-normal", 0.5}, {"exponent-shear", 0.8}, {"jfric", 60}};
        auto stiffening = order("nonlinear", values, path);
        double changes[2];
        for (const std::size_t steps : {40, 80}) {
            stiffening.settings.steps = steps;
            const std::string text = run_bench(registry, stiffening).text;
            const auto at = [&](std::size_t n) { return follow("nonlinear", values, path, n).points.back(); };
            const CurvePoint fine = at(steps), coarse = at(steps / 2);
            const double change = std::max(std::abs(fine.resistance[0] - coarse.resistance[0]),
                                           std::abs(fine.normal_stress - coarse.normal_stress)) /
                                  std::max(fine.resistance[0], fine.normal_stress);
            changes[steps / 80] = number_behind(text, few);
            EXPECT_NEAR(changes[steps / 80] / change, 1, 0.06) << text;
        }
        EXPECT_GT(changes[0], 1e-5);
        EXPECT_LT(changes[1], changes[0]);
    }
}

TEST_F(JointBench, SaysWhatIsWrongWithPathOrValues) {
    const std::string good = "normal_stress,shear_displacement\n2,0\n2,0.002\n";
    EXPECT_THAT(refusal(order("mohr", {{"jkn", 1e4}}, good)), HasSubstr("lacks stiffness-shear"));
    EXPECT_THAT(refusal(order("mohr", {{"jknn", 1e4}}, good)), HasSubstr("no property 'jknn'"));
    EXPECT_THAT(refusal(order("mohr", {{"jfric", 100}}, good)),
                HasSubstr("'jfric' is 100, but for joint model mohr it must be from 0 to 90"));
    EXPECT_THAT(refusal(order("mohr", {{"jkn", 0}, {"jks", 1}}, good)), HasSubstr("stiffness-normal (jkn) is 0"));
    const std::pair<const char*, const char*> paths[] = {
        {"shear_displacement\n0\n1\n", "neither a column normal_displacement nor normal_stress"},
        {"normal_stress,normal_displacement\n0,0\n1,1\n", "gives normal_displacement and normal_stress"},
        {"normal_displacement,boundary_stiffness\n0,1\n1,1\n", "boundary_stiffness needs"},
        {"normal_stress\n1\n", "two points"},
        {"normal_stress,time\n1,1\n1,0\n", "time goes back"},
        {"normal_stress,time\n1,1\n1\n", "line 3: 1 numbers where the first line has 2 names"},
        {"normal_stress,time,Normal stress\n1,1,2\n1,2,3\n", "line 1: two columns are named 'normal_stress'"},
        {"normal_stress\n1\nmuch\n", "line 3: expected a number, found 'much'"},
        {"normal_stress\n1\n-1\n", "cannot carry a normal stress of"},
    };
    for (const auto& [text, message] : paths) EXPECT_THAT(refusal(order("mohr", coulomb, text)), HasSubstr(message));
    auto missing = order("mohr", coulomb, good);
    missing.path = folder / "nowhere.csv";
    EXPECT_THAT(refusal(missing), HasSubstr("there is no file"));
    auto itself = order("mohr", coulomb, good);
    itself.output = folder / "path";
    EXPECT_THAT(refusal(itself), HasSubstr("is the path itself"));
    EXPECT_THAT(refusal(order("no-such-model", {}, good)), HasSubstr("no joint model 'no-such-model'"));
}

TEST_F(JointBench, ReadsTablesOfSpreadsheets) {
    const std::vector<std::string> texts = {
        "\xef\xbb\xbfNormal stress; Shear displacement\r\n2,5; 0\r\n2,5; 1e-3\r\n",
        "normal-stress\tshear_displacement\n2.5\t0\n2,5\t0,001\n",
        "# measured\nnormal_stress , shear_displacement\n 2.5, 0\n2.5 ,0.001\n",
    };
    for (const auto& text : texts) {
        const auto table = read_csv(file("sheet.csv", text));
        ASSERT_EQ(table.names, (std::vector<std::string>{"normal_stress", "shear_displacement"})) << text;
        EXPECT_EQ(table.columns[0], (std::vector<double>{2.5, 2.5})) << text;
        EXPECT_EQ(table.columns[1], (std::vector<double>{0, 1e-3})) << text;
    }
    EXPECT_THAT(refusal(order("mohr", coulomb, "stress,slip\n1,0\n")),
                HasSubstr("neither a column normal_displacement nor"));
}

TEST_F(JointBench, FindsPropertiesFromTheirOwnCurve) {
    const std::vector<std::pair<std::string, double>> truth = {{"jkn", 1e5}, {"jks", 1e4},  {"resfric", 20},
                                                               {"jrco", 8},  {"jcso", 100}, {"sigmac", 150}};
    const std::string path =
        "normal_stress,shear_displacement\n2,0\n2,3e-4\n2,6e-4\n2,9e-4\n2,1.5e-3\n2,3e-3\n2,6e-3\n";
    const auto curve = follow("barton-bandis", truth, path, 100);
    std::string measured = "normal_stress,shear_displacement,shear_stress,opening\n";
    const double start = curve.points.front().opening;
    for (const auto i : curve.at_path) {
        char line[200];
        const auto& p = curve.points[i];
        // The opening in a laboratory is measured from the start of the test.
        std::snprintf(line, sizeof line, "2,%.17g,%.17g,%.17g\n", p.shear[0], p.resistance[0], p.opening - start);
        measured += line;
    }
    auto o = order("barton-bandis", truth, measured);
    o.values[2].second = 26; // start of the search
    o.values[3].second = 5;
    o.values[4].second = 60;
    o.fitted = {"resfric", "jrco", "jcso"};
    o.settings.steps = 100;
    const auto& model = registry.get("barton-bandis");
    std::vector<double> values;
    for (const auto& p : model.properties) values.push_back(p.initial);
    for (const auto& [word, value] : o.values) values[*model.find_property(word)] = value;
    const auto fit = fit_curve(model, values, o.fitted, read_load_path(o.path), {o.settings});
    EXPECT_GT(fit.misfit_before, 0.05);
    EXPECT_LT(fit.misfit, 1e-6);
    EXPECT_NEAR(fit.properties[0].value, 20, 1e-3);
    EXPECT_NEAR(fit.properties[1].value, 8, 1e-3);
    EXPECT_NEAR(fit.properties[2].value, 100, 1e-2);
    EXPECT_THAT(run_bench(registry, o).text, HasSubstr("jrco              8"));
}

TEST_F(JointBench, AFitStaysWithinLimitsAndSaysWhatItCannotTell) {
    const std::string measured =
        "normal_stress,shear_displacement,shear_stress\n1,0,0\n1,0.001,90\n1,0.002,90\n1,0.003,90\n";
    auto o = order("mohr", {{"jkn", 1e4}, {"jks", 1e6}, {"jfric", 40}}, measured);
    o.fitted = {"jfric", "jten"};
    const std::string text = run_bench(registry, o).text;
    EXPECT_THAT(text, HasSubstr("tension"));
    EXPECT_THAT(text, HasSubstr("which the curve does not determine"));
    o.fitted = {"nothing"};
    EXPECT_THAT(refusal(o), HasSubstr("no property 'nothing'"));
    o.fitted = {"friction-residual"};
    EXPECT_THAT(refusal(o), HasSubstr("has no value to start from"));
    auto unmeasured = order("mohr", coulomb, "normal_stress,shear_displacement\n2,0\n2,0.002\n");
    unmeasured.fitted = {"jfric"};
    EXPECT_THAT(refusal(unmeasured), HasSubstr("no measured column"));
}

} // namespace
} // namespace kaya
