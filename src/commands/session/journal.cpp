#include "commands/session/journal.hpp"

#include "base/hash.hpp"
#include "model/whole/state_hash.hpp"
#include "system/door.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

// Every line of a journal that is not a line of a deck begins with one of these.
constexpr std::string_view first_line = "; kaya journal 1";
constexpr std::string_view deck_mark = ";deck ";   ///< name
constexpr std::string_view lines_mark = ";lines "; ///< first line, number of lines, name of the source
// Prefix of commands that were cut off:
constexpr std::string_view stopped_mark = ";stopped "; ///< cycle after which the user stopped them
constexpr std::string_view cut_off_mark = ";cut off";  ///< the user stopped them inside of a script
constexpr std::string_view failed_mark = ";failed";    ///< with an error
constexpr std::string_view joint_mark = ";joint ";     ///< digest, file
constexpr std::string_view file_mark = ";file ";       ///< digest, file
constexpr std::string_view hash_mark = ";hash ";       ///< digest of the final state

/// Digest of a file's contents; empty when it cannot be read.
std::string digest_of(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return "-"; // a pipe would hold the replay up
    const Descriptor opened = door::peek(file);
    std::string contents;
    if (!opened || !read_all(opened.number(), contents)) return "-";
    Hash hash;
    hash.add(contents);
    return fmt::format("{:016x}", hash.value());
}

/// A name on a line of the journal: a file may be called with a line end in it.
std::string on_one_line(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c == '\n' || c == '\r'; }, '_');
    return name;
}

/// Lines of one source that follow each other, to be run as one text.
struct Piece {
    std::string deck, source, text;
    int line = 0; ///< of the first line of `text` in the source
    int last = 0;
    Completion completion; ///< of one command; completed commands are grouped
};

struct FileNote {
    std::string digest, name;
};

struct Record {
    std::vector<Piece> pieces;
    std::vector<FileNote> joints, files;
    std::string hash; ///< empty: the run was cut off
};

[[noreturn]] void fail_damaged(const std::string& file, std::size_t line) {
    throw Diagnostic(fmt::format("line {} of '{}' is not a line of a journal", line, file),
                     "the file was changed, or is not a journal");
}

/// Splits off the first word of a text.
std::string_view take_word(std::string_view& text) {
    const auto end = std::min(text.find(' '), text.size());
    const auto word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

int take_number(std::string_view& text) {
    const auto word = take_word(text);
    int number = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size() ? number : -1;
}

/// Of a deck: the largest one has fewer, of some 50 characters each. Lines before a piece are kept empty, so that numbers of lines agree.
constexpr int most_lines = 10'000'000;

/// Longer texts would only make the first mistake in them appear later.
constexpr std::size_t longest_piece = 1 << 16;

Record read_record(const std::string& file) {
    const auto source = lang::read_source(file, file);
    const auto& lines = source->lines;
    if (lines.empty() || lines.front() != first_line)
        throw Diagnostic(fmt::format("'{}' is not a journal", file),
                         fmt::format("a journal begins with '{}'", first_line));
    Record record;
    std::string deck;
    Completion completion; // of the following lines
    for (std::size_t i = 1; i < lines.size(); ++i) {
        std::string_view rest = lines[i];
        const auto is = [&rest](std::string_view mark) {
            if (!rest.starts_with(mark)) return false;
            rest.remove_prefix(mark.size());
            return true;
        };
        if (is(deck_mark)) {
            deck = rest;
        } else if (is(joint_mark)) {
            const std::string digest(take_word(rest));
            record.joints.push_back({digest, std::string(rest)});
        } else if (is(file_mark)) {
            const std::string digest(take_word(rest));
            record.files.push_back({digest, std::string(rest)});
        } else if (is(hash_mark)) {
            record.hash = rest;
        } else if (is(stopped_mark)) {
            completion = {Completion::How::stopped, take_number(rest)};
        } else if (is(cut_off_mark)) {
            completion.how = Completion::How::cut_off;
        } else if (is(failed_mark)) {
            completion.how = Completion::How::failed;
        } else if (is(lines_mark)) {
            const int line = take_number(rest), count = take_number(rest);
            if (line < 1 || line > most_lines || count < 1 || i + static_cast<std::size_t>(count) >= lines.size())
                fail_damaged(file, i + 1);
            auto& pieces = record.pieces;
            const bool all_done = completion.how == Completion::How::done && !pieces.empty() &&
                                  pieces.back().completion.how == Completion::How::done;
            const bool goes_on = all_done && pieces.back().deck == deck && pieces.back().source == rest &&
                                 line > pieces.back().last && pieces.back().text.size() < longest_piece;
            if (!goes_on)
                pieces.push_back({deck, std::string(rest), {}, line, line - 1, std::exchange(completion, {})});
            Piece& piece = pieces.back();
            for (; piece.last < line - 1; ++piece.last) piece.text += '\n';
            for (int k = 0; k < count; ++k) piece.text += lines[++i] + "\n";
            piece.last += count;
        } else if (!rest.empty() && !rest.starts_with("; ")) {
            fail_damaged(file, i + 1);
        }
    }
    return record;
}

void compare(Session& session, const std::vector<FileNote>& notes, const char* what) {
    for (const auto& [digest, name] : notes) {
        if (digest_of(name) == digest) continue;
        Diagnostic warning(fmt::format("{} '{}' is not the one of the journal", what, name), "the results may differ");
        warning.severity = Severity::warning;
        session.program.output.message(warning);
    }
}

std::string final_hash(Session& session) { return fmt::format("{:016x}", state_hash(session.engine.model)); }

} // namespace

