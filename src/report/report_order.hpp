// What a page shows beside the model.
#pragma once

#include "base/vector.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace kaya {

/// The blocks at one moment.
struct ReportState {
    double time = 0;
    std::int64_t cycle = 0;
    std::string scene; ///< JSON
};

/// A quantity over the cycles of the run.
struct ReportCurve {
    std::string title;
    std::vector<double> cycles, values;
};

/// Names of a joint model, in their order; none when it cannot be loaded.
struct LawNames {
    std::vector<std::string> properties, states;
};

struct ReportOrder {
    std::string file;    ///< name of the save or of the run, for the title
    std::string source;  ///< kind of `file`: "saved model"
    std::string version; ///< of this program
    std::function<LawNames(const std::string& model)> law_names;
    std::vector<ReportState> before; ///< states shown before that of the model, in order
    Vec3 centre = Vec3::Zero();      ///< of all states
    std::vector<ReportCurve> course; ///< progress of the run; none for a saved model
    std::vector<std::string> warnings;
    std::string took; ///< "4 min 21 s"; empty of a saved model
};

} // namespace kaya
