// kaya: runs command files. Exit status 0 done, 1 the deck is wrong, 2 the run failed, 3 our own fault.
#include "app/explanations.hpp"
#include "app/command_line.hpp"
#include "app/joint_bench.hpp"
#include "app/permissions.hpp"
#include "app/run.hpp"
#include "app/sandbox.hpp"
#include "app/study_commands.hpp"
#include "app/tools.hpp"
#include "commands/deck_report.hpp"
#include "app/model_commands.hpp"
#include "commands/session.hpp"
#include "io/difference.hpp"
#include "io/info.hpp"
#include "laws/crash_report.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <system_error>
#include <unistd.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

struct CommandLine {
    RunOrder run;
    std::vector<std::string> checked;
    std::vector<std::string> help_words;
    std::vector<std::string> formatted;
    bool format_in_place = false;
    bool format_check = false;
    bool check_as_json = false;
    std::string code;                  ///< of `explain`
    std::string saved;                 ///< of `info`
    std::vector<std::string> compared; ///< of `diff`
    std::vector<std::string> reported; ///< of `report`: saved models
    std::string report;                ///< and the page
    std::string exported, tables;      ///< of `export`: the saved model and the folder
    bool paraview = false;
    bool sandbox = false;             ///< `info --sandbox`
    std::vector<std::string> allowed; ///< of `allow`
    bool revoke = false;
};

/// Says what would become of each statement of the decks.
int check(const std::vector<std::string>& decks, bool as_json, Output& output) {
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const DeckReport report = check_deck(deck, {"."});
            const std::string text = as_json ? report.json_lines() : report.text(deck);
            if (as_json) fmt::print("{}", text);
            else output.print(text);
            if (!report.can_run()) status = static_cast<int>(Fault::deck);
        } catch (const Diagnostic& error) {
            output.message(error);
            status = static_cast<int>(error.fault);
        }
    }
    return status;
}

