#include "report/report.hpp"

#include "base/markup_text.hpp"
#include "report/packed.hpp"
#include "report/page_parts.hpp"
#include "report/scene_data.hpp"
#include "report/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

std::string section(const char* id, const char* title, const std::string& content) {
    return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, title, content);
}

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

constexpr const char* view =
    R"(<div id="view"><canvas id="blocks" tabindex="0" aria-label="the blocks; drag to turn, wheel to come nearer"></canvas>
<svg id="axes" viewBox="0 0 90 90" aria-hidden="true"></svg><div id="coarse"></div><div id="legend"></div><div id="picked" role="status"></div></div>
<div id="controls"><label id="states">state <input id="state" type="range" min="0" max="0" value="0"> <output id="state-value"></output></label>
<label id="whats">show <select id="what"><option>blocks</option><option>joints</option></select></label>
<label>colour <select id="field"></select></label>
<label>displacements times <input id="factor" type="range" min="0" max="100" value="0"> <output id="factor-value">0</output></label>
<label>cut across <select id="axis"><option>x</option><option>y</option><option>z</option></select>
<input id="cut" type="range" min="0" max="1000" value="1000"></label>
<label><input id="edges" type="checkbox" checked> edges</label> <button id="reset" type="button">from the start</button>
<span id="sides" role="group" aria-label="views"></span></div>
<p class="hint">Drag turns, the wheel or two fingers come nearer, dragging with the right button moves; a click on a block or joint shows its values. Keys: arrows turn, + and - come nearer, 0 is from the start.</p>
<noscript><p>The view needs JavaScript.</p></noscript>
)";

} // namespace

std::string report_of(Model& model, const SaveExtras& extras, const ReportOrder& order) {
    const Units units = units_of(extras);
    const std::string title = markup_text(extras.title.empty() ? order.file : extras.title);
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>\n"
        "<style>{}</style></head><body>\n<h1>{}</h1>\n",
        title, of_kind("css"), title);
    page += section("model", "The model", view);
    page += section("run", "The run", run_table(model, extras, order));
    page += section("parts", "Blocks, groups and zones",
                    block_table(model) + "<h3>Groups</h3>\n" + group_table(model) + zone_table(model));
    if (!model.histories.all.empty())
        page += section("histories", "Histories",
                        "<div id=\"curves\"></div>\n<noscript><p>The curves need JavaScript.</p></noscript>\n");
    if (!order.warnings.empty()) page += section("warnings", "Warnings", warning_list(order.warnings));
    if (!order.course.empty())
        page += section("course", "The course of the run, by cycles", "<div id=\"course-curves\"></div>\n");
    page += section("properties", "Properties",
                    "<h3>Blocks</h3>\n" + material_table(model) + "<h3>Joints</h3>\n" + joint_table(model, order));
    page += section("contacts", "Contacts", contact_table(model));
    page += section("boundary", "Boundary conditions", boundary_table(model));
    page += section("energy", "Energy", energy_table(model));
    page += section("decks", "Decks", decks(extras));
    page += fmt::format(
        "<script type=\"application/json\" id=\"scene-data\">{}</script>\n<script type=\"application/json\" id=\"history-data\">{}</script>\n",
        with_units(states_json(model, order), units), histories_json(model.histories, units));
    page += fmt::format("<script type=\"application/json\" id=\"joint-data\">{}</script>\n",
                        with_units(joint_scene_json(model, order.centre), units));
    page +=
        fmt::format("<script type=\"application/json\" id=\"course-data\">{}</script>\n", course_json(order.course));
    return page + "<script>\n'use strict';\n" + of_kind("js") + "</script>\n</body></html>\n";
}

} // namespace kaya
