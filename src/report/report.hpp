// A saved model as one page that a browser opens without a network.
#pragma once

#include "io/save.hpp"
#include "model/model.hpp"

#include <functional>
#include <string>
#include <vector>

namespace kaya {

struct ReportOrder {
    std::string file;    ///< name of the save, for the title
    std::string version; ///< of this program
    /// Names of the properties of a joint model, in their order; empty when it cannot be loaded.
    std::function<std::vector<std::string>(const std::string& model)> property_names;
};

/// HTML with style, scripts and data in it: what was run, the model in numbers, properties, contacts, energy, histories as curves, and a
/// view of the blocks. The same model gives the same bytes.
std::string report_of(Model& model, const SaveExtras& extras, const ReportOrder& order);

} // namespace kaya
