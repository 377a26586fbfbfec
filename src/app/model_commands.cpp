#include "app/model_commands.hpp"

#include "app/model_builder.hpp"
#include "app/new_model.hpp"
#include "app/permissions.hpp"
#include "base/diagnostic.hpp"
#include "commands/lua_joint_models.hpp"
#include "joints/joint_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// "stiffness-normal (jkn, kn), friction = 30"
std::string properties_text(const JointModel& model) {
    std::vector<std::string> texts;
    for (const auto& property : model.properties) {
        std::string text = property.name;
        if (!property.aliases.empty()) text += fmt::format(" ({})", fmt::join(property.aliases, ", "));
        texts.push_back(text);
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

void describe(const JointModel& model) {
    const auto line = [](const char* what, const std::string& text) {
        if (!text.empty()) fmt::print("  {:<11} {}\n", what, text);
    };
    std::vector<std::string> kept;
    for (const auto& variable : model.history) kept.push_back(variable.name);
    fmt::print("{}\n", model.name);
    line("title", model.title);
    line("file", model.file.string());
    line("version", model.version);
    line("interface", fmt::format("{}", model.descriptor().interface_version));
    line("properties", properties_text(model));
    line("states", fmt::format("{}", fmt::join(model.states, ", ")));
    line("keeps", fmt::format("{}", fmt::join(kept, ", ")));
    line("objects", model.keeps_objects() ? "one for each sub-contact" : "");
}

/// Who builds a library has its source before him. Without a home it is allowed by its folder alone: --joints.
void allow_built(const fs::path& library) {
    try {
        allow(library);
    } catch (const Diagnostic& problem) {
        fmt::print(stderr, "note: the library is not allowed for good: {}\n", problem.message);
    }
}

/// Lists what is asked for, or all that is found; 1 when one of them cannot be loaded.
int list_plugins(std::vector<std::string> names, const std::vector<fs::path>& folders) {
    int status = 0;
    JointRegistry registry;
    registry.set_path(folders);
    understand_lua_models(registry);
    if (names.empty()) names = registry.available();
    for (const auto& name : names) {
        try {
            describe(registry.get(name));
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
    building->add_option("--flag", order->flags, "one more word for the compiler: --flag=-g; may be given several times")
        ->allow_extra_args(false);
    building->add_flag("--displacement-at-end", order->displacement_at_end,
                       "normal_disp_ and shear_disp_ of a source for 3DEC include the increment of the step");
    building->add_flag("--as-it-is", order->as_it_is, "without the macro that makes std::exception(\"text\") compile");
    building->add_flag("--show", order->show, "show the compiler's line");
    building->callback([order, program_folder, &chosen] {
        chosen = [order, program_folder] {
            const fs::path library = build_joint_model(*order, include_folder(program_folder));
            JointRegistry registry;
            describe(registry.get(fs::absolute(library).string()));
            allow_built(library);
            return 0;
        };
    });

    auto new_name = std::make_shared<std::string>();
    auto* making = app.add_subcommand("new-jmodel", "write a joint model to begin with: source, deck, test and page");
    making->add_option("name", *new_name, "its name")->required();
    making->callback([new_name, &chosen] {
        chosen = [new_name] {
            for (const auto& file : write_new_model(*new_name, ".")) fmt::print("{}\n", file.string());
            fmt::print("build it:  kaya jmodel build {0}/{0}.cpp --into {0}\ntest it:   kaya {0}/test-{0}.3dd\n", *new_name);
            return 0;
        };
    });

    auto* plugin = app.add_subcommand("plugin", "look at joint models");
    plugin->require_subcommand(1);
    auto names = std::make_shared<std::vector<std::string>>();
    auto* listing = plugin->add_subcommand("list", "file, name, versions, properties and states of joint models");
    listing->add_option("model", *names, "names or files; all that are found if not given");
    listing->callback([names, joint_folders, &chosen] {
        chosen = [names, joint_folders] { return list_plugins(*names, joint_folders()); };
    });
}

} // namespace kaya
