#include "commands/output.hpp"

#include "commands/fitted.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace kaya {

namespace {

std::size_t columns_of(std::FILE* terminal) {
    winsize size{};
    return ioctl(fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace

Output::Output(std::FILE* results, std::FILE* messages)
    : results_(results), messages_(messages), terminal_(isatty(fileno(messages)) == 1) {
    // Results of a long run can be read while it runs.
    std::setvbuf(results_, nullptr, _IOLBF, BUFSIZ);
    colour_ = terminal_ && std::getenv("NO_COLOR") == nullptr;
}

Output::~Output() = default;

namespace {

[[noreturn]] void fail_to_write(const std::string& name) {
    Diagnostic error(fmt::format("cannot write to {}: {}", name, std::strerror(errno)), "is the disk full?",
                     Fault::run);
    if (errno == EPIPE) error.code = broken_pipe;
    throw error;
}

} // namespace

void Output::write(std::FILE* stream, std::string_view text, const std::string& name) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    if (written && std::fputc('\n', stream) != EOF) return;
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
    write(results_, text, "the standard output");
    if (log_ != nullptr) write(log_.get(), text, "the log file " + log_name_);
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
    const std::string text = render(diagnostic, colour_, terminal_);
    fmt::print(messages_, "{}\n", terminal_ ? fitted(text, columns_of(messages_)) : text);
    std::fflush(messages_);
    if (log_ != nullptr) fmt::print(log_.get(), "{}\n", render(diagnostic, false, true));
}

void Output::say(std::string_view text) {
    if (log_ != nullptr) fmt::print(log_.get(), "{}\n", text);
    if (quiet) return;
    end_refresh();
    std::fflush(results_);
    fmt::print(messages_, "{}\n", text);
    std::fflush(messages_);
}

void Output::log_only(std::string_view text) {
    if (log_ != nullptr) fmt::print(log_.get(), "{}\n", text);
}

void Output::refresh(std::string_view text) {
    if (quiet || !terminal_) return;
    fmt::print(messages_, "\r{:<{}}", text, refreshed_);
    refreshed_ = text.size();
    std::fflush(messages_);
}

void Output::end_refresh() {
    if (refreshed_ == 0) return;
    fmt::print(messages_, "\r{:<{}}\r", "", refreshed_);
    refreshed_ = 0;
}

void Output::start_log(const std::string& file) {
    stop_log();
    log_ = door::open_stream(file, Use::write, "a");
    if (!log_)
        throw Diagnostic(fmt::format("cannot open the log file '{}': {}", file, std::strerror(errno)), {}, Fault::run);
    log_name_ = file;
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
    if (std::fflush(results_) != 0 || std::ferror(results_) != 0) fail_to_write("the standard output");
    if (log_ != nullptr && std::fflush(log_.get()) != 0)
        throw Diagnostic(fmt::format("cannot write to the log file {}: {}", log_name_, std::strerror(errno)),
                         "is the disk full?", Fault::run);
}

} // namespace kaya