Journal::Journal(Session& session, const std::string& file) : session_(session), file_(file) {
    try {
        opened_ = door::open(session.program.output_file(file), Use::write, door::Access::renew);
    } catch (const Diagnostic&) { // a link that leads elsewhere, say: the first line cannot be written
    }
    write(fmt::format("{}\n; kaya {}, seed of scripts {}\n", first_line, program_version(), script::Options{}.seed));
    session_.program.listen(*this);
}

Journal::~Journal() { session_.program.forget(*this); }

void Journal::write(const std::string& text) {
    if (failed_) return;
    // Written at once: after a crash the journal must hold the commands that ran.
    if (opened_ && write_all(opened_.number(), text)) return;
    failed_ = true;
    Diagnostic note(fmt::format("the journal '{}' cannot be written", file_), "the run continues without it");
    note.severity = Severity::note;
    session_.program.output.message(note);
}

void Journal::deck(const std::string& name) { write(fmt::format("{}{}\n", deck_mark, on_one_line(name))); }

void Journal::executed(const lang::BoundCommand& command, const Completion& completion) {
    switch (completion.how) {
    case Completion::How::done: break;
    case Completion::How::stopped: write(fmt::format("{}{}\n", stopped_mark, completion.cycle)); break;
    case Completion::How::cut_off: write(fmt::format("{}\n", cut_off_mark)); break;
    case Completion::How::failed: write(fmt::format("{}\n", failed_mark)); break;
    }
    const auto& source = *command.place.source;
    const int first = command.place.line, last = std::max(command.last_line, first);
    std::string text = fmt::format("{}{} {} {}\n", lines_mark, first, last - first + 1, on_one_line(source.name));
    for (int line = first; line <= last; ++line) text += source.lines[static_cast<std::size_t>(line - 1)] + "\n";
    write(text);
}

void Journal::finish() {
    for (const auto& model : session_.engine.joints.loaded())
        write(fmt::format("{}{} {}\n", joint_mark, digest_of(model->file), on_one_line(model->file.string())));
    for (const auto& file : session_.program.files_read)
        write(fmt::format("{}{} {}\n", file_mark, digest_of(file), on_one_line(file)));
    write(fmt::format("; cycle {}, time {}\n{}{}\n", session_.engine.model.clock.cycle,
                      session_.engine.model.clock.time, hash_mark, final_hash(session_)));
}

namespace {

/// Repeats a command that was cut off, up to the same point.
void repeat_unfinished(Session& session, const Piece& piece) {
    if (piece.completion.how == Completion::How::cut_off) {
        Diagnostic warning(
            "a command that was stopped inside of a script is left out: it cannot be stopped there again",
            "the results may differ");
        warning.severity = Severity::warning;
        const auto source = lang::source_from_text(piece.source, piece.text, piece.line);
        return session.program.output.message(warning.at({source, piece.line, 1, 1}));
    }
    if (piece.completion.how == Completion::How::stopped) session.stop_after = piece.completion.cycle;
    try {
        session.deck.interpreter.run_text(piece.text, piece.source, piece.line);
    } catch (const Diagnostic& again) {
        session.program.output.message(again);
    } catch (const std::bad_alloc&) { // as in the run: a script ran out of memory
    }
    session.stop_after.reset();
}

} // namespace

int replay_journal(Session& session, const std::string& file) {
    const Record record = read_record(file);
    for (const auto& piece : record.pieces) {
        session.deck.file = piece.deck;
        session.deck.interpreter.folders = {fs::path(piece.deck).parent_path(), "."}; // for calls of scripts
        if (piece.completion.how != Completion::How::done) {
            repeat_unfinished(session, piece);
            continue;
        }
        if (session.deck.interpreter.run_text(piece.text, piece.source, piece.line) == lang::Ended::quit) break;
    }
    // After the run, since it may have written some of them itself.
    compare(session, record.files, "the file");
    compare(session, record.joints, "the joint model");
    if (record.hash.empty()) {
        session.program.output.print("the journal does not say how its run ended");
        return 0;
    }
    const std::string hash = final_hash(session);
    if (hash == record.hash) {
        session.program.output.print(fmt::format("replayed: the same final state, hash {}", hash));
        return 0;
    }
    throw Diagnostic(fmt::format("the final state differs: hash {} and in the journal {}", hash, record.hash), {},
                     Fault::run);
}

} // namespace kaya
