// A saved model as one page that a browser opens without a network.
#pragma once

#include "io/save.hpp"
#include "model/model.hpp"

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

/// `centre` is the origin of places: the same for all states of a page (report_centre of one of them).
ReportState report_state(const Model& model, const Vec3& centre);
Vec3 report_centre(const Model& model);

struct ReportOrder {
    std::string file;    ///< name of the save or of the run, for the title
    std::string source;  ///< kind of `file`: "saved model"
    std::string version; ///< of this program
    /// Names of the properties of a joint model, in their order; empty when it cannot be loaded.
    std::function<std::vector<std::string>(const std::string& model)> property_names;
    std::vector<ReportState> before; ///< states shown before that of the model, in order
    Vec3 centre = Vec3::Zero();      ///< of all states
    std::vector<ReportCurve> course; ///< progress of the run; none for a saved model
    std::vector<std::string> warnings;
    std::string took; ///< "4 min 21 s"; empty of a saved model
};

/// HTML with style, scripts and data in it: the deck, the model in numbers, properties, contacts, energy, histories as curves, and a view
/// of the blocks, over time when there are earlier states. The same model gives the same bytes.
std::string report_of(Model& model, const SaveExtras& extras, const ReportOrder& order);

} // namespace kaya
