#include "lang/interp/deck.hpp"

#include "lang/interp/named_word.hpp"
#include "lang/interp/other_languages.hpp"
#include "lang/interp/script_files.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace kaya::lang {

namespace fs = std::filesystem;

namespace {

using SharedFile = std::shared_ptr<const BoundFile>;

/// Binds a file and, through its calls, the files below it.
class DeckReader {
public:
    DeckReader(const Language& language, const std::vector<fs::path>& folders, const Checks* checks, BareNames& names,
               std::size_t most_problems = most_errors_shown)
        : language_(language), folders_(folders), checks_(checks), names_(names), most_problems_(most_problems) {}

    SharedFile file(const std::string& name) {
        const fs::path path = find_deck(name, searched());
        std::error_code ignored; // of a pipe, which has no place
        fs::path whole = fs::weakly_canonical(path, ignored);
        if (ignored) whole = path;
        for (const auto& [known, bound] : done_)
            if (known == whole) return bound;
        refuse_cycle(whole);
        if (checks_ && checks_->before_reading) checks_->before_reading(path);
        chain_.push_back({whole, name});
        const SharedFile bound = text(read_source(path, name), path);
        chain_.pop_back();
        done_.emplace_back(whole, bound);
        return bound;
    }

    SharedFile text(const Source& source, const fs::path& path) {
        auto bound = std::make_shared<BoundFile>();
        bound->source = source;
        bound->path = path;
        Lexer lexer(source);
        Statement statement;
        while (problems_.size() < most_problems_) {
            try {
                if (!next_statement(language_, lexer, statement)) break;
                bound->steps.push_back(step(statement));
                // The text after `return` is never read: many decks keep notes there.
                if (bound->steps.back().command.spec->flow == Flow::leave_file) break;
            } catch (const Diagnostic& problem) {
                if (const auto other = other_language(statement)) { // what follows is of that language, too
                    problems_.push_back(*other);
                    break;
                }
                problems_.push_back(problem);
            }
        }
        return bound;
    }

    void throw_problems() {
        if (!problems_.empty()) throw DeckErrors(std::move(problems_));
    }
    std::vector<Diagnostic> take_problems() { return std::move(problems_); }

private:
    BoundFile::Step step(const Statement& statement) {
        BoundFile::Step step{bind_with_names(language_, statement, names_), {}};
        BoundCommand& command = step.command;
        names_.learn(*command.spec, statement);
        if (checks_ && checks_->command && !command.late) run_check(command);
        const Word& first = statement.words.front();
        const std::string name = fold(first.text.substr(0, first.text.find('(')));
        const bool of_deck = names_.is_function(name) || (name.find('.') != name.npos && !may_write_files(first.text));
        if (!command.spec->body_end.empty() ? may_write_files(command) : first.late() && !of_deck) script_seen_ = true;
        if (command.spec->flow == Flow::call && !command.late) step.called = called(command);
        return step;
    }

    void run_check(const BoundCommand& command) {
        try {
            checks_->command(command.command);
        } catch (Diagnostic& problem) {
            place_problem(problem, language_, command.place);
            throw;
        }
    }

    SharedFile called(const BoundCommand& command) {
        const std::string name = command.spec->called_file(command.command);
        try {
            if (chain_.size() >= deepest_call)
                throw Diagnostic(fmt::format("more than {} files call each other", deepest_call));
            return file(name);
        } catch (Diagnostic& problem) {
            // A script may write the file before the call is reached; it is searched again then.
            if (problem.code == "no-file" && script_seen_) return {};
            place_problem(problem, language_, command.place);
            throw;
        }
    }

    void refuse_cycle(const fs::path& whole) const {
        const auto first = std::find_if(chain_.begin(), chain_.end(), [&](const auto& c) { return c.first == whole; });
        if (first == chain_.end()) return;
        std::string names;
        for (auto link = first; link != chain_.end(); ++link) names += link->second + " calls ";
        throw Diagnostic(fmt::format("endless calls of files: {}{}", names, first->second), "remove one of the calls");
    }

    /// The folder of the calling file first, then those of its callers, then the folder where the program was started.
    std::vector<fs::path> searched() const {
        std::vector<fs::path> folders;
        for (auto link = chain_.rbegin(); link != chain_.rend(); ++link) folders.push_back(link->first.parent_path());
        folders.insert(folders.end(), folders_.begin(), folders_.end());
        return folders;
    }

    const Language& language_;
    const std::vector<fs::path>& folders_;
    const Checks* checks_;
    BareNames& names_;
    std::size_t most_problems_;
    std::vector<std::pair<fs::path, std::string>> chain_; ///< files being read, with their names as written
    std::vector<std::pair<fs::path, SharedFile>> done_;
    std::vector<Diagnostic> problems_;
    bool script_seen_ = false;
};

} // namespace

SharedFile bind_deck(const Language& language, const std::string& name, const std::vector<fs::path>& folders,
                     const Checks* checks, BareNames* names) {
    BareNames own;
    DeckReader reader(language, folders, checks, names != nullptr ? *names : own);
    const SharedFile bound = reader.file(name);
    reader.throw_problems();
    return bound;
}

namespace {

template <class Read>
ReadDeck read_with(const Language& language, const std::vector<fs::path>& folders, const Checks* checks, Read read) {
    ReadDeck deck;
    DeckReader reader(language, folders, checks, deck.names, std::numeric_limits<std::size_t>::max());
    deck.file = read(reader);
    deck.problems = reader.take_problems();
    return deck;
}

} // namespace

ReadDeck read_deck(const Language& language, const std::string& name, const std::vector<fs::path>& folders,
                   const Checks* checks) {
    return read_with(language, folders, checks, [&](DeckReader& reader) { return reader.file(name); });
}

ReadDeck read_deck(const Language& language, Source source, const fs::path& path, const std::vector<fs::path>& folders,
                   const Checks* checks) {
    return read_with(language, folders, checks, [&](DeckReader& reader) { return reader.text(source, path); });
}

SharedFile bind_text(const Language& language, Source source, const std::vector<fs::path>& folders,
                     const Checks* checks, BareNames* names) {
    BareNames own;
    DeckReader reader(language, folders, checks, names != nullptr ? *names : own);
    const SharedFile bound = reader.text(source, {});
    reader.throw_problems();
    return bound;
}

namespace {

/// A line with a bracket alone, which is not closed below.
bool is_open_bracket(const Statement& statement) {
    const Word& word = statement.words.front();
    if (word.kind != WordKind::open || word.text.front() != '[') return false;
    const auto rest = word.text.find_first_not_of(" \t", 1);
    return rest == std::string::npos || word.text[rest] == ';';
}

} // namespace

bool needs_more(const Language& language, std::string_view text) {
    try {
        Lexer lexer(source_from_text("", text));
        Statement statement;
        const int count = static_cast<int>(lexer.source()->lines.size());
        while (next_statement(language, lexer, statement))
            if ((lexer.line() > count && lexer.continued(count)) || is_open_bracket(statement)) return true;
    } catch (const Diagnostic& problem) { return problem.code == "never-ended"; }
    return false;
}

} // namespace kaya::lang
