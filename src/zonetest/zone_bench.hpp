// The whole bench: from a zone model, values and a path to files and a report.
#pragma once

#include "zonetest/zone_curve.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

struct ZoneBenchOrder {
    std::string model;                                  ///< name or file
    std::filesystem::path path;                         ///< CSV file of the path
    std::vector<std::pair<std::string, double>> values; ///< property words and values
    ZoneCurveSettings settings;
    std::filesystem::path output; ///< files are OUTPUT.csv and OUTPUT.gp; empty: PATH-MODEL in the working folder
};

struct ZoneBenchReport {
    std::string text; ///< lines without a newline at the end
    bool odd = false; ///< something was found
    std::filesystem::path figure;
};

/// Loads the model, drives one zone along the path, writes curve and figure. Throws Diagnostic for a word that the model does not know, a
/// value outside its limits, an invalid file, or a model that fails.
ZoneBenchReport run_zone_bench(ZoneModels& models, const ZoneBenchOrder& order);

} // namespace kaya
