#include "report/report.hpp"

#include "base/markup_text.hpp"
#include "report/packed.hpp"
#include "report/inside_data.hpp"
#include "report/mark_data.hpp"
#include "report/page_parts.hpp"
#include "report/scene_data.hpp"
#include "report/tables.hpp"
#include "report/template.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

std::string of_kind(std::string_view kind) {
    std::string text;
    for (const auto& part : page_parts())
        if (part.kind == kind) text += part.text;
    return text;
}

std::string decks(const SaveExtras& extras) {
    std::string html;
    for (const auto& deck : extras.decks)
        html += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", markup_text(deck.name),
                            markup_text(deck.content));
    return html.empty() ? "<p>None.</p>\n" : html;
}

/// The states before and that of the model.
std::string states_json(const Model& model, const ReportOrder& order) {
    std::vector<std::string> states;
    const auto add = [&states](const ReportState& state) {
        states.push_back(fmt::format(R"({{"time":{},"cycle":{},"scene":{}}})", state.time, state.cycle, state.scene));
    };
    for (const auto& state : order.before) add(state);
    add(report_state(model, order.centre));
    return fmt::format("[{}]", fmt::join(states, ","));
}

std::string course_json(const std::vector<ReportCurve>& course) {
    std::vector<std::string> curves;
    for (const auto& curve : course) curves.push_back(curve_json(curve.title, curve.cycles, curve.values));
    return fmt::format("[{}]", fmt::join(curves, ","));
}

std::string warning_list(const std::vector<std::string>& warnings) {
    std::string html;
    for (const auto& warning : warnings) html += fmt::format("<pre>{}</pre>\n", markup_text(warning));
    return html;
}

} // namespace

std::string report_of(Model& model, const SaveExtras& extras, const ReportOrder& order) {
    const Units units = units_of(extras);
    return filled(of_kind("html"), {{"title", markup_text(extras.title.empty() ? order.file : extras.title)},
                                    {"style", of_kind("css")},
                                    {"run", run_table(model, extras, order)},
                                    {"blocks", block_table(model)},
                                    {"groups", group_table(model)},
                                    {"zones", zone_table(model)},
                                    {"histories", model.histories.all.empty() ? "" : "shown"},
                                    {"warnings", warning_list(order.warnings)},
                                    {"course", order.course.empty() ? "" : "shown"},
                                    {"materials", material_table(model)},
                                    {"joints", joint_table(model, order)},
                                    {"contacts", contact_table(model)},
                                    {"boundary", boundary_table(model)},
                                    {"energy", energy_table(model)},
                                    {"decks", decks(extras)},
                                    {"scene-data", with_units(states_json(model, order), units)},
                                    {"history-data", histories_json(model.histories, units)},
                                    {"joint-data", with_units(joint_scene_json(model, order), units)},
                                    {"inside-data", with_units(inside_json(model, order.centre), units)},
                                    {"mark-data", with_units(marks_json(model, order.centre), units)},
                                    {"course-data", course_json(order.course)},
                                    {"scripts", of_kind("js")}});
}

} // namespace kaya
