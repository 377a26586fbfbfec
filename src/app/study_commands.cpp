#include "app/study_commands.hpp"

#include "app/interrupt.hpp"
#include "app/permissions.hpp"
#include "app/study_deck.hpp"
#include "commands/program/output.hpp"
#include "lang/interp/lexer.hpp"
#include "lang/script/values/value_text.hpp"
#include "model/tables/model.hpp"
#include "model/whole/state_hash.hpp"
#include "study/local_runs.hpp"
#include "study/slurm_runs.hpp"
#include "study/study_answers.hpp"
#include "study/study_table.hpp"
#include "system/door.hpp"
#include "system/run_record.hpp"
#include "system/whole_file.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <memory>
#include <thread>

namespace kaya {

namespace {

namespace fs = std::filesystem;

struct StudyOrder {
    std::string file, folder, batch, from;
    int at_once = 0;
    std::size_t number = 0, task = 0, per_task = 1;
    bool anew = false, again = false, slurm = false, ranks = false, quiet = false;
    std::vector<std::string> sbatch;
};

std::atomic<bool> asked_to_stop = false;

StudyValue study_value(const script::Value& value, Session& session) {
    return std::visit(
        [&]<class T>(const T& v) -> StudyValue {
            if constexpr (std::is_constructible_v<StudyValue, T> && !std::is_same_v<T, script::Handle>) return v;
            else return script::to_text(script::Value(v), &session.engine.world);
        },
        value);
}

/// The results of a run, in the state that its deck left.
void read_results(Session& session, const std::vector<Asked>& asked, Outcome& outcome) {
    constexpr const char* lua_name = "study_result";
    for (const auto& one : asked) {
        try {
            if (one.lua)
                session.engine.scripts->run_lua(
                    fmt::format("function {}() local value = ({}) if value == nil then error('it is nil: a name may be "
                                "misspelt', 0) end return value end",
                                lua_name, one.expression),
                    one.place);
            outcome.results.emplace_back(
                one.name,
                study_value(session.engine.scripts->value(one.lua ? lua_name : one.expression, one.place), session));
        } catch (const Diagnostic& problem) {
            outcome.end = Outcome::End::failed;
            outcome.message = fmt::format("result '{}': {}", one.name, problem.message);
            session.program.output.message(problem);
            return;
        }
    }
}

/// Values that the deck did not use: "" when it used all.
std::string unused_values(Session& session, const Case& one, const std::set<std::string>& declared) {
    for (const auto& name : session.deck.given_properties.unused())
        return fmt::format("no command of the deck sets '{}'", name);
    for (const auto& [name, value] : one.values) {
        if (is_property(name) || declared.contains(lang::fold(name))) continue;
        if (study_value(session.engine.scripts->value(name), session) !=
            study_value(session.deck.parameters[lang::fold(name)], session))
            return fmt::format("the deck sets '{0}' itself: write there param {0} = VALUE", name);
    }
    return {};
}

/// The work of one process of a study: one run, and its outcome.
RunCase run_case(const RunOrder& base, const Study& study, const fs::path& program) {
    return [base, study, program, declared = declared_names(study)](const Case& one, const fs::path& file) {
        begin_run_record(); // each run of a study is a process
        RunOrder order = base;
        const auto began = std::chrono::steady_clock::now();
        Outcome outcome;
        bool is_known = false;
        const auto finish = [&](Session& session) {
            is_known = true;
            outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
            outcome.cycles = session.engine.model.clock.cycle;
            outcome.warnings = static_cast<std::int64_t>(session.program.warnings);
            outcome.hash = fmt::format("{:016x}", state_hash(session.engine.model));
        };
        order.options.threads = 1; // one run on each core
        order.decks = {fs::absolute(order.started_in / study.deck).string()};
        order.into.clear();
        for (const auto& [name, value] : one.values) order.parameters.push_back(name + "=" + text_of(value));
        order.begun = [&](Session& session) {
            if (study.limits.cycles > 0) session.stop_after = study.limits.cycles;
        };
        order.ended = [&](Session& session) {
            finish(session);
            outcome.message = unused_values(session, one, declared);
            if (!outcome.message.empty()) outcome.end = Outcome::End::failed;
            else read_results(session, study.asked, outcome);
        };
        order.failed = [&](Session& session, const Diagnostic& error) {
            if (InterruptGuard::was_asked()) return; // the run is done again
            finish(session);
            const bool cycles = study.limits.cycles > 0 && session.engine.model.clock.cycle >= study.limits.cycles;
            const bool memory = study.limits.megabytes > 0 && error.message == no_memory;
            outcome.end = cycles || memory ? Outcome::End::limit : Outcome::End::failed;
            outcome.message = cycles   ? fmt::format("took more than {} cycles", study.limits.cycles)
                              : memory ? fmt::format("took more than {} MB", study.limits.megabytes)
                                       : error.message;
            if (outcome.end == Outcome::End::failed && error.place)
                outcome.message = fmt::format("{}:{}: {}", fs::path(error.place.source->name).filename().string(),
                                              error.place.line, error.message);
        };
        const int status = run(order, program);
        // The last thing that a run writes: one that is killed before it is done again, and leaves no lock.
        if (is_known) write_outcome(file, one, outcome);
        return status;
    };
}

LocalRuns::Options local_options(const Study& study, int at_once, bool shared) {
    return {at_once, shared, study.limits, study.kept};
}

int cores(int wanted) {
    return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// The rank of this process according to mpirun or srun. 0: the first, or the only one.
int own_rank() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID"})
        if (const char* text = std::getenv(name)) return std::atoi(text);
    return 0;
}

void forget_runs(const fs::path& folder) {
    std::error_code failed;
    if (!is_study_folder(folder)) {
        if (fs::exists(folder, failed) && !fs::is_empty(folder, failed))
            throw Diagnostic(
                fmt::format("{} is not the folder of a study: --anew does not remove it", folder.string()));
        return;
    }
    for (const char* own : {"runs", "slurm", "about.toml", "study.toml", "results.csv", "results.h5", "report.html"}) {
        if (failed = door::remove_all(folder / own); failed)
            throw Diagnostic(fmt::format("cannot remove {}: {}", (folder / own).string(), failed.message()), {},
                             Fault::run);
    }
}

/// Removes outcomes of incomplete runs, so that they are repeated.
void forget_failures(const StudyFolder& folder, const std::vector<Case>& cases) {
    for (const auto& one : cases)
        if (const auto outcome = folder.outcome(one); outcome && outcome->end != Outcome::End::done)
            door::remove(folder.outcome_file(one.number));
}

std::unique_ptr<Runs> runs_of(const StudyOrder& wanted, const RunOrder& order, const Study& study,
                              const fs::path& program, const StudyFolder& folder, StudyProgress& progress) {
    if (!wanted.slurm)
        return std::make_unique<LocalRuns>(folder,
                                           local_options(study, wanted.ranks ? 1 : cores(wanted.at_once), wanted.ranks),
                                           run_case(order, study, program), progress);
    SlurmRuns::Options options;
    options.program = {(program / "kaya").string()};
    if (order.options.trust) options.program.emplace_back("--trust");
    for (const auto& joints : order.options.joint_folders)
        options.program.insert(options.program.end(), {"--joints", fs::absolute(joints).string()});
    options.from = fs::absolute(wanted.file).parent_path();
    options.sbatch = wanted.sbatch;
    options.stop = &asked_to_stop;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { asked_to_stop = true; });
    return std::make_unique<SlurmRuns>(folder, std::move(options), progress);
}

/// The user has named the study file and not its deck: outside of the folder of that file the deck needs a permission.
void ask_for_deck(const Study& study, const RunOrder& order) {
    if (order.options.trust) return;
    const fs::path own = fs::path(study.file).parent_path();
    Gate::Policy policy;
    policy.folders = read_permissions().folders;
    policy.folders.push_back(own.empty() ? fs::path(".") : own);
    Gate gate;
    gate.shut(std::move(policy));
    try {
        gate.may_read(study.deck);
    } catch (Diagnostic& refused) { throw refused.at(study.deck_place); }
}

int carry_out(const StudyOrder& wanted, const RunOrder& order, const fs::path& program) {
    const Study study = read_study(wanted.file);
    ask_for_deck(study, order);
    check_names(study);
    const fs::path path =
        wanted.folder.empty() ? fs::path(fs::path(wanted.file).stem().string() + "-study") : fs::path(wanted.folder);
    if (wanted.anew) forget_runs(path);
    const auto cases = cases_of(study); // errors of the design are reported before a folder is made
    const bool first = !wanted.ranks || own_rank() == 0;
    if (const auto warning = warning_of_wide_folder({wanted.file, study.deck});
        warning && first && !order.options.trust)
        Output(stdout, stderr).message(*warning);
    StudyProgress progress(order.options.quiet || wanted.quiet || !first);
    const StudyFolder folder(path, study, program_version(), wanted.ranks);
    if (wanted.again) forget_failures(folder, cases);
    const auto runs = runs_of(wanted, order, study, program, folder, progress);
    const StudyAnswers answers = answer(study, *runs);
    if (!first) return 0;
    const auto write = [&](const char* name, const std::string& text) {
        write_whole_file((folder.path() / name).string(), text);
    };
    write("results.csv", csv_of(answers.cases, answers.outcomes, study.asked));
    write("results.h5", hdf5_of(answers.cases, answers.outcomes, study.asked));
    write("report.html", report_page(study, answers, program_version()));
    print_result(fmt::format("{}results: {}", summary_text(study, answers), (path / "results.csv").string()));
    return 0;
}

/// The existing runs, complete or not.
struct Kept {
    Study study;
    std::vector<Case> cases;
    std::vector<Outcome> outcomes;
    std::size_t missing = 0;
};

Kept kept_runs(const StudyFolder& folder) {
    Kept kept;
    kept.study = read_study(folder.study_file(), folder.study_text());
    auto cases = cases_of(kept.study);
    if (cases.empty()) cases = searched_cases(folder);
    for (auto& one : cases) {
        auto outcome = folder.outcome(one);
        if (!outcome) {
            ++kept.missing;
            continue;
        }
        kept.cases.push_back(std::move(one));
        kept.outcomes.push_back(std::move(*outcome));
    }
    return kept;
}

int show(const StudyOrder& wanted) {
    const StudyFolder folder{fs::path(wanted.folder)};
    const Kept kept = kept_runs(folder);
    print_result(table_text(kept.cases, kept.outcomes, kept.study.asked, 100));
    if (kept.missing > 0) print_result(fmt::format("{} runs are not done yet", kept.missing));
    return 0;
}

/// Repeats one run, with a deck that is complete in itself.
int rerun(const StudyOrder& wanted, RunOrder order, const fs::path& program) {
    const StudyFolder folder{fs::path(wanted.folder)};
    const Kept kept = kept_runs(folder);
    ask_for_deck(kept.study, order);
    const auto found = std::ranges::find(kept.cases, wanted.number, &Case::number);
    if (found == kept.cases.end())
        throw Diagnostic(fmt::format("{} has no run {}", wanted.folder, wanted.number),
                         kept.cases.empty() ? "" : fmt::format("the last is {}", kept.cases.back().number));
    const Outcome& before = kept.outcomes[static_cast<std::size_t>(found - kept.cases.begin())];
    const fs::path deck = write_case_deck(kept.study, *found);
    print_result(deck.string());
    order.decks = {deck.string()};
    std::string hash;
    order.ended = [&](Session& session) { hash = fmt::format("{:016x}", state_hash(session.engine.model)); };
    order.failed = [&](Session& session, const Diagnostic&) {
        hash = fmt::format("{:016x}", state_hash(session.engine.model));
    };
    order.into = (folder.path() / "reruns" / fmt::format("{:06}", wanted.number)).string();
    prepare_run(order, CLI::App());
    const int status = run(order, program);
    if (before.hash.empty()) return status;
    print_result(hash == before.hash
                     ? "the final state is that of the study"
                     : fmt::format("the final state is not that of the study: {} instead of {}", hash, before.hash));
    return hash == before.hash ? status : static_cast<int>(Fault::run);
}

/// One task of a batch that a queue was given.
int work(const StudyOrder& wanted, const RunOrder& order, const fs::path& program) {
    const StudyFolder folder{fs::path(wanted.folder)};
    const Study study = read_study(folder.study_file(), folder.study_text());
    ask_for_deck(study, order);
    StudyProgress progress(true);
    LocalRuns runs(folder, local_options(study, 1, true), run_case(order, study, program), progress);
    runs.all(cases_of_task(folder, wanted.batch, wanted.task, wanted.per_task));
    return 0;
}

} // namespace

