// plot: pictures of the model, of histories and of tables.
#include "commands/session/handlers.hpp"

#include "base/lower_case.hpp"
#include "commands/plot/pictures.hpp"
#include "lang/commands/language.hpp"
#include "lang/interp/deck.hpp"
#include "lang/interp/named_word.hpp"
#include "lang/modern/language.hpp"
#include "model/fields/sampling.hpp"
#include "model/measure/block_box.hpp"
#include "pictures/picture_page.hpp"
#include "scene/svg_chart.hpp"
#include "system/whole_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <filesystem>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

lang::RangePhrase phrase_of(const std::string& text) {
    if (text.empty()) return {};
    const auto bound = lang::bind_text(lang::classic(), lang::source_from_text("plot", "find " + text), {});
    return std::any_cast<const lang::List&>(bound->steps.front().command.command).range;
}

Shown shown_by(Session& session, const PlotItem& item) {
    Shown shown;
    shown.blocks =
        select(session.engine.model, ObjectKind::block, session.test_of(ObjectKind::block, phrase_of(item.range)));
    shown.deformation = item.deformed - 1;
    shown.cut = item.cut;
    if (shown.cut && item.cut_in_middle && !shown.blocks.empty()) {
        Eigen::AlignedBox3d whole;
        for (const Row block : shown.blocks) {
            const auto [low, high] = block_box(session.engine.model, block);
            whole.extend(low).extend(high);
        }
        shown.cut->origin = whole.center();
    }
    return shown;
}

/// "slip-now slip-past" of a sub-contact, by the words of its joint model.
std::string state_words(const Session& session, const Model& model, Row row) {
    const Row properties = model.contacts.properties[model.sub_contacts.contact[row]];
    const JointModel* joint =
        properties == no_row
            ? nullptr
            : session.engine.joints.find(model.joint_properties[static_cast<std::size_t>(properties)].model);
    std::vector<std::string> words;
    if (joint != nullptr)
        for (std::size_t i = 0; i < joint->states.size(); ++i)
            if ((model.sub_contacts.state[row] & (1U << i)) != 0) words.push_back(joint->states[i]);
    // "slipping now" implies "slipped", which is left out.
    std::erase_if(words, [&](const std::string& word) {
        return word.ends_with("-past") &&
               std::ranges::find(words, word.substr(0, word.size() - 4) + "now") != words.end();
    });
    return words.empty() ? "elastic" : fmt::format("{}", fmt::join(words, ", "));
}

ColourField joint_field(const Session& session, const std::string& word) {
    ColourField field = *find_joint_field(word.empty() ? "slip" : word);
    if (word == "state") {
        field.title = "state";
        field.get = [&session](const Model& model, Row row) -> FieldValue { return state_words(session, model, row); };
    }
    return field;
}

/// Blocks would hide objects between and inside them: only their edges are drawn then.
void add_item(Session& session, Scene& scene, const PlotItem& item, bool edges_only) {
    const Model& model = session.engine.model;
    const Shown shown = shown_by(session, item);
    if (shown.blocks.empty())
        throw Diagnostic("there are no blocks to draw", "make blocks, show them with 'seek', or use another range");
    if (item.kind != PlotItem::Kind::blocks) {
        const bool of_zones = item.kind == PlotItem::Kind::crosses || item.kind == PlotItem::Kind::iso_surfaces;
        if (of_zones && std::ranges::none_of(shown.blocks, [&](Row b) { return model.blocks.zones[b].count > 0; }))
            throw Diagnostic("stress is in zones, and no block has any", "'gen edge' makes zones");
        if (item.kind == PlotItem::Kind::crosses) add_crosses(scene, model, shown, item.scale);
        else if (item.kind == PlotItem::Kind::iso_surfaces)
            add_iso_surfaces(scene, model, shown, *find_colour_field(item.field.empty() ? "disp" : item.field),
                             item.levels);
        else if (item.kind == PlotItem::Kind::beams || item.kind == PlotItem::Kind::liners) {
            const bool beams = item.kind == PlotItem::Kind::beams;
            const ObjectKind kind = beams ? ObjectKind::beam_element : ObjectKind::liner_element;
            if (count_of(model, kind) == 0)
                throw Diagnostic(fmt::format("there are no {} to draw", beams ? "beams" : "liners"),
                                 fmt::format("'structure {}' makes them", beams ? "beam" : "liner"));
            add_members(scene, model, shown, kind, item.field);
        } else if (item.kind == PlotItem::Kind::cables) {
            if (model.structures.cables.empty())
                throw Diagnostic("there are no cables to draw", "'structure cable' makes them");
            add_cables(scene, model, shown, item.field);
        } else if (item.kind == PlotItem::Kind::arrows)
            add_arrows(scene, model, shown, item.field == "velocity", item.scale);
        else if (model.contacts.size() == 0)
            throw Diagnostic("there are no joints to draw yet", "contacts are found by 'cycle 0'");
        else add_joints(scene, model, shown, joint_field(session, item.field));
        if (edges_only) return; // a separate item shows the blocks
        PlotItem outline = item;
        outline.kind = PlotItem::Kind::blocks;
        outline.field.clear();
        return add_item(session, scene, outline, true);
    }
    add_blocks(scene, model, shown, item.field.empty() ? std::nullopt : find_colour_field(item.field));
    if (edges_only) {
        scene.layers.erase(scene.layers.end() - 2);
        scene.layers.back().opacity *= 0.6F;
    }
}

