#include "app/run.hpp"

#include "app/command_line.hpp"
#include "app/interrupt.hpp"
#include "app/process_host.hpp"
#include "app/prompt.hpp"
#include "app/run_report.hpp"
#include "app/sandbox.hpp"
#include "base/counted.hpp"
#include "commands/session/autosave.hpp"
#include "commands/session/given_parameters.hpp"
#include "commands/session/journal.hpp"
#include "commands/monitors/progress.hpp"
#include "model/whole/state_hash.hpp"
#include "system/door.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <new>
#include <optional>
#include <system_error>
#include <unistd.h>

namespace kaya {

namespace fs = std::filesystem;

fs::path program_folder(const char* called_as) {
    std::error_code failed;
    const fs::path self = fs::read_symlink("/proc/self/exe", failed);
    return failed ? fs::absolute(called_as).parent_path() : self.parent_path();
}

std::vector<fs::path> own_joint_folders(const fs::path& program) {
    return {program / "joints", program.parent_path() / "lib/kaya/joints"}; // built, installed
}

namespace {

/// Folders whose libraries are loaded without permission: those of the command line, next to the program or its installation, KAYA_JOINTS
/// (separated by ':').
std::vector<fs::path> trusted_folders(const RunOrder& order, const fs::path& program) {
    std::vector<fs::path> folders = order.options.joint_folders;
    for (const auto& own : own_joint_folders(program)) folders.push_back(own);
    if (const char* listed = std::getenv("KAYA_JOINTS")) {
        std::string_view rest(listed);
        while (!rest.empty()) {
            const auto end = std::min(rest.find(':'), rest.size());
            if (end > 0) folders.emplace_back(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    for (auto& folder : folders) folder = order.started_in / folder;
    return folders;
}

} // namespace

std::vector<fs::path> joint_folders(const RunOrder& order, const fs::path& program) {
    std::vector<fs::path> folders = trusted_folders(order, program);
    for (const auto& deck : order.decks) {
        const fs::path folder = fs::path(deck).parent_path();
        if (folder != "/dev") folders.push_back(folder.empty() ? fs::path(".") : folder);
    }
    return folders;
}

namespace {

/// The journal of a deck is in the current folder, as all files that it writes.
std::unique_ptr<Journal> journal_of(Session& session, const RunOrder& order) {
    if (order.no_journal || !order.journal.empty()) return nullptr;
    if (!order.decks.empty()) session.deck.file = order.decks.front();
    return std::make_unique<Journal>(session, session.run_name() + ".journal");
}

/// `--set angle=30` as a command for the journal: param angle = 30.
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
    const bool quoted = name.find(' ') != std::string::npos; // a property: 'prop 1 jfric'
    return fmt::format("param {}{}{} = {}", quoted ? "'" : "", name, quoted ? "'" : "", value);
}

void take_parameters(Session& session, const RunOrder& order, const DeckWords* words) {
    for (const auto& given : order.parameters) {
        const std::string line = parameter_line(given);
        if (words) words->require(given.substr(0, given.find('=')), Place{});
        session.deck.interpreter.run_text(line, "command line");
    }
}

std::vector<std::string> parameter_names(const RunOrder& order) {
    std::vector<std::string> names;
    for (const auto& given : order.parameters) names.push_back(given.substr(0, given.find('=')));
    return names;
}

int run_decks(Session& session, const RunOrder& order) {
    const auto words = words_of_decks(order.decks);
    const auto journal = journal_of(session, order);
    int status = 0;
    if (!order.journal.empty()) {
        const InterruptGuard guard(session);
        session.autosave->set_interval(std::nullopt); // the journal can be run again
        status = replay_journal(session, order.journal);
    } else if (order.decks.empty()) {
        if (journal) journal->deck("prompt");
        status = run_prompt(session);
    } else {
        const InterruptGuard guard(session);
        if (journal && !order.parameters.empty()) journal->deck(order.decks.front());
        take_parameters(session, order, words ? &*words : nullptr);
        if (order.begun) order.begun(session);
        for (const auto& deck : order.decks) {
            if (journal) journal->deck(deck);
            if (session.run_deck(deck) == lang::Ended::quit) break;
        }
    }
    warn_of_unused_parameters(session, parameter_names(order), words ? &*words : nullptr);
    if (journal) journal->finish();
    session.autosave->done();
    const auto& clock = session.engine.model.clock;
    if (clock.cycle > 0)
        session.program.output.say(
            fmt::format("done: {}, time {}, hash {:016x}{}", counted(clock.cycle, "cycle"),
                        time_text(session.engine.model), state_hash(session.engine.model),
                        session.program.warnings == 0 ? "" : ", " + counted(session.program.warnings, "warning")));
    session.program.output.stop_log();
    session.program.output.flush();
    if (order.ended) order.ended(session);
    return status;
}

/// Reports it, and passes it to the listener.
int fail(Session& session, const RunOrder& order, const Diagnostic& error) {
    session.program.output.message(error);
    if (order.failed) order.failed(session, error);
    return static_cast<int>(error.fault);
}

int run_session(Session& session, const RunOrder& order) {
    try {
        return run_decks(session, order);
    } catch (const lang::DeckErrors& errors) {
        for (const auto& error : errors.all) session.program.output.message(error);
        if (order.failed) order.failed(session, errors.all.front());
        return static_cast<int>(errors.fault);
    } catch (const Diagnostic& error) {
        if (error.code == broken_pipe) return nobody_reads;
        return fail(session, order, error);
    } catch (const std::bad_alloc&) {
        return fail(
            session, order,
            Diagnostic(no_memory, "use fewer blocks or longer zone edges", Fault::run).at(session.deck.last_place));
    } catch (const std::exception& error) {
        return fail(
            session, order,
            Diagnostic(fmt::format("internal error: {}", error.what()), "please report this, with the deck", Fault::own)
                .at(session.deck.last_place));
    }
}

/// Creates the folder before the lock: later it could not be made.
void prepare_history(const RunOrder& order) {
    const fs::path file = history_file();
    if (!order.decks.empty() || !order.journal.empty() || file.empty() || isatty(STDIN_FILENO) == 0) return;
    if (!door::make_folders(file.parent_path(), Use::own)) door::open(file, Use::own, door::Access::keep);
}

SandboxOrder sandbox_of(const RunOrder& order, const fs::path& program) {
    SandboxOrder sandbox;
    sandbox.inputs = order.decks;
    sandbox.joint_folders = trusted_folders(order, program);
    sandbox.listens = order.watch;
    if (!order.journal.empty()) sandbox.inputs.push_back(order.journal);
    if (order.decks.empty() && order.journal.empty()) sandbox.kept.push_back(history_file());
    return sandbox;
}

} // namespace

Gate::Policy policy_of(const RunOrder& order, const fs::path& program) { return policy_of(sandbox_of(order, program)); }

void prepare_run(RunOrder& order, const CLI::App& app) {
    for (auto& deck : order.decks) deck = deck_file(deck);
    require_decks(app, order.decks);
    if (!order.into.empty()) go_into(order.into, order.decks, order.journal);
}

std::optional<Diagnostic> warning_of_wide_folder(const std::vector<std::string>& files) {
    std::vector<fs::path> folders{"."};
    for (const auto& file : files)
        if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) folders.push_back(folder);
    const char* home = std::getenv("HOME");
    const auto is_wide = [&folders](const fs::path& wide) {
        std::error_code ignored;
        return std::ranges::any_of(folders, [&](const fs::path& one) { return fs::equivalent(one, wide, ignored); });
    };
    const bool at_home = home != nullptr && *home != '\0' && is_wide(home);
    if (!at_home && !is_wide("/")) return std::nullopt;
    Diagnostic warning(
        fmt::format("the run may write every file below {} that is not hidden", at_home ? "your home folder" : "/"),
        "move the deck to a separate folder, and start it there");
    warning.severity = Severity::warning;
    warning.code = "wide-folder";
    return warning;
}

int run(RunOrder& order, const fs::path& program) {
    const auto painter = std::make_shared<Painter>(program / "kaya-painter");
    prepare_history(order);
    if (!order.options.trust) {
        painter->stand_by();                 // after the lock no program can be started
        shut_in(sandbox_of(order, program)); // before there are threads: each has its own lock
    }
    order.options.joint_folders = joint_folders(order, program);
    order.options.own_joints = own_joint_folders(program);
    order.options.host = std::make_shared<ProcessHost>();
    Session session(order.options);
    session.painter = painter;
    const std::vector<std::string> inputs = sandbox_of(order, program).inputs;
    const bool typed = inputs.empty() && isatty(STDIN_FILENO) == 1;
    if (const auto warning = warning_of_wide_folder(inputs); warning && !order.options.trust && !typed)
        session.program.output.message(*warning);
    std::optional<RunReport> report;
    try {
        report.emplace(session, order.watch);
    } catch (const Diagnostic& problem) {
        session.program.output.message(problem);
        session.program.output.flush();
        return static_cast<int>(problem.fault);
    }
    int status = run_session(session, order);
    if (status != 0) session.autosave->keep();
    try {
        report->write();
        if (status == 0) session.program.output.flush();
    } catch (const Diagnostic& problem) {
        session.program.output.message(problem);
        if (status == 0) status = static_cast<int>(problem.fault);
    }
    return status;
}

} // namespace kaya
