#include "commands/session/deck_report.hpp"

#include "base/counted.hpp"

#include "commands/review/deck_review.hpp"
#include "commands/session/session.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace kaya {

namespace {

constexpr std::array outlook_words{"runs", "ignored", "warning", "not supported yet", "unknown", "wrong"};

const char* word_of(Outlook outlook) { return outlook_words[static_cast<std::size_t>(outlook)]; }

Outlook outlook_of(const Diagnostic& problem) {
    if (problem.severity == Severity::warning) return Outlook::doubtful;
    if (problem.code == "not-supported-yet" || problem.code == "unsupported-fish-name") return Outlook::not_supported;
    return problem.code.starts_with("unknown") ? Outlook::unknown : Outlook::wrong;
}

class Reporter {
public:
    DeckReport report;

    void begin_file(const std::string& name) {
        if (std::ranges::find(files_, name) == files_.end()) files_.push_back(name);
    }

    void statement(const lang::BoundCommand& command) {
        ++report.statements;
        const auto ignored = [&](std::string text) {
            report.lines.push_back({command.place.source->name,
                                    command.place.line,
                                    command.place.column,
                                    Outlook::ignored,
                                    std::move(text),
                                    {},
                                    {}});
        };
        if (command.spec->support == lang::Support::ignored) ignored(command.text());
        else if (!command.ignored.empty()) {
            std::string words;
            for (const auto word : command.ignored) words += fmt::format(" {}", word);
            ignored(command.spec->name() + words);
        }
    }

    void problem(const Diagnostic& problem) {
        ++report.statements;
        add(problem);
    }

    /// Findings about the whole deck. A statement that could not be read may have defined the missing names.
    void findings(DeckReview& review) {
        const bool whole =
            std::ranges::all_of(report.lines, [](const auto& line) { return line.outlook != Outlook::wrong; });
        if (!whole) return;
        for (const auto& finding : review.findings()) add(finding);
    }

    void sort() {
        const auto rank = [this](const ReportLine& line) { return std::ranges::find(files_, line.file); };
        std::ranges::stable_sort(report.lines, [&](const auto& a, const auto& b) {
            return std::pair(rank(a), a.line) < std::pair(rank(b), b.line);
        });
    }

private:
    void add(const Diagnostic& problem) {
        const std::string name = problem.place.source ? problem.place.source->name : "";
        begin_file(name);
        report.lines.push_back({name, problem.place.line, problem.place.column, outlook_of(problem), problem.message,
                                problem.hint, problem.code});
    }

    std::vector<std::string> files_; ///< in the order of their first call
};

} // namespace

std::size_t DeckReport::count(Outlook outlook) const {
    return static_cast<std::size_t>(std::ranges::count(lines, outlook, &ReportLine::outlook));
}

bool DeckReport::can_run() const {
    return std::ranges::all_of(lines, [](const auto& line) { return line.outlook <= Outlook::doubtful; });
}

std::string DeckReport::text(const std::string& deck) const {
    std::string text;
    for (const auto& line : lines) {
        text += fmt::format("{}:{}:{}: {}: {}", line.file, line.line, line.column, word_of(line.outlook), line.text);
        text += line.hint.empty() ? "\n" : fmt::format("; {}\n", line.hint);
    }
    text += fmt::format("{}: {}: {} run", deck, counted(statements, "statement"),
                        statements - (lines.size() - count(Outlook::doubtful)));
    for (const auto outlook : {Outlook::ignored, Outlook::not_supported, Outlook::unknown, Outlook::wrong})
        if (count(outlook) > 0) text += fmt::format(", {} {}", count(outlook), word_of(outlook));
    if (const auto n = count(Outlook::doubtful); n > 0) text += ", " + counted(n, "warning");
    return text;
}

int severity_of(Outlook outlook) { return outlook == Outlook::ignored ? 3 : outlook == Outlook::doubtful ? 2 : 1; }

std::string proposal_of(std::string_view text) {
    constexpr std::string_view begin = "did you mean '";
    const auto from = text.find(begin), to = text.find("'?", from);
    if (from == text.npos || to == text.npos) return {};
    return std::string(text.substr(from + begin.size(), to - from - begin.size()));
}

std::string DeckReport::json_lines() const {
    constexpr std::array severities{"error", "warning", "information"};
    std::string text;
    for (const auto& line : lines) {
        const nlohmann::ordered_json object = {
            {"file", line.file},
            {"line", line.line},
            {"column", line.column},
            {"severity", severities[static_cast<std::size_t>(severity_of(line.outlook) - 1)]},
            {"kind", word_of(line.outlook)},
            {"code", line.code},
            {"message", line.text},
            {"hint", line.hint},
            {"proposal", proposal_of(line.hint)}};
        // Characters outside of ASCII, control characters among them, are written as \u and digits, invalid UTF-8 as the replacement character.
        text += object.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    }
    return text;
}

namespace {

DeckReport report_on(const lang::ReadDeck& read, const std::vector<std::filesystem::path>& places,
                     const std::vector<std::filesystem::path>& own_joints) {
    const Session session{Options{}}; // knows built-in names
    Reporter reporter;
    DeckReview review(read.names, *session.engine.scripts, places, own_joints);
    review.on_file = [&](const lang::BoundFile& file) { reporter.begin_file(file.source->name); };
    review.on_statement = [&](const lang::BoundCommand& command) { reporter.statement(command); };
    review.on_inner = [&](const Diagnostic* mistake) {
        if (mistake) reporter.problem(*mistake);
        else ++reporter.report.statements;
    };
    review.file(*read.file);
    for (const auto& problem : read.problems) reporter.problem(problem);
    reporter.findings(review);
    reporter.sort();
    return reporter.report;
}

} // namespace

DeckReport check_deck(const std::string& deck, const std::vector<std::filesystem::path>& folders,
                      const std::vector<std::filesystem::path>& own_joints) {
    const lang::Checks checks = deck_checks();
    std::vector<std::filesystem::path> places{std::filesystem::path(deck).parent_path()};
    places.insert(places.end(), folders.begin(), folders.end());
    return report_on(lang::read_deck(lang::language(), deck, folders, &checks), places, own_joints);
}

DeckReport check_text(const std::string& file, const std::string& text,
                      const std::vector<std::filesystem::path>& own_joints) {
    const lang::Checks checks = deck_checks();
    const std::vector<std::filesystem::path> places{std::filesystem::path(file).parent_path(), "."};
    return report_on(lang::read_deck(lang::language(), lang::source_from_text(file, text), file, places, &checks),
                     places, own_joints);
}

} // namespace kaya