Scene scene_of(Session& session, const PlotView& view) {
    Scene scene = view.settings;
    if (scene.title.empty())
        scene.title = !session.deck.title.empty() ? session.deck.title : fs::path(session.deck.file).stem().string();
    if (session.engine.model.clock.cycle > 0)
        scene.note =
            fmt::format("cycle {}, time {:.4g}", session.engine.model.clock.cycle, session.engine.model.clock.time);
    const auto has = [&](PlotItem::Kind kind) {
        return std::ranges::find(view.items, kind, &PlotItem::kind) != view.items.end();
    };
    using enum PlotItem::Kind;
    const bool outside = has(blocks), inside = has(joints) || has(arrows) || has(crosses) || has(iso_surfaces) ||
                                               has(cables) || has(beams) || has(liners);
    for (const PlotItem& item : view.items) {
        if (item.deformed != 1) scene.note += fmt::format(", displacements {:g} times as large", item.deformed);
        add_item(session, scene, item, inside && outside);
    }
    for (ColourBar& bar : scene.bars) bar.title = session.deck.units.in_brackets(bar.title);
    if (session.deck.units.given()) scene.length_unit = session.deck.units.label("length");
    return scene;
}

const History& plotted_history(const Histories& histories, std::int64_t number) {
    const auto found = std::ranges::find(histories.all, number, &History::number);
    if (found == histories.all.end())
        throw Diagnostic(fmt::format("there is no history {}", number), "'list hist' shows those that are there");
    return *found;
}

/// Quantity, and its unit where it is a field.
std::string axis_name(const History& history) {
    std::string name = history.label;
    std::ranges::replace(name, '_', ' ');
    if (const std::string unit = unit_of(history.source); unit != "-") name += fmt::format(" [{}]", unit);
    return name;
}

void add_histories(const Histories& histories, const PlotItem& item, Chart& chart) {
    for (const std::int64_t number : item.numbers) (void)plotted_history(histories, std::abs(number));
    const History* versus = item.versus ? &plotted_history(histories, std::abs(*item.versus)) : nullptr;
    const std::size_t samples = histories.time.size();
    const auto value = [](const History& history, std::size_t sample, double sign) {
        const std::size_t place = sample - history.first_sample;
        return sample < history.first_sample || place >= history.values.size() ? std::nan("")
                                                                               : sign * history.values[place];
    };
    for (const std::int64_t number : item.numbers) {
        const History& history = plotted_history(histories, std::abs(number));
        Curve curve{axis_name(history), {}, {}};
        for (std::size_t i = 0; i < samples; ++i) {
            curve.x.push_back(versus != nullptr ? value(*versus, i, *item.versus < 0 ? -1 : 1) : histories.time[i]);
            curve.y.push_back(value(history, i, number < 0 ? -1 : 1));
        }
        chart.curves.push_back(std::move(curve));
    }
    chart.x_label = versus != nullptr ? axis_name(*versus) : "time";
}

/// Poles of fractures by their networks.
Chart fracture_net(const std::map<std::string, Network>& networks) {
    NamedDirections poles;
    for (const auto& [name, fractures] : networks) {
        auto& normals = poles.emplace_back(name.empty() ? "no name" : name, std::vector<Vec3>{}).second;
        for (const Fracture& fracture : fractures) normals.push_back(plane_of(fracture).normal);
    }
    if (poles.empty()) throw Diagnostic("there are no fractures to draw yet", "make them before: fracture create ...");
    return direction_net(poles, "Poles of fractures");
}

