// How long cycles take. A deck makes a model, then cycles are timed on one thread.
#include "commands/session.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <string>

namespace {

/// A session that prints nothing, with the model of a deck of this folder.
class Run {
public:
    explicit Run(const std::string& deck) : silence_(std::fopen("/dev/null", "w"), &std::fclose) {
        kaya::Options options;
        options.threads = 1;
        options.quiet = true;
        options.joint_folders = {KAYA_JOINT_FOLDER};
        session_ = std::make_unique<kaya::Session>(options, silence_.get(), stderr);
        session_->run_deck(KAYA_BENCH_FOLDER "/" + deck);
    }
    void cycles(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) session_->cycle->advance();
    }
    std::size_t zones() const { return session_->model.zones.size(); }
    std::size_t sub_contacts() const { return session_->model.sub_contacts.size(); }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> silence_;
    std::unique_ptr<kaya::Session> session_;
};

/// `count` cycles per iteration; each iteration starts from the deck's model.
void deck(benchmark::State& state, const std::string& file, std::int64_t count) {
    std::size_t zones = 0, sub_contacts = 0;
    for (auto _ : state) {
        state.PauseTiming();
        auto run = std::make_unique<Run>(file);
        state.ResumeTiming();
        run->cycles(count);
        state.PauseTiming();
        zones = run->zones();
        sub_contacts = run->sub_contacts();
        run.reset();
        state.ResumeTiming();
    }
    state.counters["cycles"] = static_cast<double>(count);
    state.counters["per_cycle"] = benchmark::Counter(static_cast<double>(count),
                                                     benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
    state.counters["zones"] = static_cast<double>(zones);
    state.counters["sub_contacts"] = static_cast<double>(sub_contacts);
}

void register_all() {
    const auto add = [](const char* name, const char* file, std::int64_t count) {
        benchmark::RegisterBenchmark(name, deck, file, count)->Unit(benchmark::kMillisecond)->Iterations(1);
    };
    add("direct_shear_with_fish", "direct-shear.3dd", 20000);
    add("direct_shear", "direct-shear-no-fish.3dd", 20000);
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
