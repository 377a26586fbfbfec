#include "app/start.hpp"

#include "app/command_line.hpp"
#include "app/joint_bench.hpp"
#include "app/model_commands.hpp"
#include "app/run.hpp"
#include "app/scope.hpp"
#include "app/study_commands.hpp"
#include "app/tool_commands.hpp"
#include "system/run_copies.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

void add_run_options(CLI::App& app, RunOrder& order) {
    app.add_option("deck", order.decks, "command files, run in order in one session; - is the standard input");
    app.add_option("--threads", order.options.threads,
                   "threads to use; 0 is one for each core; results do not depend on it")
        ->check(CLI::Range(0, 4096));
    app.add_option("--joints", order.options.joint_folders, "a folder with joint models; may be given several times")
        ->allow_extra_args(false)
        ->check([](const std::string& folder) {
            return fs::is_directory(folder) ? std::string() : fmt::format("there is no folder {}", folder);
        });
    app.add_option("--watch", order.watch, "a port: a browser on this machine can follow the run; 0: any free port")
        ->check(CLI::Range(0, 65535));
    app.add_option("--into", order.into, "the folder for files that the run writes; it is created if necessary");
    app.add_option("--color", order.options.colour, "colours of messages: auto, always or never")
        ->check(CLI::IsMember({"auto", "always", "never"}));
    app.add_flag("--strict", order.options.strict, "warnings are errors");
    app.add_flag("--batch,--quiet,-q", order.options.quiet, "results, warnings and errors only");
    app.add_option("--set", order.parameters,
                   "NAME=VALUE: a value for `param` of the decks; may be given several times")
        ->allow_extra_args(false);
    app.add_flag("--echo", order.options.echo, "show each command before it runs");
    app.add_flag("--trust", order.options.trust, "the deck may use files and libraries anywhere and start programs");
    app.add_option("--script-memory", order.options.script_memory,
                   "megabytes that scripts of the deck may use; half of the machine's memory if not given")
        ->check(CLI::Range(0, 1 << 20));
    app.add_flag("--no-journal", order.no_journal, "do not write the journal (the deck's name with .journal)");
}

void add_replay(CLI::App& app, RunOrder& order) {
    auto* replaying = app.add_subcommand("replay", "run a journal again and compare the final state");
    replaying->add_option("journal", order.journal, "a file that a run has written")->required();
    replaying->add_option("--into", order.into, "the folder for files that the run writes; it is created if necessary");
}

} // namespace

int start(int argc, char** argv) {
    RunOrder order;
    order.started_in = fs::current_path();
    CLI::App app{"kaya runs command files of the distinct element method in three dimensions.\n"
                 "Files that a deck writes are put into the current folder. Without a deck it reads commands from the "
                 "keyboard.",
                 "kaya"};
    app.set_version_flag("--version,-V", std::string("kaya ") + program_version());
    const fs::path program = program_folder(argv[0]);
    const auto joints = [&] { return joint_folders(order, program); };
    std::function<int()> chosen; // the action that replaces a run
    add_run_options(app, order);
    add_tool_commands(app, order, program, chosen);
    add_replay(app, order);
    add_joint_bench(app, joints, chosen);
    add_zone_bench(app, joints, chosen);
    add_model_commands(app, program, joints, chosen);
    add_study_commands(app, order, program, chosen);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        // A misspelt command with an option of it.
        const auto misspelt = order.decks.empty() ? std::nullopt : misspelt_command(app, order.decks.front());
        throw misspelt ? *misspelt : mistake_of(app, error);
    }
    if (chosen) enter_scope(app, order, program);
    else prepare_run(order, app);
    const int status = chosen ? chosen() : run(order, program);
    refuse_copies();
    return status;
}

} // namespace kaya
