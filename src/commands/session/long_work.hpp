// Long commands without a cycle: cutting and meshing many blocks.
#pragma once

#include "commands/session/session.hpp"

#include "base/progress_callback.hpp"

#include <chrono>
#include <string>

namespace kaya {

/// Stops the work on request and shows its progress: in place, five times a second, on a terminal; as a line every ten seconds elsewhere.
/// Pass it as ProgressCallback, by std::ref.
class LongWork {
public:
    LongWork(Session& session, std::string what);
    ~LongWork();
    LongWork(const LongWork&) = delete;
    LongWork& operator=(const LongWork&) = delete;

    /// Throws Diagnostic when the work shall stop.
    void operator()(double done);

private:
    Session& session_;
    std::string what_;
    std::chrono::steady_clock::time_point shown_;
    int until_check_ = 0;
};

} // namespace kaya
