// Says which joint model or zone model was at work when the program crashes.
#pragma once

#include "kaya/jmodel.h"

#include <cstdint>

namespace kaya {

/// From now on a crash (a bad address, a division by zero, abort(), a stack that is full) is reported on the
/// standard error before it ends the program, when a joint model is at work in the thread that crashed: its name and
/// file, what it was doing, and the sub-contact. Without a joint model at work nothing is said and nothing changes.
void report_crashes();

/// While it lives, a joint model is at work in this thread. Costs a few stores; nothing is allocated.
class AtWork {
public:
    /// `what` is "run", "initialise", ...; all texts must outlive this. `batch` may be NULL; `numbers` are those of its
    /// rows that users see, NULL: the report gives rows.
    AtWork(const char* model, const char* file, const char* what, const kaya_jbatch* batch = nullptr,
           const std::int32_t* numbers = nullptr, const char* noun = "joint model");
    ~AtWork();
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;

private:
    friend struct CrashReport;
    struct Call {
        const char *model, *file, *what;
        const kaya_jbatch* batch;
        const std::int32_t* numbers;
        const char* noun;
    } call_;
    const Call* before_;
};

} // namespace kaya