Chart net_of(Session& session, const PlotView& view, const PlotItem& item) {
    Chart chart = item.field == "dfn" ? fracture_net(session.deck.surface_sets.networks)
                                      : joint_net(session.engine.model, shown_by(session, item), item.field == "slip");
    if (chart.curves.empty())
        throw Diagnostic(item.field == "slip" ? "no joint has slipped" : "there are no joints to draw yet",
                         item.field == "slip" ? "" : "contacts are found by 'cycle 0'");
    chart.width = view.settings.width, chart.height = view.settings.height;
    if (!view.settings.title.empty()) chart.title = view.settings.title;
    return chart;
}

/// "m" of "height [m]".
std::string_view unit_in(const std::string& label) {
    const auto open = label.rfind('[');
    if (open == label.npos) return {};
    return std::string_view(label).substr(open + 1, label.find_first_of(",]", open) - open - 1);
}

/// Whether both axes have lengths in one unit, and neither is five times as long as the other.
bool compares_lengths(const Chart& chart) {
    constexpr std::array<std::string_view, 7> lengths{"length", "m", "cm", "mm", "km", "ft", "in"};
    const std::string_view unit = unit_in(chart.x_label);
    if (unit != unit_in(chart.y_label) || std::ranges::find(lengths, unit) == lengths.end()) return false;
    const auto size = [&](std::vector<double> Curve::*values) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Curve& curve : chart.curves)
            for (const double value : curve.*values)
                if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
        return high - low;
    };
    constexpr double most = 5;
    const double across = size(&Curve::x), upward = size(&Curve::y);
    return across < most * upward && upward < most * across;
}

Chart chart_of(Session& session, const PlotView& view) {
    if (const auto net = std::ranges::find(view.items, PlotItem::Kind::net, &PlotItem::kind); net != view.items.end()) {
        if (view.items.size() > 1)
            throw Diagnostic("a net needs a separate picture", "write a second plot line for the rest");
        return net_of(session, view, *net);
    }
    Chart chart;
    chart.width = view.settings.width;
    chart.height = view.settings.height;
    chart.title = !view.settings.title.empty() ? view.settings.title : session.deck.title;
    for (const PlotItem& item : view.items) {
        const std::size_t before = chart.curves.size();
        if (item.kind == PlotItem::Kind::histories) add_histories(session.engine.model.histories, item, chart);
        else
            for (const std::int64_t number : item.numbers) {
                const auto& tables = session.engine.scripts->tables();
                const auto found = tables.find(number);
                if (found == tables.end()) throw Diagnostic(fmt::format("there is no table {}", number));
                const std::string& given = found->second.name;
                Curve& curve =
                    chart.curves.emplace_back(Curve{given.empty() ? fmt::format("table {}", number) : given, {}, {}});
                for (const auto& [x, y] : found->second.points()) curve.x.push_back(x), curve.y.push_back(y);
            }
        for (std::size_t i = before; i < chart.curves.size(); ++i) chart.curves[i].marks = item.marks;
        if (!item.x_label.empty()) chart.x_label = item.x_label;
        if (!item.y_label.empty()) chart.y_label = item.y_label;
    }
    const bool drawn = std::ranges::any_of(chart.curves, [](const Curve& curve) { return !curve.x.empty(); });
    if (!drawn)
        throw Diagnostic("there are no samples to draw", "name histories or tables that hold values: plot hist 1 vs 2");
    if (chart.y_label.empty() && chart.curves.size() == 1) chart.y_label = chart.curves.front().name;
    if (chart.title.empty()) chart.title = chart.curves.front().name;
    if (session.deck.units.given() && chart.x_label == "time") chart.x_label = "time [time]";
    for (std::string* text : {&chart.x_label, &chart.y_label}) *text = session.deck.units.in_brackets(*text);
    for (Curve& curve : chart.curves) curve.name = session.deck.units.in_brackets(curve.name);
    chart.equal = compares_lengths(chart);
    for (const PlotItem& item : view.items) chart.equal = item.equal.value_or(chart.equal);
    return chart;
}

