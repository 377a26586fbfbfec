// The bench as a whole: a model, values and a path in; files and a report out.
#pragma once

#include "jointtest/curve_fit.hpp"
#include "jointtest/joint_curve.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

struct BenchOrder {
    std::string model;                                  ///< name or file
    std::filesystem::path path;                         ///< CSV file of the path
    std::vector<std::pair<std::string, double>> values; ///< property words and values
    std::vector<std::string> fitted;                    ///< properties to fit; none: a test
    std::vector<std::string> offsets = {"opening"};     ///< measured columns with unknown zero
    CurveSettings settings;
    std::function<void(const std::filesystem::path&)> before_writing; ///< may refuse a file; may be empty
    /// Filled by the table callback while the bench runs.
    std::shared_ptr<std::set<std::string>> missed_tables = std::make_shared<std::set<std::string>>();
    std::filesystem::path output; ///< files are OUTPUT.csv and OUTPUT.gp; empty: PATH-MODEL in the working folder
};

struct BenchReport {
    std::string text;                    ///< lines without a newline at the end
    bool odd = false;                    ///< something was found
    bool doubtful = false;               ///< the fit may not be the best
    std::filesystem::path curve, figure; ///< the files that were written
};

/// Loads the model, runs it along the path (and fits it), writes curve and figure. Throws Diagnostic for a word unknown to the model, a
/// value outside its limits, a wrong file, or a model that fails.
BenchReport run_bench(JointRegistry& registry, const BenchOrder& order);

} // namespace kaya
