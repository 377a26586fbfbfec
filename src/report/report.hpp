// A saved model as one page that a browser opens without a network.
#pragma once

#include "io/save.hpp"
#include "model/tables/model.hpp"
#include "report/report_order.hpp"

#include <string>

namespace kaya {

/// HTML with style, scripts and data in it: the deck, the model in numbers, properties, contacts, energy, histories as curves, and a view
/// of the blocks, over time when there are earlier states. The same model gives the same bytes.
std::string report_of(Model& model, const SaveExtras& extras, const ReportOrder& order);

} // namespace kaya
