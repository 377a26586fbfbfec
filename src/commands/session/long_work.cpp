#include "commands/session/long_work.hpp"

#include <fmt/format.h>

namespace kaya {

LongWork::LongWork(Session& session, std::string what)
    : session_(session), what_(std::move(what)), shown_(std::chrono::steady_clock::now()) {}

LongWork::~LongWork() { session_.program.output.end_refresh(); }

void LongWork::operator()(double done) {
    try {
        session_.stop_if_interrupted();
    } catch (Diagnostic& stop) {
        stop.add("the model is in its state before this command");
        throw;
    }
    constexpr int stride = 16; // steps between two checks of the clock
    if (--until_check_ > 0) return;
    until_check_ = stride;
    const auto now = std::chrono::steady_clock::now();
    const bool in_place = session_.program.output.in_place();
    if (std::chrono::duration<double>(now - shown_).count() < (in_place ? 0.2 : 10.0)) return;
    shown_ = now;
    const std::string line = fmt::format("{}: {:.0f} %", what_, 100 * done);
    if (in_place) session_.program.output.refresh(line);
    else session_.program.output.say(line);
}

} // namespace kaya
