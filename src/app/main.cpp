// kaya: runs command files. Exit status 0 done, 1 the deck is wrong, 2 the run failed, 3 our own fault.
#include "app/explanations.hpp"
#include "base/counted.hpp"
#include "app/command_line.hpp"
#include "app/interrupt.hpp"
#include "app/joint_bench.hpp"
#include "app/permissions.hpp"
#include "app/prompt.hpp"
#include "app/sandbox.hpp"
#include "app/tools.hpp"
#include "commands/deck_report.hpp"
#include "commands/journal.hpp"
#include "app/model_commands.hpp"
#include "commands/progress.hpp"
#include "commands/session.hpp"
#include "io/difference.hpp"
#include "io/info.hpp"
#include "joints/crash_report.hpp"


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

/// The status that a shell gives to a program whose reader went away; nothing is said then.
constexpr int nobody_reads = 141;

struct CommandLine {
    Options options;
    fs::path started_in; ///< folders of the command line and of the environment are counted from there
    std::string into;    ///< folder of the files that the run writes
    std::vector<std::string> decks;
    std::vector<std::string> parameters; ///< NAME=VALUE
    std::vector<std::string> checked;
    std::vector<std::string> help_words;
    std::vector<std::string> formatted;
    bool format_in_place = false;
    bool format_check = false;
    bool check_as_json = false;
    std::string code;         ///< of `explain`
    std::string journal;      ///< of `replay`
    std::string saved;        ///< of `info`
    std::vector<std::string> compared; ///< of `diff`
    bool no_journal = false;
    bool sandbox = false;             ///< `info --sandbox`
    std::vector<std::string> allowed; ///< of `allow`
    bool revoke = false;
};

/// The folder of the program itself: joint models that ship lie beside it.
fs::path program_folder(const char* called_as) {
    std::error_code failed;
    const fs::path self = fs::read_symlink("/proc/self/exe", failed);
    return failed ? fs::absolute(called_as).parent_path() : self.parent_path();
}

