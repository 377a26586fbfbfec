// Checks what joint and zone models do to the process of the run.
#pragma once

namespace kaya {

class Session;

/// Warns of changes of the process by models (they are undone) and of models that start threads, each once. Throws Diagnostic when a model
/// has made a second process of the run.
void review_conduct(Session& session);

/// The same at intervals, after the cycle of that number: it costs some system calls.
void review_conduct_in_cycle(Session& session, long cycle);

} // namespace kaya
