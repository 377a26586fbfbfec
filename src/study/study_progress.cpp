#include "study/study_progress.hpp"

#include "base/terminal_text.hpp"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace kaya {

namespace {

std::string duration(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 120) return fmt::format("{} s", whole);
    if (whole < 7200) return fmt::format("{} min", (whole + 59) / 60);
    return fmt::format("{:.1f} h", static_cast<double>(whole) / 3600);
}

} // namespace

StudyProgress::StudyProgress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

void StudyProgress::begin(std::size_t runs, std::size_t there) {
    runs_ = runs, there_ = there, done_ = 0, failed_ = 0, tenth_ = 0;
    began_ = std::chrono::steady_clock::now();
    shown_ = began_ - std::chrono::hours(1);
    if (there > 0) say(fmt::format("{} of {} runs exist already", there, runs));
}

void StudyProgress::one_done(bool well) {
    ++done_;
    if (!well) ++failed_;
    show(there_ + done_ == runs_);
}

void StudyProgress::show(bool last) {
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    const std::size_t done = there_ + done_;
    const std::size_t tenth = runs_ > 0 ? 10 * done / runs_ : 10;
    if (terminal_ ? !last && now - shown_ < std::chrono::milliseconds(200) : runs_ < 10 || tenth == tenth_) return;
    shown_ = now, tenth_ = tenth;
    const double spent = std::chrono::duration<double>(now - began_).count();
    std::string line = fmt::format("{} of {} runs", done, runs_);
    if (failed_ > 0) line += fmt::format(", {} not done", failed_);
    if (!last && done_ > 0)
        line +=
            fmt::format(", {} left", duration(spent / static_cast<double>(done_) * static_cast<double>(runs_ - done)));
    if (terminal_) clear_line(stderr);
    print_text(stderr, terminal_ ? line : line + '\n');
    std::fflush(stderr);
}

void StudyProgress::end() {
    if (quiet_ || !terminal_) return;
    clear_line(stderr);
    std::fflush(stderr);
}

void StudyProgress::say(const std::string& text) {
    if (quiet_) return;
    if (terminal_) clear_line(stderr);
    print_text(stderr, text + '\n');
}

} // namespace kaya
