// How long cycles take. A deck makes a model, then cycles are timed on one thread.
#include "run.hpp"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

namespace {

using bench::Run;

/// `count` cycles per iteration; each iteration starts from the deck's model.
void deck(benchmark::State& state, const std::string& file, std::int64_t count, bool rebuilding) {
    std::size_t zones = 0, sub_contacts = 0;
    for (auto _ : state) {
        state.PauseTiming();
        auto run = std::make_unique<Run>(file);
        state.ResumeTiming();
        if (rebuilding) run->rebuilding_cycles(count);
        else run->cycles(count);
        state.PauseTiming();
        zones = run->model().zones.size();
        sub_contacts = run->model().sub_contacts.size();
        run.reset();
        state.ResumeTiming();
    }
    state.counters["cycles"] = static_cast<double>(count);
    state.counters["per_cycle"] = benchmark::Counter(
        static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["zones"] = static_cast<double>(zones);
    state.counters["sub_contacts"] = static_cast<double>(sub_contacts);
}

void register_all() {
    const auto add = [](const char* name, const char* file, std::int64_t count, bool rebuilding = false) {
        benchmark::RegisterBenchmark(name, deck, file, count, rebuilding)->Unit(benchmark::kMillisecond)->Iterations(1);
    };
    add("direct_shear_with_fish", "direct-shear.3dd", 20000);
    add("direct_shear", "direct-shear-no-fish.3dd", 20000);
    add("packed_cubes_1000", "packed-cubes-10.3dd", 1000);
    add("packed_cubes_1000_fine", "packed-cubes-fine.3dd", 1000);
    add("packed_cubes_1000_rebuilt", "packed-cubes-10.3dd", 100, true);
    add("one_rigid_block", "one-block.3dd", 100000);
}

} // namespace

int main(int argc, char** argv) {
    register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
