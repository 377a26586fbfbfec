// Starts a thread that crashes later, outside any call of its library.
#include "tests/plugins/plugin.hpp"

#include <chrono>
#include <thread>

namespace {

// The system shall find the fault, also where a sanitizer looks for it.
[[gnu::no_sanitize("undefined", "address")]] void crash_soon() {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
}

ptrdiff_t run(kaya_jbatch* batch) {
    if (batch->history[0][0] == 50) std::thread(crash_soon).detach();
    return plugin::push(batch);
}

} // namespace

const kaya_jmodel* kaya_joint_model(void) {
    static kaya_jmodel model = plugin::working("crashes-behind-run");
    model.run = run;
    return &model;
}
