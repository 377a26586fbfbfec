// Speed of kaya relative to a bare kernel, and the times that it is computed from.
#pragma once

#include "run.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// One figure with its required value and target: upper limits unless `more` is set.
struct Row {
    std::string figure;
    double value;
    std::string unit;
    double must, aim; ///< 0: the figure is printed without a limit
    bool more = false;

    std::string verdict() const {
        if (must == 0) return "";
        const auto meets = [&](double limit) { return more ? value >= limit : value <= limit; };
        return meets(aim) ? "aim" : meets(must) ? "must" : "MISSED";
    }
};

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

template <class Call> double timed(const Call& call, double (*clock)() = processor_seconds) {
    const double start = clock();
    call();
    return clock() - start;
}

/// Median over turns of the ratio of times, because the speed of the machine varies between turns.
struct Paired {
    double ratio; ///< seconds per step over seconds per step of the kernel
    double ours, kernel;
};

template <class Kernel, class Call>
Paired against_kernel(Kernel& kernel, int kernel_steps, int turns, std::int64_t steps, const Call& ours) {
    std::vector<double> ratios, mine, theirs;
    for (int i = 0; i < turns; ++i) {
        const double k = timed([&] {
                             for (int s = 0; s < kernel_steps; ++s) kernel.step();
                         }) /
                         kernel_steps;
        const double o = timed(ours) / static_cast<double>(steps);
        ratios.push_back(o / k);
        mine.push_back(o);
        theirs.push_back(k);
    }
    return {median(ratios), median(mine), median(theirs)};
}

/// Resident memory of this process.
double resident_bytes();

/// Blocks with zones: zone_ratios.cpp.
void zones(std::vector<Row>& rows);

} // namespace bench
