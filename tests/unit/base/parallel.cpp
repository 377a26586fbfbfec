#include "base/parallel.hpp"
#include "base/reduce.hpp"
#include "base/thread_team.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace kaya;

/// Runs the body of a test with each number of threads, and restores one thread.
template <class Body> void with_threads(Body body) {
    for (const int count : {1, 2, 4}) {
        set_threads(count);
        body();
    }
    set_threads(1);
}

TEST(Parallel, EveryRowIsVisitedOnce) {
    with_threads([] {
        std::vector<int> visits(1003, 0);
        for_chunks(visits.size(), 10, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
        EXPECT_EQ(visits, std::vector<int>(1003, 1)) << threads() << " threads";
    });
}

TEST(Parallel, ChunksDependOnLengthAndGrainOnly) {
    with_threads([] {
        std::vector<std::pair<std::size_t, std::size_t>> chunks(4);
        for_chunks(35, 10, [&](std::size_t first, std::size_t last) { chunks[first / 10] = {first, last}; });
        const std::vector<std::pair<std::size_t, std::size_t>> expected{{0, 10}, {10, 20}, {20, 30}, {30, 35}};
        EXPECT_EQ(chunks, expected) << threads() << " threads";
    });
}

TEST(Parallel, NothingToDoCallsNothing) {
    for_chunks(0, 10, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(Parallel, GrainOfZeroIsOneRow) {
    int calls = 0;
    for_chunks(3, 0, [&](std::size_t first, std::size_t last) { calls += static_cast<int>(last - first); });
    EXPECT_EQ(calls, 3);
}

TEST(Parallel, LessThanOneThreadIsOne) {
    set_threads(-5);
    EXPECT_EQ(threads(), 1);
}

TEST(Parallel, ExceptionOfTheLowestChunkIsRethrown) {
    with_threads([] {
        const auto fails_twice = [](std::size_t first, std::size_t) {
            if (first == 30 || first == 70) throw std::runtime_error("chunk " + std::to_string(first));
        };
        try {
            for_chunks(100, 10, fails_twice);
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& e) { EXPECT_STREQ(e.what(), "chunk 30") << threads() << " threads"; }
    });
}

// The numbers span 16 decades, so that another order of additions changes the bits.
TEST(Reduce, SumHasTheSameBitsForAnyNumberOfThreads) {
    std::vector<double> numbers(5000);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = std::pow(10.0, static_cast<double>(i % 17) - 8) * (i % 2 == 0 ? 1 : -0.7);
    const auto sum = [&] {
        return reduce_chunks(
            numbers.size(), 64, 0.0,
            [&](std::size_t first, std::size_t last) {
                return std::accumulate(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                                       numbers.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
            },
            [](double& total, double part) { total += part; });
    };
    set_threads(1);
    const double alone = sum();
    EXPECT_NE(alone, std::accumulate(numbers.begin(), numbers.end(), 0.0)) << "the order would not show";
    with_threads([&] { EXPECT_EQ(sum(), alone) << threads() << " threads"; });
}

TEST(Reduce, PartsAreFoldedInOrder) {
    with_threads([] {
        const auto order = reduce_chunks(
            50, 10, std::vector<std::size_t>{}, [](std::size_t first, std::size_t) { return std::vector{first}; },
            [](std::vector<std::size_t>& all, const std::vector<std::size_t>& part) {
                all.insert(all.end(), part.begin(), part.end());
            });
        EXPECT_EQ(order, (std::vector<std::size_t>{0, 10, 20, 30, 40})) << threads() << " threads";
    });
}

TEST(Reduce, NothingGivesTheStartingValue) {
    const int result = reduce_chunks(
        0, 10, 42, [](std::size_t, std::size_t) { return 1; }, [](int& sum, int part) { sum += part; });
    EXPECT_EQ(result, 42);
}

/// Leaves of a tree whose nodes have four branches, each level by the same reduction.
int leaves(int levels) {
    if (levels == 0) return 1;
    return reduce_chunks(
        4, 1, 0, [&](std::size_t, std::size_t) { return leaves(levels - 1); }, [](int& sum, int part) { sum += part; });
}

TEST(Reduce, MayBeNested) {
    with_threads([] { EXPECT_EQ(leaves(4), 256) << threads() << " threads"; });
}

TEST(ThreadTeam, IsThatOfOneThreadAndOfItsLoops) {
    const int of_process = threads();
    ThreadTeam team(3);
    const ThreadTeam alone(-1);
    EXPECT_EQ(alone.count(), 1);
    {
        const WithTeam loops(&team);
        std::vector<int> seen(100);
        for_chunks(seen.size(), 1, [&](std::size_t first, std::size_t) { seen[first] = threads(); });
        EXPECT_EQ(seen, std::vector<int>(100, 3));
        {
            const WithTeam inner(&alone);
            EXPECT_EQ(threads(), 1);
        }
        team.set_count(2);
        EXPECT_EQ(threads(), 2);
        std::thread([&] { EXPECT_EQ(threads(), of_process); }).join();
    }
    EXPECT_EQ(threads(), of_process);
}

TEST(ThreadTeam, SeveralOwnersLoopAtOnce) {
    std::vector<std::thread> owners;
    for (int owner = 1; owner <= 4; ++owner)
        owners.emplace_back([owner] {
            ThreadTeam team(owner);
            const WithTeam loops(&team);
            for (int turn = 0; turn < 50; ++turn) {
                EXPECT_EQ(leaves(4), 256);
                EXPECT_THROW(for_chunks(10, 1, [](std::size_t, std::size_t) { throw std::runtime_error("x"); }),
                             std::runtime_error);
                team.set_count(1 + (owner + turn) % 3);
            }
        });
    for (auto& owner : owners) owner.join();
}

} // namespace
