// Sums and extremes whose bits do not depend on the number of threads.
#pragma once

#include "base/parallel.hpp"

#include <deque>
#include <vector>

namespace kaya {

/// A list of parts that the thread keeps for its next reduction, so that a steady cycle allocates nothing. A nested reduction, or one that
/// a waiting thread takes over, gets a separate list: they end in the opposite order. Callers need not pass a list.
template <class Part> class KeptParts {
public:
    explicit KeptParts(std::size_t count) : parts_(next()) { parts_.assign(count, Part{}); }
    ~KeptParts() { --depth(); }
    KeptParts(const KeptParts&) = delete;
    KeptParts& operator=(const KeptParts&) = delete;

    std::vector<Part>& operator*() { return parts_; }

private:
    static std::size_t& depth() {
        static thread_local std::size_t depth = 0;
        return depth;
    }
    static std::vector<Part>& next() {
        static thread_local std::deque<std::vector<Part>> lists;
        if (depth() == lists.size()) lists.emplace_back();
        return lists[depth()++];
    }

    std::vector<Part>& parts_;
};

/// Calls body(first, last) -> Part for consecutive chunks and folds the parts in chunk order:
/// combine(result, part).
template <class Part, class Body, class Combine>
Part reduce_chunks(std::size_t n, std::size_t grain, Part result, Body body, Combine combine) {
    if (n <= grain) {
        if (n > 0) combine(result, body(std::size_t{0}, n));
        return result;
    }
    KeptParts<Part> parts((n + grain - 1) / grain);
    Part* const out = (*parts).data(); // of this thread, whichever thread writes to it
    for_chunks(n, grain, [&](std::size_t first, std::size_t last) { out[first / grain] = body(first, last); });
    for (const Part& part : *parts) combine(result, part);
    return result;
}

} // namespace kaya