/// A drawing as the bytes of its file, by the program that draws.
template <class Picture> std::string drawn(Session& session, Picture picture, const std::string& suffix) {
    picture.paper.fine = suffix != ".png";
    if (!session.painter) {
        std::error_code ignored;
        session.painter =
            std::make_shared<Painter>(fs::read_symlink("/proc/self/exe", ignored).parent_path() / "kaya-painter");
    }
    const std::int32_t width = picture.width, height = picture.height, dpi = picture.paper.dpi;
    const std::string png = session.painter->png(Drawing(std::move(picture)));
    constexpr std::int32_t of_screens = 96;
    if (suffix == ".svg") return svg_page(png, width, height);
    return suffix == ".pdf" ? pdf_page(png, width, height, dpi > 0 ? dpi : of_screens) : png;
}

/// Curves in SVG files are lines, and need no other program.
std::string drawn_chart(Session& session, Chart chart, const std::string& suffix) {
    return suffix == ".svg" ? svg_of(chart) : drawn(session, std::move(chart), suffix);
}

bool is_chart(const PlotItem& item) { return item.kind >= PlotItem::Kind::histories; }

/// The picture as the bytes of its file; the suffix selects the format.
std::string picture_of(Session& session, const PlotView& view, const std::string& suffix) {
    if (view.items.empty()) throw Diagnostic("there is nothing to draw", "name what the picture shows: plot add block");
    const bool chart = std::ranges::all_of(view.items, is_chart);
    if (!chart && std::ranges::any_of(view.items, is_chart))
        throw Diagnostic("one picture shows either the model or curves", "write a second plot line for the curves");
    if (!chart && view.pair.empty()) return drawn(session, scene_of(session, view), suffix);
    if (!chart) {
        const auto kept = session.plots.kept.find(view.pair);
        if (kept == session.plots.kept.end())
            throw Diagnostic(fmt::format("no picture is kept as '{}'", view.pair),
                             fmt::format("`plot block keep {}` keeps one, earlier in the run", view.pair));
        return drawn(session, side_by_side(kept->second, scene_of(session, view)), suffix);
    }
    if (!view.pair.empty()) throw Diagnostic("curves do not stand with another picture", "leave out 'pair'");
    Chart curves = chart_of(session, view);
    curves.paper = view.settings.paper;
    return drawn_chart(session, std::move(curves), suffix);
}

/// Pictures are PNG, SVG or PDF files: another suffix of an old deck becomes .png.
std::string picture_name(Session& session, const std::string& given) {
    fs::path path(given);
    if (given.empty()) {
        const std::string stem = fs::path(session.deck.file).stem().string();
        path = fmt::format("{}-plot-{}.png", stem.empty() ? "kaya" : stem, ++session.plots.pictures);
    }
    const std::string suffix = lower_case(path.extension().string());
    static constexpr std::array written{".png", ".svg", ".pdf"};
    static constexpr std::array others{".bmp", ".jpg", ".jpeg", ".pcx", ".ps", ".dxf", ".wmf", ".tif"};
    if (std::ranges::find(written, suffix) != written.end()) return path.string();
    if (std::ranges::find(others, suffix) != others.end()) return path.replace_extension(".png").string();
    return path.string() + ".png";
}

/// For a later picture that has it at its side.
void keep_picture(Session& session, const PlotView& view, const std::string& name) {
    try {
        if (std::ranges::any_of(view.items, is_chart))
            throw Diagnostic("curves are not kept", "only pictures of the model stand side by side");
        session.plots.kept[name] = scene_of(session, view);
    } catch (const Diagnostic& problem) {
        session.warn_once(fmt::format("no picture: {}", problem.message), problem.hint);
    }
}

/// One picture at once, or a movie that begins with the next cycle.
void write_picture(Session& session, const PlotView& view, const PlotLine& line) {
    if (!line.keep.empty()) {
        keep_picture(session, view, line.keep);
        if (line.file.empty() && view.pair.empty()) return;
    }
    const std::string file = picture_name(session, line.file);
    if (line.interval == 0) {
        if (write_view(session, view, file)) session.program.output.say(fmt::format("picture: {}", file));
        return;
    }
    session.plots.movies.push_back(
        {view, fs::path(file).replace_extension().string(), line.interval, session.engine.model.clock.cycle, 0});
}

