#include "commands/program/output.hpp"

#include "base/terminal_text.hpp"
#include "commands/program/fitted.hpp"
#include "system/terminal.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace kaya {

Output::Output(std::FILE* results, std::FILE* messages)
    : results_(results), messages_(messages), terminal_(is_terminal(messages)), in_place_(terminal_) {
    // Results of a long run can be read while it runs.
    std::setvbuf(results_, nullptr, _IOLBF, BUFSIZ);
    colour_ = terminal_ && std::getenv("NO_COLOR") == nullptr;
}

Output::~Output() = default;

namespace {

constexpr const char* the_results = "the standard output";

[[noreturn]] void fail_to_write(const std::string& name) {
    Diagnostic error(fmt::format("cannot write to {}: {}", name, std::strerror(errno)), "is the disk full?",
                     Fault::run);
    if (errno == EPIPE) error.code = broken_pipe;
    throw error;
}

} // namespace

void Output::write(std::FILE* stream, std::string_view text, const std::string& name) {
    errno = 0;
    if (print_text(stream, text) && std::fputc('\n', stream) != EOF) return;
    fail_to_write(name);
}

void Output::print(std::string_view text) {
    end_refresh();
    while (text.ends_with('\n')) text.remove_suffix(1);
    if (caught_ != nullptr) {
        caught_->append(text);
        caught_->push_back('\n');
        return;
    }
    write(results_, text, the_results);
    if (log_ != nullptr) write(log_.get(), text, "the log file " + log_name_);
}

void Output::print_deck(const std::string& text) {
    if (is_terminal(results_)) return print(text);
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), results_) != text.size()) fail_to_write(the_results);
}

Output::Caught::~Caught() {
    output_.caught_ = outer_;
    if (text_.empty()) return;
    try {
        output_.print(text_);
    } catch (const Diagnostic&) { // the end of the run reports that results cannot be written
    }
}

void Output::message(const Diagnostic& diagnostic) {
    end_refresh();
    // Text printed before the message must appear before it when both go to one terminal or file.
    std::fflush(results_);
    // render() has replaced control characters of its texts; the colours are ours.
    const std::string text = render(diagnostic, colour_, terminal_);
    std::fputs(((terminal_ ? fitted(text, columns_of(messages_)) : text) + '\n').c_str(), messages_);
    std::fflush(messages_);
    log_only(render(diagnostic, false, true));
}

void Output::say(std::string_view text) {
    if (quiet) log_only(text);
    else conclude(text);
}

void Output::conclude(std::string_view text) {
    log_only(text);
    end_refresh();
    std::fflush(results_);
    print_text(messages_, fmt::format("{}\n", text));
    std::fflush(messages_);
}

void Output::log_only(std::string_view text) {
    if (log_ != nullptr) print_text(log_.get(), fmt::format("{}\n", text));
}

void Output::refresh(std::string_view text) {
    if (!in_place_) return;
    const std::string shown = terminal_text(text);
    std::fputs(fmt::format("\r{:<{}}", shown, refreshed_).c_str(), messages_);
    refreshed_ = shown.size();
    std::fflush(messages_);
}

void Output::end_refresh() {
    if (refreshed_ == 0) return;
    std::fputs(fmt::format("\r{:<{}}\r", "", refreshed_).c_str(), messages_);
    refreshed_ = 0;
}

void Output::open_log(const std::string& file, const char* mode) {
    stop_log();
    log_ = door::open_stream(file, Use::write, mode);
    if (!log_)
        throw Diagnostic(fmt::format("cannot open the log file '{}': {}", file, std::strerror(errno)), {}, Fault::run);
    log_name_ = file;
}

void Output::start_log(const std::string& file) { open_log(file, "a"); }

void Output::empty_log(const std::string& file) {
    open_log(file, "w");
    stop_log();
}

void Output::stop_log() {
    if (log_ == nullptr) return;
    errno = 0;
    const bool failed = std::ferror(log_.get()) != 0;
    const bool closed = std::fclose(log_.release()) == 0;
    if (failed || !closed)
        throw Diagnostic(fmt::format("the log file '{}' is not complete: {}", log_name_, std::strerror(errno)),
                         "is the disk full?", Fault::run);
}

void Output::flush() {
    std::fflush(messages_);
    errno = 0;
    if (std::fflush(results_) != 0 || std::ferror(results_) != 0) fail_to_write(the_results);
    if (log_ != nullptr && std::fflush(log_.get()) != 0)
        throw Diagnostic(fmt::format("cannot write to the log file {}: {}", log_name_, std::strerror(errno)),
                         "is the disk full?", Fault::run);
}

void print_result(std::string_view text) {
    Output output(stdout, stderr);
    output.print(text);
    output.flush();
}

} // namespace kaya