/// Folders whose libraries are loaded without a question: those of the command line, beside the program or where it is
/// installed, KAYA_JOINTS (folders with ':' between).
std::vector<fs::path> trusted_folders(const CommandLine& line, const fs::path& program) {
    std::vector<fs::path> folders = line.options.joint_folders;
    folders.push_back(program / "joints");
    folders.push_back(program.parent_path() / "lib/kaya/joints"); // where it is installed
    if (const char* listed = std::getenv("KAYA_JOINTS")) {
        std::string_view rest(listed);
        while (!rest.empty()) {
            const auto end = std::min(rest.find(':'), rest.size());
            if (end > 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    for (auto& folder : folders) folder = line.started_in / folder;
    return folders;
}

/// Where joint models are looked for, first match wins; beside the deck last.
std::vector<fs::path> joint_folders(const CommandLine& line, const fs::path& program) {
    std::vector<fs::path> folders = trusted_folders(line, program);
    for (const auto& deck : line.decks) {
        const fs::path folder = fs::path(deck).parent_path();
        if (folder != "/dev") folders.push_back(folder.empty() ? fs::path(".") : folder);
    }
    return folders;
}

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

/// The journal of a deck lies in the current folder, as all that it writes.
std::unique_ptr<Journal> journal_of(Session& session, const CommandLine& line) {
    if (line.no_journal || !line.journal.empty()) return nullptr;
    if (!line.decks.empty()) session.deck = line.decks.front();
    return std::make_unique<Journal>(session, session.run_name() + ".journal");
}

/// `--set angle=30` as the command that a journal tells: param angle = 30.
std::string parameter_line(const std::string& given) {
    const auto equals = given.find('=');
    const std::string name = given.substr(0, equals);
    if (equals == std::string::npos || name.empty() || equals + 1 == given.size())
        throw Diagnostic("--set takes NAME=VALUE, not '" + given + "'", "write for example: --set friction=30");
    std::string value = given.substr(equals + 1);
    if (value.find_first_of(" \t,()'\"@[") != std::string::npos) {
        if (value.find('\'') != std::string::npos) throw Diagnostic("a value of --set cannot hold a quote: " + given);
        value = "'" + value + "'";
    }
    return "param " + name + " = " + value;
}

int run_decks(Session& session, const CommandLine& line) {
    const auto journal = journal_of(session, line);
    int status = 0;
    if (!line.journal.empty()) {
        const InterruptGuard guard(session);
        session.rescue.set_interval(std::nullopt); // the journal can be run again
        status = replay_journal(session, line.journal);
    } else if (line.decks.empty()) {
        if (journal) journal->deck("prompt");
        status = run_prompt(session);
    } else {
        const InterruptGuard guard(session);
        if (journal && !line.parameters.empty()) journal->deck(line.decks.front());
        for (const auto& given : line.parameters) session.interpreter.run_text(parameter_line(given), "command line");
        for (const auto& deck : line.decks) {
            if (journal) journal->deck(deck);
            if (session.run_deck(deck) == lang::Ended::quit) break;
        }
    }
    if (journal) journal->finish();
    session.rescue.done();
    const auto& clock = session.model.clock;
    if (clock.cycle > 0)
        session.output.say(
            fmt::format("done: {}, time {}, hash {:016x}{}", counted(clock.cycle, "cycle"), time_text(session.model),
                        state_hash(session.model),
                        session.warnings == 0 ? "" : ", " + counted(session.warnings, "warning")));
    session.output.stop_log();
    session.output.flush();
    return status;
}

int run_session(Session& session, const CommandLine& line) {
    try {
        return run_decks(session, line);
    } catch (const lang::DeckErrors& errors) {
        for (const auto& error : errors.all) session.output.message(error);
        return static_cast<int>(errors.fault);
    } catch (const Diagnostic& error) {
        if (error.code == broken_pipe) return nobody_reads;
        session.output.message(error);
        return static_cast<int>(error.fault);
    } catch (const std::bad_alloc&) {
        session.output.message(Diagnostic("there is not enough memory for this model",
                                          "use fewer blocks or longer zone edges", Fault::run)
                                   .at(session.last_place));
        return static_cast<int>(Fault::run);
    } catch (const std::exception& error) {
        session.output.message(Diagnostic(fmt::format("kaya itself failed: {}", error.what()),
                                          "please report this, with the deck", Fault::own)
                                   .at(session.last_place));
        return static_cast<int>(Fault::own);
    }
}

/// The lock lets in what is there: later no folder can be made for it.
void prepare_history(const CommandLine& line) {
    const fs::path file = history_file();
    if (!line.decks.empty() || !line.journal.empty() || file.empty() || isatty(STDIN_FILENO) == 0) return;
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    const std::ofstream touched(file, std::ios::app);
}

SandboxOrder sandbox_of(const CommandLine& line, const fs::path& program) {
    SandboxOrder order{line.decks, trusted_folders(line, program), {}};
    if (!line.journal.empty()) order.inputs.push_back(line.journal);
    if (line.decks.empty() && line.journal.empty()) order.kept.push_back(history_file());
    return order;
}

/// Decks are there before anything is written: a misspelt command leaves no journal. Then the run goes to its folder.
void prepare_run(CommandLine& line, const CLI::App& app) {
    for (auto& deck : line.decks)
        if (deck == "-") deck = "/dev/stdin";
    if (!line.decks.empty()) require_deck(app, line.decks.front());
    if (!line.into.empty()) go_into(line.into, line.decks, line.journal);
}

int run(CommandLine& line, const fs::path& program) {
    Gate::Policy policy;
    const auto painter = std::make_shared<Painter>(program / "kaya-painter");
    if (!line.options.trust) {
        painter->stand_by(); // behind the lock no program can be started
        const SandboxOrder order = sandbox_of(line, program);
        prepare_history(line);
        policy = policy_of(order);
        lock(policy, order); // before there are threads: each has its own lock
    }
    line.options.joint_folders = joint_folders(line, program);
    Session session(line.options);
    session.painter = painter;
    if (!line.options.trust) session.gate->shut(std::move(policy));
    const int status = run_session(session, line);
    if (status != 0) session.rescue.keep();
    return status;
}

int start(int argc, char** argv) {
    CommandLine line;
    line.started_in = fs::current_path();
    CLI::App app{"kaya runs command files of the distinct element method in three dimensions.\n"
                 "Files that a deck writes are put into the current folder. Without a deck it reads commands from the "
                 "keyboard.",
                 "kaya"};
    app.set_version_flag("--version", std::string("kaya ") + program_version());
    app.add_option("deck", line.decks, "command files, run one after the other in one session; - is the standard input");
    app.add_option("--threads", line.options.threads,
                   "threads to use; 0 is one for each core; results do not depend on it")
        ->check(CLI::Range(0, 4096));
    app.add_option("--joints", line.options.joint_folders,
                   "a folder with joint models; may be given several times")
        ->allow_extra_args(false)
        ->check([](const std::string& folder) {
            return fs::is_directory(folder) ? std::string() : fmt::format("there is no folder {}", folder);
        });
    app.add_option("--into", line.into, "the folder for files that the run writes; it is made if it is not there");
    app.add_flag("--strict", line.options.strict, "warnings are errors");
    app.add_flag("--batch,--quiet,-q", line.options.quiet, "results, warnings and errors only");
    app.add_option("--set", line.parameters, "NAME=VALUE: a value for `param` of the decks; may be given several times")
        ->allow_extra_args(false);
    app.add_flag("--echo", line.options.echo, "show each command before it runs");
    app.add_flag("--trust", line.options.trust, "the deck may use files and libraries anywhere and start programs");
    app.add_option("--script-memory", line.options.script_memory,
                   "megabytes that scripts of the deck may take; half of the machine's memory if not given")
        ->check(CLI::Range(0, 1 << 20));
    app.add_flag("--no-journal", line.no_journal, "do not write the journal (the deck's name with .journal)");
    auto* formatting = app.add_subcommand("fmt", "show decks in their long form: whole words, single blanks");
    formatting->add_option("deck", line.formatted, "command files")->required();
    auto* writing = formatting->add_flag("--write,-w", line.format_in_place, "write it into the files");
    formatting->add_flag("--check", line.format_check, "write nothing; name the decks that are not in their long form, status 1 if there are any")
        ->excludes(writing);
    auto* explaining = app.add_subcommand("explain", "explain a message by its code, or list the codes");
    explaining->add_option("code", line.code, "as shown in brackets behind a message on a terminal");
    auto* replaying = app.add_subcommand("replay", "run a journal again and compare the final state");
    replaying->add_option("journal", line.journal, "a file that a run has written")->required();
    replaying->add_option("--into", line.into, "the folder for files that the run writes; it is made if it is not there");
    auto* describing = app.add_subcommand("info", "say what a saved model holds");
    describing->add_option("file", line.saved, "a file that 'save' has written");
    describing->add_flag("--sandbox", line.sandbox, "say what a run in this folder may do");
    auto* comparing = app.add_subcommand("diff", "say in what two saved models differ");
    comparing->add_option("file", line.compared, "two files that 'save' has written")->required()->expected(2);
    auto* allowing = app.add_subcommand("allow", "allow runs a folder or a joint model, for good; without one, list what is allowed");
    allowing->add_option("path", line.allowed, "folders, or libraries as they are now");
    allowing->add_flag("--revoke", line.revoke, "take it back");
    auto* checking =
        app.add_subcommand("check", "read decks and say what is wrong with them, without running them");
    checking->add_option("deck", line.checked, "command files")->required();
    checking->add_flag("--json", line.check_as_json, "one object of JSON per line, for editors");
    auto* helping = app.add_subcommand("help", "list the commands of decks, or explain one of them");
    helping->add_option("command", line.help_words, "a command, a keyword, or a name of FISH: poly brick, cx_nforce");
    const fs::path program = program_folder(argv[0]);
    std::function<int()> about_models;
    add_joint_bench(app, [&] { return joint_folders(line, program); }, about_models);
    add_zone_bench(app, [&] { return joint_folders(line, program); }, about_models);
    add_model_commands(app, program, [&] { return joint_folders(line, program); }, about_models);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        // A misspelt command with an option of it.
        const auto misspelt = line.decks.empty() ? std::nullopt : misspelt_command(app, line.decks.front());
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
            throw Diagnostic("info needs the name of a file", "such as: kaya info wall.kaya.h5, or kaya info --sandbox");
        fmt::print("{}", describe_sandbox(policy_of(sandbox_of(line, program))));
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
    prepare_run(line, app);
    return run(line, program);
}

} // namespace

} // namespace kaya

namespace {

/// Otherwise the next file that is opened would be taken for the standard output.
void open_missing_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) < 0) std::_Exit(static_cast<int>(kaya::Fault::run));
}

/// TBB throws where nobody can catch it when the system gives it no thread, which is for want of memory as a rule.
[[noreturn]] void end_without_threads() {
    try {
        if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
        if (std::string_view(error.what()).find("pthread_create") != std::string_view::npos) {
            std::fflush(stdout);
            std::fprintf(stderr, "error: the system gives no more threads (%s); there is not enough memory, or too many run\n", error.what());
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
