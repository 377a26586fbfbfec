// The model in tables of HTML.
#pragma once

#include "io/save.hpp"
#include "model/tables/model.hpp"
#include "report/report_order.hpp"

#include <string>

namespace kaya {

std::string run_table(Model& model, const SaveExtras& extras, const ReportOrder& order);
std::string block_table(const Model& model);
std::string group_table(const Model& model);
std::string zone_table(const Model& model);
std::string material_table(const Model& model);
std::string joint_table(const Model& model, const ReportOrder& order);
std::string contact_table(const Model& model);
std::string boundary_table(const Model& model);
std::string energy_table(const Model& model);

} // namespace kaya
