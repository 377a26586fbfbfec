#include "app/model_commands.hpp"

#include "app/model_builder.hpp"
#include "app/new_model.hpp"
#include "app/permissions.hpp"
#include "base/diagnostic.hpp"
#include "base/terminal_text.hpp"
#include "commands/world/lua_joint_models.hpp"
#include "commands/program/output.hpp"
#include "laws/joint_model.hpp"
#include "laws/property_roles.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// "stiffness-normal (jkn, kn), friction = 30"
std::string properties_text(const LawTable& model) {
    std::vector<std::string> texts;
    for (const auto& property : model.properties) {
        std::string text = property.name;
        if (!property.aliases.empty()) text += fmt::format(" ({})", fmt::join(property.aliases, ", "));
        texts.push_back(text);
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

void describe(const LawTable& model, const char* kind, std::uint32_t interface, bool keeps_objects = false) {
    const auto line = [](const char* what, const std::string& text) {
        if (!text.empty()) print_result(fmt::format("  {:<11} {}", what, text));
    };
    std::vector<std::string> kept;
    for (const auto& variable : model.history) kept.push_back(variable.name);
    print_result(model.name);
    line("kind", kind);
    line("title", model.title);
    line("file", model.file.string());
    line("version", model.version);
    line("interface", fmt::format("{}", interface));
    line("properties", properties_text(model));
    line("states", fmt::format("{}", fmt::join(model.states, ", ")));
    line("keeps", fmt::format("{}", fmt::join(kept, ", ")));
    line("objects", keeps_objects ? "one for each sub-contact" : "");
}

void describe(const JointModel& model) {
    describe(model, "joint model", model.descriptor().interface_version, model.keeps_objects());
    std::vector<std::string> roles;
    for (const auto& property : model.properties)
        if (property.role != KAYA_JROLE_NONE && word_of(property.role) != property.name)
            roles.push_back(fmt::format("{} is {}", property.name, word_of(property.role)));
    if (!roles.empty()) print_result(fmt::format("  {:<11} {}", "roles", fmt::join(roles, ", ")));
    std::vector<std::string> fields;
    for (const auto& field : model.fields) fields.push_back(field.name);
    if (!fields.empty()) print_result(fmt::format("  {:<11} {}", "fields", fmt::join(fields, ", ")));
}
void describe(const ZoneModel& model) { describe(model, "zone model", KAYA_ZMODEL_INTERFACE); }

/// The builder of a library has seen its source. Without a home folder only its folder allows it: --joints.
void allow_built(const fs::path& library) {
    try {
        allow(library);
    } catch (const Diagnostic& problem) {
        print_text(stderr, fmt::format("note: the library is not allowed for good: {}\n", problem.message));
    }
}

/// Lists the requested models, or all that are found; 1 when one of them cannot be loaded.
int list_plugins(const std::vector<std::string>& names, const std::vector<fs::path>& folders) {
    int status = 0;
    JointRegistry registry;
    registry.set_path(folders);
    add_lua_loader(registry);
    const auto of_joints = registry.available(), of_zones = registry.zones.available();
    struct Wanted {
        std::string name;
        bool zone_model;
    };
    std::vector<Wanted> wanted;
    const auto add = [&](const std::string& name) { // a name may belong to one of each
        const bool in_zones = std::ranges::find(of_zones, name) != of_zones.end();
        const bool in_joints = std::ranges::find(of_joints, name) != of_joints.end();
        if (in_joints || !in_zones) wanted.push_back({name, false});
        if (in_zones) wanted.push_back({name, true});
    };
    if (names.empty()) {
        for (const auto& name : of_joints) wanted.push_back({name, false});
        for (const auto& name : of_zones) wanted.push_back({name, true});
    }
    for (const auto& name : names) add(name);
    for (const auto& [name, zone_model] : wanted) {
        try {
            if (zone_model) describe(registry.zones.get(name));
            else describe(registry.get(name));
        } catch (const Diagnostic& error) {
            print_result(fmt::format("{}\n  {:<11} {}", name, "refused", error.message));
            status = static_cast<int>(Fault::deck);
        }
    }
    return status;
}

/// `jmodel build` and `zmodel build`, apart from the options of sources for 3DEC.
CLI::App* add_build(CLI::App* group, const std::shared_ptr<BuildOrder>& order, const char* help) {
    auto* building = group->add_subcommand("build", help);
    building->add_option("source", order->sources, "its .cpp files")->required();
    building->add_option("--into", order->folder, "folder of the library; the current folder if not given");
    building->add_option("--compiler", order->compiler, "the compiler; CXX, c++, g++ or clang++ if not given");
    return building;
}

void add_build_flags(CLI::App* building, const std::shared_ptr<BuildOrder>& order) {
    building
        ->add_option("--flag", order->flags, "one more word for the compiler: --flag=-g; may be given several times")
        ->allow_extra_args(false);
}

/// Builds the library, loads it once and describes it.
template <class Models> int build(const BuildOrder& order, const fs::path& program_folder) {
    const fs::path library = build_model(order, include_folder(program_folder));
    Models models;
    describe(models.get(fs::absolute(library).string()));
    allow_built(library);
    return 0;
}

void add_jmodel(CLI::App& app, const fs::path& program_folder, std::function<int()>& chosen) {
    auto* jmodel = app.add_subcommand("jmodel", "make a joint model");
    jmodel->require_subcommand(1);
    auto order = std::make_shared<BuildOrder>();
    auto* building = add_build(
        jmodel, order, "compile sources of a joint model, written for kaya or for 3DEC 4, 5, 7 or 9, into a library");
    building->add_option("--std", order->standard, "language standard of sources for 3DEC: gnu++17");
    add_build_flags(building, order);
    building->add_flag("--displacement-at-end", order->displacement_at_end,
                       "normal_disp_ and shear_disp_ of a source for 3DEC include the increment of the step");
    building->add_flag("--as-it-is", order->as_it_is, "without the macro that makes std::exception(\"text\") compile");
    building->add_flag("--show", order->show, "show the compiler's line");
    building->callback([=, &chosen] { chosen = [=] { return build<JointRegistry>(*order, program_folder); }; });
}

void add_zmodel(CLI::App& app, const fs::path& program_folder, std::function<int()>& chosen) {
    auto* zmodel = app.add_subcommand("zmodel", "make a zone model");
    zmodel->require_subcommand(1);
    auto order = std::make_shared<BuildOrder>();
    order->zone_model = true;
    auto* building = add_build(zmodel, order, "compile sources of a zone model into a library");
    add_build_flags(building, order);
    building->add_flag("--show", order->show, "show the compiler's line");
    building->callback([=, &chosen] { chosen = [=] { return build<ZoneModels>(*order, program_folder); }; });
}

using Folders = std::function<std::vector<fs::path>()>;

struct Writing {
    std::array<std::string_view, 2> kinds; ///< of its templates
    const char* next;                      ///< the next step for the user
};

/// `new-jmodel` and `new-zmodel`: Models gives the names in use.
template <class Models> void add_new(CLI::App& app, const char* command, const char* help, Writing native,
                                     std::optional<Writing> lua, const Folders& folders, std::function<int()>& chosen) {
    auto name = std::make_shared<std::string>();
    auto in_lua = std::make_shared<bool>(false);
    auto* making = app.add_subcommand(command, help);
    making->add_option("name", *name, "its name")->required();
    if (lua) making->add_flag("--lua", *in_lua, "in Lua, which needs no compiler");
    making->callback([=, &chosen] {
        chosen = [=] {
            const Writing& writing = *in_lua ? *lua : native;
            Models models;
            models.set_path(folders());
            for (const auto& file : write_new_model(writing.kinds, {*name, ".", models.available()}))
                print_result(file.string());
            print_result(fmt::format(fmt::runtime(writing.next), *name));
            return 0;
        };
    });
}

void add_plugin_list(CLI::App& app, const Folders& folders, std::function<int()>& chosen) {
    auto* plugin = app.add_subcommand("plugin", "inspect joint and zone models");
    plugin->require_subcommand(1);
    auto names = std::make_shared<std::vector<std::string>>();
    auto* listing =
        plugin->add_subcommand("list", "file, name, versions, properties and states of joint and zone models");
    listing->add_option("model", *names, "names or files; all available ones if not given");
    listing->callback([=, &chosen] { chosen = [=] { return list_plugins(*names, folders()); }; });
}

} // namespace

void add_model_commands(CLI::App& app, const fs::path& program_folder, const Folders& joint_folders,
                        std::function<int()>& chosen) {
    add_jmodel(app, program_folder, chosen);
    add_zmodel(app, program_folder, chosen);
    add_new<JointRegistry>(app, "new-jmodel", "write a joint model to start from: source, deck, test and page",
                           {{"joint", "joint-shared"},
                            "build it:  kaya jmodel build {0}/{0}.cpp --into {0}\ntest it:   kaya {0}/test-{0}.3dd\n"},
                           Writing{{"joint-lua", "joint-shared"}, "test it:   kaya --joints {0} {0}/test-{0}.3dd\n"},
                           joint_folders, chosen);
    add_new<ZoneModels>(
        app, "new-zmodel", "write a zone model to start from: source, path, test and page",
        {{"zone"},
         "build it:  kaya zmodel build {0}/{0}.cpp --into {0}\ntry it:    kaya ztest {0}/{0}.so {0}/triaxial.csv "
         "bulk=4e9 shear=3e9 strength=2e7\ntest it:   kaya {0}/test-{0}.3dd\n"},
        std::nullopt, joint_folders, chosen);
    add_plugin_list(app, joint_folders, chosen);
}

} // namespace kaya
