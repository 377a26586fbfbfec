// The surfaces of the blocks, with the quantities for their colours, for the view in the browser.
#pragma once

#include "base/units.hpp"
#include "model/tables/model.hpp"
#include "report/report_order.hpp"

#include <span>
#include <string>
#include <string_view>

namespace kaya {

/// `centre` is the origin of places: the same for all states of a page (report_centre of one of them).
ReportState report_state(const Model& model, const Vec3& centre);
Vec3 report_centre(const Model& model);

/// A JSON object: blocks with their numbers, corners, triangles and edges, and the fields of blocks and corners with their units.
std::string scene_json(const Model& model, const Vec3& centre);

/// The same for joints: the polygons where faces are in contact, one object for each contact; null when there is none.
std::string joint_scene_json(const Model& model, const ReportOrder& order);

/// A curve as JSON, with numbers of one kind along it.
std::string curve_json(std::string_view title, std::span<const double> along, std::span<const double> values);

/// The same with the quantities of its fields, "unit":"length", as labels of a system of units.
std::string with_units(std::string_view json, const Units& units);

/// Histories with their times, as a JSON list.
std::string histories_json(const Histories& histories, const Units& units);

} // namespace kaya
