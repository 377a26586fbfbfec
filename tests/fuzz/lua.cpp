// Untrusted Lua of a deck, on a small world: it runs for a short time, and its state is saved and restored.
#include "harness.hpp"

#include "../unit/script/fake_world.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

using namespace kaya;

namespace {

/// Stops scripts that run for too long, like Ctrl-C.
class FinishScripts {
public:
    explicit FinishScripts(script::Scripts& scripts)
        : thread_([this, &scripts] {
              std::unique_lock lock(mutex_);
              while (!wake_.wait_for(lock, std::chrono::milliseconds(200), [this] { return over_; }))
                  scripts.interrupt();
          }) {}
    ~FinishScripts() {
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

private:
    std::mutex mutex_;
    std::condition_variable wake_;
    bool over_ = false;
    std::thread thread_; ///< last: it uses the others
};

template <class Action> void survive(Action action) {
    try {
        action();
    } catch (const Diagnostic& mistake) {
        if (mistake.fault == Fault::own || render(mistake, true).empty()) std::abort();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string text = fuzz::text_of(data, size);
    script::Options options;
    options.memory = 64 << 20;
    script::test::Stage stage(2, 4, options);
    stage.fish("def twice(a)\ntwice = 2 * a\nend\n");
    const FinishScripts watch(stage.scripts);
    survive([&] { stage.lua(text); });
    survive([&] { stage.scripts.run_hooks(script::Moment::after_cycle, 10); });
    survive([&] {
        const std::string bytes = script::to_bytes(stage.scripts.state());
        stage.scripts.restore(script::from_bytes(bytes));
    });
    survive([&] { (void)script::from_bytes(text); });
    return 0;
}
