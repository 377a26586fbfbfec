// The threads of one owner of work, such as a session: another owner in the same process has its own number of them.
#pragma once

#include <functional>
#include <memory>

namespace kaya {

class ThreadTeam {
public:
    explicit ThreadTeam(int count);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int count() const { return count_; }
    /// For the next loop. Changing it changes no number, only the time.
    void set_count(int count);
    /// Calls `work`, whose parallel loops use the team.
    void enter(const std::function<void()>& work) const;

    /// Null: loops use the threads of the process (base/parallel.hpp).
    static const ThreadTeam* of_this_thread();

private:
    struct Arena;
    int count_;
    std::unique_ptr<Arena> arena_;
};

/// While it exists, loops of this thread use that team; null: the threads of the process.
class WithTeam {
public:
    explicit WithTeam(const ThreadTeam* team);
    ~WithTeam();
    WithTeam(const WithTeam&) = delete;
    WithTeam& operator=(const WithTeam&) = delete;

private:
    const ThreadTeam* before_;
};

} // namespace kaya