int start(int argc, char** argv) {
    CommandLine line;
    line.run.started_in = fs::current_path();
    CLI::App app{"kaya runs command files of the distinct element method in three dimensions.\n"
                 "Files that a deck writes are put into the current folder. Without a deck it reads commands from the "
                 "keyboard.",
                 "kaya"};
    app.set_version_flag("--version", std::string("kaya ") + program_version());
    app.add_option("deck", line.run.decks,
                   "command files, run one after the other in one session; - is the standard input");
    app.add_option("--threads", line.run.options.threads,
                   "threads to use; 0 is one for each core; results do not depend on it")
        ->check(CLI::Range(0, 4096));
    app.add_option("--joints", line.run.options.joint_folders, "a folder with joint models; may be given several times")
        ->allow_extra_args(false)
        ->check([](const std::string& folder) {
            return fs::is_directory(folder) ? std::string() : fmt::format("there is no folder {}", folder);
        });
    app.add_option("--watch", line.run.watch,
                   "a port: a browser on this machine can look at the run while it goes on; 0: any that is free")
        ->check(CLI::Range(0, 65535));
    app.add_option("--into", line.run.into, "the folder for files that the run writes; it is made if it is not there");
    app.add_flag("--strict", line.run.options.strict, "warnings are errors");
    app.add_flag("--batch,--quiet,-q", line.run.options.quiet, "results, warnings and errors only");
    app.add_option("--set", line.run.parameters,
                   "NAME=VALUE: a value for `param` of the decks; may be given several times")
        ->allow_extra_args(false);
    app.add_flag("--echo", line.run.options.echo, "show each command before it runs");
    app.add_flag("--trust", line.run.options.trust, "the deck may use files and libraries anywhere and start programs");
    app.add_option("--script-memory", line.run.options.script_memory,
                   "megabytes that scripts of the deck may take; half of the machine's memory if not given")
        ->check(CLI::Range(0, 1 << 20));
    app.add_flag("--no-journal", line.run.no_journal, "do not write the journal (the deck's name with .journal)");
    auto* formatting = app.add_subcommand("fmt", "show decks in their long form: whole words, single blanks");
    formatting->add_option("deck", line.formatted, "command files")->required();
    auto* writing = formatting->add_flag("--write,-w", line.format_in_place, "write it into the files");
    formatting
        ->add_flag("--check", line.format_check,
                   "write nothing; name the decks that are not in their long form, status 1 if there are any")
        ->excludes(writing);
    auto* explaining = app.add_subcommand("explain", "explain a message by its code, or list the codes");
    explaining->add_option("code", line.code, "as shown in brackets after a message on a terminal");
    auto* replaying = app.add_subcommand("replay", "run a journal again and compare the final state");
    replaying->add_option("journal", line.run.journal, "a file that a run has written")->required();
    replaying->add_option("--into", line.run.into,
                          "the folder for files that the run writes; it is made if it is not there");
    auto* describing = app.add_subcommand("info", "say what a saved model holds");
    describing->add_option("file", line.saved, "a file that 'save' has written");
    describing->add_flag("--sandbox", line.sandbox, "say what a run in this folder may do");
    auto* reporting =
        app.add_subcommand("report", "make a page of a saved model for a browser: numbers, curves, a view to turn");
    reporting
        ->add_option(
            "file", line.reported,
            "files that 'save' has written; the last one is that of the tables, and all can be seen in their order")
        ->required();
    reporting->add_option("--out", line.report, "name of the page; the file's name with .html if not given");
    auto* exporting = app.add_subcommand(
        "export", "write the tables of a saved model as CSV: blocks, zones, contacts, histories and all others");
    exporting->add_option("file", line.exported, "a file that 'save' has written")->required();
    exporting->add_option("--into", line.tables, "the folder; the file's name with -tables if not given");
    exporting->add_flag("--vtk", line.paraview, "also the files for ParaView");
    auto* comparing = app.add_subcommand("diff", "say in what two saved models differ");
    comparing->add_option("file", line.compared, "two files that 'save' has written")->required()->expected(2);
    auto* allowing = app.add_subcommand(
        "allow", "allow runs a folder or a joint model, for good; without one, list what is allowed");
    allowing->add_option("path", line.allowed, "folders, or libraries as they are now");
    allowing->add_flag("--revoke", line.revoke, "take it back");
    auto* checking = app.add_subcommand("check", "read decks and say what is wrong with them, without running them");
    checking->add_option("deck", line.checked, "command files")->required();
    checking->add_flag("--json", line.check_as_json, "one object of JSON per line, for editors");
    auto* helping = app.add_subcommand("help", "list the commands of decks, or explain one of them");
    helping->add_option("command", line.help_words, "a command, a keyword, or a name of FISH: poly brick, cx_nforce");
    const fs::path program = program_folder(argv[0]);
    std::function<int()> about_models;
    add_joint_bench(
        app, [&] { return joint_folders(line.run, program); }, about_models);
    add_zone_bench(
        app, [&] { return joint_folders(line.run, program); }, about_models);
    add_model_commands(
        app, program, [&] { return joint_folders(line.run, program); }, about_models);
    add_study_commands(app, line.run, program, about_models);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        // A misspelt command with an option of it.
        const auto misspelt = line.run.decks.empty() ? std::nullopt : misspelt_command(app, line.run.decks.front());
        throw misspelt ? *misspelt : mistake_of(app, error);
    }
    if (*checking) {
        Output output(stdout, stderr);
        const int status = check(line.checked, line.check_as_json, output);
        output.flush();
        return status;
    }
    if (*helping) {
        const std::string words = fmt::format("{}", fmt::join(line.help_words, " "));
        fmt::print("{}\n", help_text(words));
        return 0;
    }
    if (*formatting) {
        Output output(stdout, stderr);
        const int status = format_decks(line.formatted,
                                        line.format_check      ? Formatting::check
                                        : line.format_in_place ? Formatting::write
                                                               : Formatting::show,
                                        output);
        output.flush();
        return status;
    }
    if (*explaining) {
        fmt::print("{}", line.code.empty() ? code_list() : explanation(line.code));
        return 0;
    }
    if (*reporting) {
        fmt::print("{}\n", write_report(line.reported, line.report, joint_folders(line.run, program)));
        return 0;
    }
    if (*exporting) {
        for (const auto& name : export_saved(line.exported, line.tables, line.paraview)) fmt::print("{}\n", name);
        return 0;
    }
    if (*comparing) {
        const std::string difference = difference_of(line.compared);
        fmt::print("{}", difference.empty() ? "the same\n" : difference);
        return difference.empty() ? 0 : 1;
    }
    if (*allowing) {
        for (const auto& path : line.allowed) line.revoke ? revoke(path) : allow(path);
        fmt::print("{}", describe(read_permissions()));
        return 0;
    }
    if (*describing && (line.sandbox || line.saved.empty())) {
        if (!line.sandbox)
            throw Diagnostic("info needs the name of a file",
                             "such as: kaya info wall.kaya.h5, or kaya info --sandbox");
        fmt::print("{}", describe_sandbox(policy_of(line.run, program)));
        return 0;
    }
    if (*describing) {
        try {
            fmt::print("{}", describe_save_file(find_saved(line.saved)));
            return 0;
        } catch (Diagnostic& problem) {
            problem.hint = "info reads a file that 'save' has written";
            problem.fault = Fault::deck;
            throw;
        }
    }
    if (about_models) return about_models();
    prepare_run(line.run, app);
    return run(line.run, program);
}

} // namespace

} // namespace kaya

namespace {

/// Otherwise the next file that is opened would be taken for the standard output.
void open_missing_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) < 0)
            std::_Exit(static_cast<int>(kaya::Fault::run));
}

/// TBB throws where nobody can catch it when the system gives it no thread, which is for want of memory as a rule.
[[noreturn]] void end_without_threads() {
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
        if (std::string_view(error.what()).find("pthread_create") != std::string_view::npos) {
            std::fflush(stdout);
            std::fprintf(stderr,
                         "error: the system gives no more threads (%s); there is not enough memory, or too many run\n",
                         error.what());
            std::_Exit(static_cast<int>(kaya::Fault::run));
        }
    } catch (...) { // what it is, the report of the crash says
    }
    std::abort();
}

} // namespace

int main(int argc, char** argv) {
    open_missing_streams();
    std::set_terminate(end_without_threads);
    // A file that grows beyond the limit, or a reader that went away, is an error of the write that met
    // it, not the end of the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    kaya::report_crashes();
    try {
        return kaya::start(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fputs("error: there is not enough memory to begin\n", stderr);
        return static_cast<int>(kaya::Fault::run);
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::broken_pipe) return kaya::nobody_reads;
        std::fprintf(stderr, "error: %s\n", error.what());
        return static_cast<int>(kaya::Fault::run);
    } catch (const kaya::Diagnostic& error) {
        std::fputs((kaya::render(error) + "\n").c_str(), stderr);
        return static_cast<int>(error.fault);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: kaya itself failed: %s\n", error.what());
        return static_cast<int>(kaya::Fault::own);
    }
}
