// Sums and extremes whose bits do not depend on the number of threads.
#pragma once

#include "base/parallel.hpp"

#include <deque>
#include <vector>

namespace kaya {

/// A list of parts that is kept by the thread for the next reduction, so that a steady cycle allocates nothing. A reduction
/// inside of another, or one that a waiting thread takes over, gets a list of its own: they end in the opposite order. So there
/// is nothing that a caller could get wrong, and no loop has to bring a list along.
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
