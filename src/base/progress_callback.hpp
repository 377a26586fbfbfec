// Progress reports of long work.
#pragma once

#include <cstddef>
#include <functional>

namespace kaya {

/// Called between the parts of long work with the fraction done. It may throw to stop the work, which must change nothing before its end.
/// Empty: progress is not reported.
using ProgressCallback = std::function<void(double done)>;

/// Reports the fraction `done` of part `part` of `parts`.
inline void report_progress(const ProgressCallback& progress, std::size_t part, std::size_t parts, double done = 0) {
    if (progress) progress((static_cast<double>(part) + done) / static_cast<double>(parts));
}

} // namespace kaya
