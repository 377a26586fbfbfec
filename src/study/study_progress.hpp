// How far a study is: one line on a terminal, a line at each tenth elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace kaya {

class StudyProgress {
public:
    /// `quiet`: no output. Writes to the stream of messages.
    explicit StudyProgress(bool quiet);

    /// Number of runs to do, and how many of them are finished already.
    void begin(std::size_t runs, std::size_t there);
    void one_done(bool well);
    /// Removes the line.
    void end();
    void say(const std::string& text);

private:
    void show(bool last);

    bool quiet_, terminal_;
    std::size_t runs_ = 0, there_ = 0, done_ = 0, failed_ = 0, tenth_ = 0;
    std::chrono::steady_clock::time_point began_, shown_;
};

} // namespace kaya
