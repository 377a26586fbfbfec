#include "app/joint_bench.hpp"

#include "base/diagnostic.hpp"
#include "commands/world/lua_joint_models.hpp"
#include "commands/program/output.hpp"
#include "jointtest/bench.hpp"
#include "study/command_output.hpp"
#include "system/whole_file.hpp"
#include "zonetest/zone_bench.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <memory>

namespace kaya {

namespace {

namespace fs = std::filesystem;

struct Order {
    BenchOrder bench;
    std::vector<std::string> settings;       ///< word=value
    std::string fitted, offsets = "opening"; ///< words with commas between
    bool strict = false, no_picture = false;
};

std::pair<std::string, double> setting_of(const std::string& text) {
    const auto equals = text.find('=');
    double value = 0;
    if (equals != text.npos) {
        const char *first = text.data() + equals + 1, *last = text.data() + text.size();
        const auto [end, error] = std::from_chars(first, last, value);
        if (error == std::errc() && end == last && first != last) return {text.substr(0, equals), value};
    }
    throw Diagnostic(fmt::format("'{}' is not a property and its value", text), "write it as jkn=1e5");
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < text.size();) {
        const auto end = std::min(text.find(',', begin), text.size());
        if (end > begin) words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// gnuplot may be missing: the script is kept. gnuplot is not given the name of an output file: it would follow links.
std::string draw(const fs::path& script) {
    fs::path picture = script;
    picture.replace_extension(".png");
    const auto drawn =
        output_of({"gnuplot", "-e", "set terminal png size 900,900", fs::absolute(script).string()}, false);
    if (drawn.status != 0) return {};
    write_whole_file(picture.string(), drawn.output);
    return fmt::format(", {}", picture.string());
}

int carry_out(Order& order, const std::vector<fs::path>& folders) {
    for (const auto& text : order.settings) order.bench.values.push_back(setting_of(text));
    order.bench.fitted = words_of(order.fitted);
    order.bench.offsets = words_of(order.offsets);
    JointRegistry registry;
    registry.set_path(folders);
    add_lua_loader(registry);
    registry.tables().set_source([missed = order.bench.missed_tables](const std::string& name) {
        missed->insert(name);
        return std::nullopt;
    });
    const auto report = run_bench(registry, order.bench);
    print_result(report.text + (order.no_picture ? "" : draw(report.figure)));
    return report.doubtful || (order.strict && report.odd) ? static_cast<int>(Fault::run) : 0;
}

struct ZoneOrder {
    ZoneBenchOrder bench;
    std::vector<std::string> settings; ///< word=value
    std::vector<double> stress;
    bool strict = false, no_picture = false;
};

int carry_out(ZoneOrder& order, const std::vector<fs::path>& folders) {
    for (const auto& text : order.settings) order.bench.values.push_back(setting_of(text));
    std::ranges::copy(order.stress, order.bench.settings.stress.begin());
    ZoneModels models;
    models.set_path(folders);
    const auto report = run_zone_bench(models, order.bench);
    print_result(report.text + (order.no_picture ? "" : draw(report.figure)));
    return order.strict && report.odd ? static_cast<int>(Fault::run) : 0;
}

} // namespace

void add_joint_bench(CLI::App& app, const std::function<std::vector<fs::path>()>& joint_folders,
                     std::function<int()>& chosen) {
    const auto add = [&](const char* name, const char* help) {
        auto order = std::make_shared<Order>();
        auto* sub = app.add_subcommand(name, help);
        sub->add_option("model", order->bench.model, "name or file of the joint model")->required();
        sub->add_option("path", order->bench.path, "CSV file of the path: docs/joint-bench.md")->required();
        sub->add_option("values", order->settings, "properties: jkn=1e5 jks=1e4 jfric=30");
        sub->add_option("--steps", order->bench.settings.steps, "steps between two points of the path")
            ->check(CLI::Range(1, 100'000'000));
        sub->add_option("--area", order->bench.settings.area, "area of the sub-contact")->check(CLI::PositiveNumber);
        sub->add_option("--output", order->bench.output, "name of the files, without an ending");
        sub->add_flag("--no-picture", order->no_picture, "no PNG, even if gnuplot is installed");
        sub->callback([order, joint_folders, &chosen] {
            chosen = [order, joint_folders] { return carry_out(*order, joint_folders()); };
        });
        return std::pair(sub, order);
    };
    const auto [testing, test] =
        add("jtest", "lead one sub-contact of a joint model along a path and check the response");
    testing->add_flag("--strict", test->strict, "exit with 2 if the model behaves oddly");
    const auto [fitting, fit] = add("jfit", "fit properties of a joint model to a measured curve");
    fitting->add_option("--fit", fit->fitted, "the properties, separated by commas")->required();
    fitting->add_option("--offset", fit->offsets, "measured columns with unknown zero, separated by commas; none: \"\"")
        ->default_str("opening");
    fit->bench.settings.steps = 0; // as many as the result needs
}

void add_zone_bench(CLI::App& app, const std::function<std::vector<fs::path>()>& folders,
                    std::function<int()>& chosen) {
    auto order = std::make_shared<ZoneOrder>();
    auto* sub = app.add_subcommand("ztest", "lead one zone of a zone model along a path and check the response");
    sub->add_option("model", order->bench.model, "name or file of the zone model")->required();
    sub->add_option("path", order->bench.path, "CSV file of the path: docs/writing-a-zone-model.md")->required();
    sub->add_option("values", order->settings, "properties: bulk=4e9 shear=3e9 cohesion=1e6 friction=30");
    sub->add_option("--stress", order->stress, "initial stress: xx,yy,zz,xy,xz,yz, tension positive")
        ->delimiter(',')
        ->expected(6);
    sub->add_option("--steps", order->bench.settings.steps, "steps between two points of the path")
        ->check(CLI::Range(1, 1'000'000));
    sub->add_option("--volume", order->bench.settings.volume, "volume of the zone")->check(CLI::PositiveNumber);
    sub->add_option("--output", order->bench.output, "name of the files, without an ending");
    sub->add_flag("--no-picture", order->no_picture, "no PNG, even if gnuplot is installed");
    sub->add_flag("--strict", order->strict, "exit with 2 if the model behaves oddly");
    sub->callback([order, folders, &chosen] { chosen = [order, folders] { return carry_out(*order, folders()); }; });
}

} // namespace kaya
