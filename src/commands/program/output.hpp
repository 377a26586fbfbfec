// Output of a session: results to one stream, messages to another, both to the log. All of it is shown by base/terminal_text, in files too: they
// are read on terminals.
#pragma once

#include "base/diagnostic.hpp"
#include "system/door.hpp"

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace kaya {

/// The code of the message for a closed reader of the results.
inline constexpr const char* broken_pipe = "broken-pipe";

/// Results (`list`, `print`) go to `results`, messages (errors, warnings, progress) to `messages`; the
/// log file gets both. Writing throws Diagnostic with Fault::run when a disk is full.
class Output {
public:
    Output(std::FILE* results, std::FILE* messages);
    ~Output();
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    /// One or more lines of results; the last line end is added.
    void print(std::string_view text);

    /// A deck: unchanged into a file or a pipe, so that `kaya fmt a.3dd > b.3dd` keeps each byte; on a terminal as other text.
    void print_deck(const std::string& text);

    /// A message in the form of base/diagnostic. Never throws: a message must not hide what it reports.
    void message(const Diagnostic& diagnostic);

    /// A progress note; omitted when the session is quiet.
    void say(std::string_view text);
    /// The end of a search or a test, such as a factor of safety: a message that a quiet session has too.
    void conclude(std::string_view text);

    /// For the log only: the commands.
    void log_only(std::string_view text);

    /// Shows `text` in place of the last progress line; nothing where lines are not shown in place.
    void refresh(std::string_view text);
    /// Clears the progress line, so that the next line starts at the left.
    void end_refresh();
    bool on_terminal() const { return terminal_; }
    /// Whether a line of progress replaces the one before it: on a terminal, unless set otherwise.
    bool in_place() const { return in_place_; }
    void set_in_place(bool on) { in_place_ = on; }
    /// Whether messages are coloured; without it they are on a terminal, unless NO_COLOR is set.
    void set_colour(bool on) { colour_ = on; }

    /// Copies all that follows to a file, which is appended to. Throws Diagnostic when it cannot.
    void start_log(const std::string& file);
    /// Empties a file for it, and stops a present log.
    void empty_log(const std::string& file);
    void stop_log();
    bool logging() const { return static_cast<bool>(log_); }

    /// While it exists, printed text is captured. Text that is not taken is printed at the end.
    class Caught {
    public:
        explicit Caught(Output& output) : output_(output), outer_(std::exchange(output.caught_, &text_)) {}
        ~Caught();
        Caught(const Caught&) = delete;
        Caught& operator=(const Caught&) = delete;
        std::string take() { return std::exchange(text_, {}); }

    private:
        Output& output_;
        std::string* outer_;
        std::string text_;
    };

    bool is_caught() const { return caught_ != nullptr; }

    /// Hands everything to the system; throws Diagnostic when the results did not reach their place.
    void flush();

    bool quiet = false;

private:
    void open_log(const std::string& file, const char* mode);
    void write(std::FILE* stream, std::string_view text, const std::string& name);

    std::FILE* results_;
    std::FILE* messages_;
    door::Stream log_;
    std::string log_name_;
    bool terminal_ = false;
    bool in_place_ = false;
    bool colour_ = false;
    std::string* caught_ = nullptr; ///< the present capture; null: the stream
    std::size_t refreshed_ = 0;     ///< width of the present progress line
};

/// Results of a subcommand without a session: to the standard output.
void print_result(std::string_view text);

} // namespace kaya
