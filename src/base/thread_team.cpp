#include "base/thread_team.hpp"

#include <algorithm>
#include <oneapi/tbb/task_arena.h>
#include <utility>

namespace kaya {

namespace {

thread_local const ThreadTeam* team_of_thread = nullptr;

} // namespace

/// One place is kept for the owner, which therefore works itself: its settings of a thread hold in `work`.
struct ThreadTeam::Arena {
    explicit Arena(int count) : tbb(count, 1) {}
    mutable oneapi::tbb::task_arena tbb;
};

ThreadTeam::ThreadTeam(int count) : count_(std::max(1, count)), arena_(std::make_unique<Arena>(count_)) {}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::set_count(int count) {
    count_ = std::max(1, count);
    arena_ = std::make_unique<Arena>(count_);
}

void ThreadTeam::enter(const std::function<void()>& work) const { arena_->tbb.execute(work); }

const ThreadTeam* ThreadTeam::of_this_thread() { return team_of_thread; }

WithTeam::WithTeam(const ThreadTeam* team) : before_(std::exchange(team_of_thread, team)) {}

WithTeam::~WithTeam() { team_of_thread = before_; }

} // namespace kaya