/// Writes the result of `bytes`. A missing picture does not end a run: false, with a note.
bool write_bytes(Session& session, const std::string& file, const std::function<std::string()>& bytes) {
    std::string content;
    try {
        content = bytes();
    } catch (const Diagnostic& problem) {
        session.stop_if_interrupted();
        const std::string text = fmt::format("no picture: {}", problem.message);
        if (problem.fault == Fault::run) session.note_once(text, problem.hint); // of the machine, not of the deck
        else session.warn_once(text, problem.hint);
        return false;
    }
    write_whole_file(session.program.output_file(file), content);
    return true;
}

} // namespace

bool write_view(Session& session, const PlotView& view, const std::string& file) {
    return write_bytes(session, file,
                       [&] { return picture_of(session, view, lower_case(fs::path(file).extension().string())); });
}

void write_chart(Session& session, const Chart& chart, const std::string& given) {
    const std::string file = picture_name(session, given);
    const std::string suffix = lower_case(fs::path(file).extension().string());
    if (write_bytes(session, file, [&] { return drawn_chart(session, chart, suffix); }))
        session.program.output.say(fmt::format("picture: {}", file));
}

std::vector<lang::Plot::Item> with_script_values(Session& session, std::vector<lang::Plot::Item> words) {
    for (auto& word : words)
        if (word.script) {
            word.text = session.symbol_text(word.text);
            word.script = false;
        }
    return words;
}

namespace {

/// `plot 'front' export bitmap`: a name before the words chooses the plot that they act on, and takes itself out of the line. True when
/// there is one.
bool choose_plot(Session& session, std::vector<lang::Plot::Item>& words) {
    if (words.size() < 2 || !words.front().quoted || words[1].quoted) return false;
    auto& plots = session.plots;
    const std::string name = words.front().text;
    words.erase(words.begin());
    const bool makes = words.front().folded == "create";
    if (makes) words.erase(words.begin());
    if (!makes && !plots.views.contains(name))
        session.warn_once(fmt::format("there is no plot '{}' yet", name),
                          fmt::format("it is made now, and shows the blocks; `plot create '{}'` makes one", name));
    if (makes) plots.views[name] = {};
    plots.current = name;
    return true;
}

} // namespace

void run(Session& session, const lang::Plot& command) {
    auto words = with_script_values(session, command.words);
    auto& plots = session.plots;
    const bool named_first = choose_plot(session, words);
    PlotLine line = read_plot_line(words, command.range, plots.views[plots.current]);
    if (!line.unknown.empty()) {
        Diagnostic ignored(fmt::format("plot ignores '{}'", fmt::join(line.unknown, " ")),
                           line.meant.empty() ? "docs/commands/plot.md lists what it draws"
                                              : fmt::format("did you mean '{}'?", line.meant));
        lang::place_problem(ignored, lang::language(), command.place);
        if (session.program.said_once.insert(ignored.message).second) session.warn(std::move(ignored));
    }
    switch (line.task) {
    case PlotLine::Task::draw: {
        PlotView once = std::move(line.view);
        once.items = std::move(line.items);
        if (!once.items.empty()) write_picture(session, once, line);
        return;
    }
    case PlotLine::Task::create: plots.views[line.name] = {}; [[fallthrough]];
    case PlotLine::Task::choose: plots.current = line.name; break;
    case PlotLine::Task::clear: plots.views[plots.current] = {}; return;
    case PlotLine::Task::write: {
        const auto named = line.name.empty() ? plots.views.end() : plots.views.find(line.name);
        if (!line.name.empty() && named == plots.views.end())
            return session.warn_once(fmt::format("there is no plot '{}'", line.name), "plot create makes one");
        PlotView view = std::move(line.view);
        if (named != plots.views.end()) view.items = named->second.items;
        view.items.insert(view.items.end(), line.items.begin(), line.items.end());
        if (named_first && view.items.empty()) view.items.emplace_back();
        write_picture(session, view, line);
        return;
    }
    case PlotLine::Task::settings:
    case PlotLine::Task::add: break;
    }
    PlotView& view = plots.views[plots.current];
    if (line.task != PlotLine::Task::create && line.task != PlotLine::Task::choose) view.settings = line.view.settings;
    view.items.insert(view.items.end(), line.items.begin(), line.items.end());
}

void add_handlers(HandlerTable& table, lang::PlotCommands list) { fill(table, list); }

} // namespace kaya
