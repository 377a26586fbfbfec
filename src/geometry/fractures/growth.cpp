#include "geometry/fractures/growth.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/fractures/fracture.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya {
namespace {

/// The part of the target that a disc adds.
double gain(const Growth& growth, const Disc& disc) {
    using enum Growth::Until;
    switch (growth.until) {
    case count: return 1;
    case area: return p32(std::array{disc}, growth.low, growth.high);
    case percolation: return excluded_volume(0.5 * disc.diameter) / (growth.high - growth.low).prod();
    case crossings: return p10(std::array{disc}, growth.begin, growth.end);
    }
    return 0;
}

} // namespace

std::vector<Disc> grow(const FractureLaw& law, const Growth& growth, Random random,
                       const std::function<void(double)>& progress) {
    constexpr std::size_t most_fractures = 1'000'000, between_reports = 256;
    check(law);
    std::vector<Disc> discs;
    double reached = 0;
    while (reached < growth.target) {
        stop_point();
        if (progress && discs.size() % between_reports == 0) progress(reached / growth.target);
        if (discs.size() == most_fractures)
            throw Diagnostic(fmt::format("a million fractures reach {:.3g} of {:g} only", reached, growth.target),
                             "ask for a lower density, or for larger fractures");
        const Disc disc = draw(law, growth.low, growth.high, random);
        const double more = gain(growth, disc);
        if (reached + more - growth.target > growth.target - reached) break;
        discs.push_back(disc);
        reached += more;
    }
    return discs;
}

} // namespace kaya