void add_study_commands(CLI::App& app, const RunOrder& order, const fs::path& program, std::function<int()>& action) {
    auto wanted = std::make_shared<StudyOrder>();
    auto* study = app.add_subcommand("study", "run one deck many times with varying parameters: docs/studies.md");
    study->add_option("study", wanted->file, "the study, a TOML file");
    study->add_option("--into", wanted->folder, "folder of the runs; the study's name with -study if not given");
    study->add_option("--jobs", wanted->at_once, "runs at one time; one for each core if not given")
        ->check(CLI::Range(1, 4096));
    study->add_flag("--anew", wanted->anew, "remove existing runs");
    study->add_flag("--again", wanted->again, "repeat failed runs");
    study->add_flag("--quiet,-q", wanted->quiet, "no progress");
    auto* slurm = study->add_flag("--slurm", wanted->slurm, "the runs are jobs of Slurm");
    study
        ->add_option("--sbatch", wanted->sbatch,
                     "an option for sbatch: --sbatch=--partition=long; may be given several times")
        ->allow_extra_args(false)
        ->needs(slurm);
    study->add_flag("--mpi", wanted->ranks, "this is one of several processes of mpirun or srun that share the runs")
        ->excludes(slurm);
    auto* showing = study->add_subcommand("show", "show the runs of a study");
    showing->add_option("folder", wanted->folder, "the folder of the study")->required();
    auto* repeating = study->add_subcommand("rerun", "repeat one run, with a separate deck");
    repeating->add_option("folder", wanted->folder, "the folder of the study")->required();
    repeating->add_option("run", wanted->number, "its number")->required();
    auto* working = study->add_subcommand("work", "do one task of a batch: for queues")->group("");
    working->add_option("folder", wanted->folder)->required();
    working->add_option("batch", wanted->batch)->required();
    working->add_option("task", wanted->task)->required();
    working->add_option("--from", wanted->from, "folder of the study's file");
    working->add_option("--per-task", wanted->per_task)->check(CLI::PositiveNumber);
    study->require_subcommand(0, 1);
    study->callback([=, &order, &program, &action] {
        if (*showing) action = [wanted] { return show(*wanted); };
        else if (*repeating) action = [wanted, &order, &program] { return rerun(*wanted, order, program); };
        else if (*working) action = [wanted, &order, &program] { return work(*wanted, order, program); };
        else if (wanted->file.empty()) throw CLI::RequiredError("study");
        else action = [wanted, &order, &program] { return carry_out(*wanted, order, program); };
    });
}

} // namespace kaya
