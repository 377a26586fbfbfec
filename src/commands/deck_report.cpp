#include "commands/deck_report.hpp"

#include "commands/deck_names.hpp"
#include "commands/session.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/fish/inner_commands.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace kaya {

namespace {

constexpr std::array outlook_words{"runs", "ignored", "not supported yet", "unknown", "wrong"};

const char* word_of(Outlook outlook) { return outlook_words[static_cast<std::size_t>(outlook)]; }

Outlook outlook_of(const Diagnostic& problem) {
    if (problem.code == "not-supported-yet" || problem.code == "unsupported-fish-name") return Outlook::not_supported;
    return problem.code.starts_with("unknown") ? Outlook::unknown : Outlook::wrong;
}

class Reporter {
public:
    explicit Reporter(const lang::BareNames& bare) : bare_(bare) {}

    DeckReport report;

    void file(const lang::BoundFile& file) {
        if (!seen_.insert(&file).second) return;
        begin_file(file.source->name);
        for (const auto& step : file.steps) statement(step.command);
        for (const auto& step : file.steps) {
            if (step.called) this->file(*step.called);
            else if (step.command.spec->flow == lang::Flow::call) names_.anything_may_be_made();
        }
    }

    /// Names that nothing in the deck makes. Where a statement could not be read, it may have made them.
    void names() {
        const bool whole = std::ranges::all_of(report.lines, [](const auto& line) { return line.outlook != Outlook::wrong; });
        if (!whole) return;
        for (const auto& missing : names_.missing())
            report.lines.push_back({missing.place.source->name, missing.place.line, missing.place.column,
                                    Outlook::unknown, fmt::format("no function or variable '{}' is made in this deck", missing.name),
                                    missing.meant.empty() ? "" : fmt::format("did you mean '{}'?", missing.meant)});
    }

    void problem(const Diagnostic& problem) {
        ++report.statements;
        const std::string name = problem.place.source ? problem.place.source->name : "";
        begin_file(name);
        report.lines.push_back({name, problem.place.line, problem.place.column, outlook_of(problem), problem.message,
                                problem.hint});
    }

    void sort() {
        const auto rank = [this](const ReportLine& line) { return std::ranges::find(files_, line.file); };
        std::ranges::stable_sort(report.lines, [&](const auto& a, const auto& b) {
            return std::pair(rank(a), a.line) < std::pair(rank(b), b.line);
        });
    }

private:
    void begin_file(const std::string& name) {
        if (std::ranges::find(files_, name) == files_.end()) files_.push_back(name);
    }

    void statement(const lang::BoundCommand& command, bool inside_function = false) {
        ++report.statements;
        names_.look_at(command, inside_function);
        const auto ignored = [&](std::string text) {
            report.lines.push_back({command.place.source->name, command.place.line, command.place.column,
                                    Outlook::ignored, std::move(text), {}});
        };
        if (command.spec->support == lang::Support::ignored) ignored(command.text());
        else if (!command.ignored.empty()) {
            std::string words;
            for (const auto word : command.ignored) words += fmt::format(" {}", word);
            ignored(command.spec->name() + words);
        }
        if (const auto* function = std::any_cast<lang::FishDefinition>(&command.command)) inside(*function);
    }

    /// The function was compiled when the deck was bound; its command blocks are looked at here.
    void inside(const lang::FishDefinition& definition) {
        const auto function = fish::read_function(definition.text, definition.place);
        for (const auto& inner : fish::inner_commands(function)) {
            if (inner.glued) {
                ++report.statements;
                continue;
            }
            lang::Lexer lexer(definition.place.source, inner.line);
            lang::Statement words;
            if (!lexer.next(words)) continue;
            try {
                statement(lang::bind_with_names(lang::classic(), words, bare_), true);
            } catch (const Diagnostic& mistake) {
                problem(mistake);
            }
        }
    }

    DeckNames names_;
    const lang::BareNames& bare_;
    std::set<const lang::BoundFile*> seen_;
    std::vector<std::string> files_; ///< in the order of their first call
};

} // namespace

std::size_t DeckReport::count(Outlook outlook) const {
    return static_cast<std::size_t>(std::ranges::count(lines, outlook, &ReportLine::outlook));
}

bool DeckReport::can_run() const {
    return std::ranges::all_of(lines, [](const auto& line) { return line.outlook == Outlook::ignored; });
}

std::string DeckReport::text(const std::string& deck) const {
    std::string text;
    for (const auto& line : lines) {
        text += fmt::format("{}:{}:{}: {}: {}", line.file, line.line, line.column, word_of(line.outlook), line.text);
        text += line.hint.empty() ? "\n" : fmt::format("; {}\n", line.hint);
    }
    text += fmt::format("{}: {} statements: {} run", deck, statements, statements - lines.size());
    for (const auto outlook : {Outlook::ignored, Outlook::not_supported, Outlook::unknown, Outlook::wrong})
        if (count(outlook) > 0) text += fmt::format(", {} {}", count(outlook), word_of(outlook));
    return text;
}

DeckReport check_deck(const std::string& deck, const std::vector<std::filesystem::path>& folders) {
    const lang::Checks checks = deck_checks();
    const lang::ReadDeck read = lang::read_deck(lang::classic(), deck, folders, &checks);
    Reporter reporter(read.names);
    reporter.file(*read.file);
    for (const auto& problem : read.problems) reporter.problem(problem);
    reporter.names();
    reporter.sort();
    return reporter.report;
}

} // namespace kaya
