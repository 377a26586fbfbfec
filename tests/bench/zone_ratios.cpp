// Cycles of blocks with zones compared with the bare method, in one run on one machine: docs/performance.md explains the rows.
#include "base/parallel.hpp"
#include "figures.hpp"
#include "zone_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace bench {

namespace {

constexpr std::uint32_t now = 3; ///< shear-now and tension-now in the states of the models that ship
constexpr Strength unlimited{1e15, 35, 5, 1e15},
    limited{1e6, 35, 5, 0.5e6}; ///< the second is that of zoned-plastic.3dd

double count(std::size_t n) { return static_cast<double>(n); }

/// The initial motion of the kernel, and zero stress.
void start(Run& run, double speed) {
    auto& g = run.model().gridpoints;
    for (std::size_t i = 0; i < g.size(); ++i) {
        const kaya::Vec3& x = g.reference[i];
        g.velocity[i] = speed * kaya::Vec3(std::sin(2 * x.y()) + 0.3 * x.z(), std::cos(3 * x.z()),
                                           std::sin(1.7 * x.x()) - 0.2 * x.z());
        g.position[i] = x;
    }
    for (auto& stress : run.model().zones.stress) stress.setZero();
}
void start(ZoneKernel& kernel, double speed) { kernel.start(speed); }

void advance(Run& run, int steps = 1) { run.cycles(steps); }
void advance(ZoneKernel& kernel, int steps = 1) {
    for (int s = 0; s < steps; ++s) kernel.step();
}

std::size_t zones_of(Run& run) { return run.model().zones.size(); }
std::size_t zones_of(const ZoneKernel& kernel) { return kernel.zones(); }

/// Fraction of the zones that yielded in the last step.
double yielding(Run& run) {
    const auto& state = run.model().zones.state;
    return count(static_cast<std::size_t>(
               std::count_if(state.begin(), state.end(), [](auto s) { return (s & now) != 0; }))) /
           count(state.size());
}
double yielding(const ZoneKernel& kernel) { return kernel.yielding(); }

/// The speed at which this fraction of the zones yields, averaged over some steps.
template <class Cycle> double speed_that_yields(Cycle& cycle, double part, int steps) {
    double low = 0.01, high = 100;
    for (int i = 0; i < 9; ++i) {
        const double speed = std::sqrt(low * high);
        start(cycle, speed);
        double sum = 0;
        for (int s = 0; s < steps; ++s) {
            advance(cycle);
            sum += yielding(cycle);
        }
        (sum / steps < part ? low : high) = speed;
    }
    return std::sqrt(low * high);
}

/// Seconds per zone and step, from the start.
template <class Cycle> double time_of(Cycle& cycle, double speed, int steps) {
    start(cycle, speed);
    advance(cycle);
    return timed([&] { advance(cycle, steps); }) / steps / count(zones_of(cycle));
}

/// Zone-steps per second over the kernel's.
double zones_against(ZoneKernel& kernel, double kernel_speed, Run& run, double speed, int turns, int steps) {
    std::vector<double> ratios;
    for (int i = 0; i < turns; ++i) {
        const double theirs = time_of(kernel, kernel_speed, steps);
        ratios.push_back(theirs / time_of(run, speed, steps));
    }
    return median(ratios);
}

double gain_of_second_thread(Run& run) {
    std::vector<double> gains;
    const auto time_with = [&](int threads) {
        kaya::set_threads(threads);
        run.cycles(1); // rebuilds the lists
        return timed([&] { run.cycles(20); }, seconds);
    };
    for (int i = 0; i < 7; ++i) {
        const double one = time_with(1);
        gains.push_back(one / time_with(2));
    }
    kaya::set_threads(1);
    return median(gains);
}

void elastic(std::vector<Row>& rows) {
    constexpr double speed = 0.3;
    ZoneKernel cubes(20, 2, unlimited), block(1, 29, unlimited);
    Run apart("zoned-cubes.3dd");
    rows.push_back({"8,000 cubes of 48 elastic zones, zone-steps per second over the kernel's",
                    zones_against(cubes, speed, apart, speed, 9, 10), "", 0.4, 0.6, true});
    rows.push_back({"the same, 2 threads over 1", gain_of_second_thread(apart), "", 1.6, 1.75, true});
    const double before = resident_bytes();
    Run whole("zoned-block.3dd");
    rows.push_back({"one block of 146,334 elastic zones, zone-steps per second over the kernel's",
                    zones_against(block, speed, whole, speed, 9, 10), "", 0.4, 0.6, true});
    rows.push_back({"its memory, all included, bytes per zone", (resident_bytes() - before) / count(zones_of(whole)),
                    "", 200, 150});
}

void plastic(std::vector<Row>& rows) {
    constexpr int steps = 20;
    ZoneKernel elastic(1, 20, unlimited), kernel(1, 20, limited);
    Run run("zoned-plastic.3dd");
    rows.push_back({"Mohr-Coulomb, nothing yields, six points in a cell, over the elastic kernel's",
                    zones_against(elastic, 0.3, run, 1e-6, 9, steps), "", 0.25, 0.4, true});
    const double theirs = speed_that_yields(kernel, 0.25, steps), ours = speed_that_yields(run, 0.25, steps);
    rows.push_back({"Mohr-Coulomb, a quarter yields, six points in a cell, over the plastic kernel's",
                    zones_against(kernel, theirs, run, ours, 9, steps), "", 0.3, 0.5, true});
}

/// A zone model written in plain loops over rows, compared with the one that ships.
void written_by_users(std::vector<Row>& rows) {
    constexpr int steps = 20;
    Run shipped("zoned-drucker.3dd"), users("zoned-cone.3dd");
    const double speed = speed_that_yields(shipped, 0.9, steps);
    std::vector<double> ratios;
    for (int i = 0; i < 9; ++i) {
        const double theirs = time_of(shipped, speed, steps);
        ratios.push_back(time_of(users, speed, steps) / theirs);
    }
    rows.push_back({"Drucker-Prager's cone from a user over the one that ships, nine tenths yield, time of a cycle",
                    median(ratios), "", 1.5, 1.2});
}

/// The complete cycle of blocks with contacts.
void jointed(std::vector<Row>& rows) {
    ZoneKernel kernel(20, 2, unlimited, true);
    Run run("zoned-packed.3dd");
    run.cycles(20);
    const auto paired = against_kernel(kernel, 5, 9, 5, [&] { run.cycles(5); });
    rows.push_back({"8,000 cubes of 48 zones with their joints, steps per second over the kernel's", 1 / paired.ratio,
                    "", 0.4, 0.6, true});
    rows.push_back({"their sub-contacts over the kernel's",
                    count(run.model().sub_contacts.size()) / count(kernel.sub_contacts()), "", 0, 0});
}

} // namespace

void zones(std::vector<Row>& rows) {
    elastic(rows);
    plastic(rows);
    written_by_users(rows);
    jointed(rows);
}

} // namespace bench
