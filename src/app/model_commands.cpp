#include "app/model_commands.hpp"

#include "app/model_builder.hpp"
#include "app/new_model.hpp"
#include "app/permissions.hpp"
#include "base/diagnostic.hpp"
#include "commands/lua_joint_models.hpp"
#include "laws/joint_model.hpp"

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
        if (!text.empty()) fmt::print("  {:<11} {}\n", what, text);
    };
    std::vector<std::string> kept;
    for (const auto& variable : model.history) kept.push_back(variable.name);
    fmt::print("{}\n", model.name);
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
    std::vector<std::string> fields;
    for (const auto& field : model.fields) fields.push_back(field.name);
    if (!fields.empty()) fmt::print("  {:<11} {}\n", "fields", fmt::join(fields, ", "));
}
void describe(const ZoneModel& model) { describe(model, "zone model", KAYA_ZMODEL_INTERFACE); }

/// Who builds a library has its source before him. Without a home it is allowed by its folder alone: --joints.
void allow_built(const fs::path& library) {
    try {
        allow(library);
    } catch (const Diagnostic& problem) {
        fmt::print(stderr, "note: the library is not allowed for good: {}\n", problem.message);
    }
}

/// Lists what is asked for, or all that is found; 1 when one of them cannot be loaded.
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
            fmt::print("{}\n  {:<11} {}\n", name, "refused", error.message);
            status = static_cast<int>(Fault::deck);
        }
    }
    return status;
}

} // namespace

void add_model_commands(CLI::App& app, const fs::path& program_folder,
                        const std::function<std::vector<fs::path>()>& joint_folders, std::function<int()>& chosen) {
    auto* jmodel = app.add_subcommand("jmodel", "make a joint model");
    jmodel->require_subcommand(1);
    auto order = std::make_shared<BuildOrder>();
    auto* building = jmodel->add_subcommand(
        "build", "compile sources of a joint model, written for kaya or for 3DEC 4, 5, 7 or 9, into a library");
    building->add_option("source", order->sources, "its .cpp files")->required();
    building->add_option("--into", order->folder, "folder of the library; the present one if not given");
    building->add_option("--compiler", order->compiler, "the compiler; CXX, c++, g++ or clang++ if not given");
    building->add_option("--std", order->standard, "language standard of sources for 3DEC: gnu++17");
    building
        ->add_option("--flag", order->flags, "one more word for the compiler: --flag=-g; may be given several times")
        ->allow_extra_args(false);
    building->add_flag("--displacement-at-end", order->displacement_at_end,
                       "normal_disp_ and shear_disp_ of a source for 3DEC include the increment of the step");
    building->add_flag("--as-it-is", order->as_it_is, "without the macro that makes std::exception(\"text\") compile");
    building->add_flag("--show", order->show, "show the compiler's line");
    building->callback([order, program_folder, &chosen] {
        chosen = [order, program_folder] {
            const fs::path library = build_model(*order, include_folder(program_folder));
            JointRegistry registry;
            describe(registry.get(fs::absolute(library).string()));
            allow_built(library);
            return 0;
        };
    });

    auto* zmodel = app.add_subcommand("zmodel", "make a zone model");
    zmodel->require_subcommand(1);
    auto of_zones = std::make_shared<BuildOrder>();
    of_zones->zone_model = true;
    auto* building_zones = zmodel->add_subcommand("build", "compile sources of a zone model into a library");
    building_zones->add_option("source", of_zones->sources, "its .cpp files")->required();
    building_zones->add_option("--into", of_zones->folder, "folder of the library; the present one if not given");
    building_zones->add_option("--compiler", of_zones->compiler, "the compiler; CXX, c++, g++ or clang++ if not given");
    building_zones
        ->add_option("--flag", of_zones->flags, "one more word for the compiler: --flag=-g; may be given several times")
        ->allow_extra_args(false);
    building_zones->add_flag("--show", of_zones->show, "show the compiler's line");
    building_zones->callback([of_zones, program_folder, &chosen] {
        chosen = [of_zones, program_folder] {
            const fs::path library = build_model(*of_zones, include_folder(program_folder));
            ZoneModels models;
            describe(models.get(fs::absolute(library).string()));
            allow_built(library);
            return 0;
        };
    });

    struct Writing {
        std::array<std::string_view, 2> kinds; ///< of its templates
        const char* next;                      ///< what to do with it
    };
    const auto add_new = [&](const char* command, const char* help, Writing native, std::optional<Writing> lua,
                             auto names_taken) {
        auto name = std::make_shared<std::string>();
        auto in_lua = std::make_shared<bool>(false);
        auto* making = app.add_subcommand(command, help);
        making->add_option("name", *name, "its name")->required();
        if (lua) making->add_flag("--lua", *in_lua, "in Lua, which needs no compiler");
        making->callback([=, &chosen] {
            chosen = [=] {
                const Writing& writing = *in_lua ? *lua : native;
                for (const auto& file : write_new_model(writing.kinds, {*name, ".", names_taken(joint_folders())}))
                    fmt::print("{}\n", file.string());
                fmt::print(fmt::runtime(writing.next), *name);
                return 0;
            };
        });
    };
    add_new("new-jmodel", "write a joint model to begin with: source, deck, test and page",
            {{"joint", "joint-shared"},
             "build it:  kaya jmodel build {0}/{0}.cpp --into {0}\ntest it:   kaya {0}/test-{0}.3dd\n"},
            Writing{{"joint-lua", "joint-shared"}, "test it:   kaya --joints {0} {0}/test-{0}.3dd\n"},
            [](const auto& folders) {
                JointRegistry registry;
                registry.set_path(folders);
                return registry.available();
            });
    add_new(
        "new-zmodel", "write a zone model to begin with: source, path, test and page",
        {{"zone"},
         "build it:  kaya zmodel build {0}/{0}.cpp --into {0}\ntry it:    kaya ztest {0}/{0}.so {0}/triaxial.csv bulk=4e9 shear=3e9 "
         "strength=2e7\ntest it:   kaya {0}/test-{0}.3dd\n"},
        std::nullopt, [](const auto& folders) {
            ZoneModels models;
            models.set_path(folders);
            return models.available();
        });

    auto* plugin = app.add_subcommand("plugin", "look at joint and zone models");
    plugin->require_subcommand(1);
    auto names = std::make_shared<std::vector<std::string>>();
    auto* listing =
        plugin->add_subcommand("list", "file, name, versions, properties and states of joint and zone models");
    listing->add_option("model", *names, "names or files; all that are found if not given");
    listing->callback([names, joint_folders, &chosen] {
        chosen = [names, joint_folders] { return list_plugins(*names, joint_folders()); };
    });
}

} // namespace kaya
