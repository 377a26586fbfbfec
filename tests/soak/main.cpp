// soak KIND SEED COUNT [--first N] [--show] [--program FILE] [--keep FOLDER]: cases of a kind generated from a seed, each in a separate
// process. A finding is a crash, exit status 3, a hang or a message of a sanitizer; the status is 1 if there is one, or if too few cases
// end normally or are refused. `--first N --show`, with a COUNT of 1, repeats one case. docs: tests/soak/README.md.
#include "cases.hpp"

#include "app/work.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <unistd.h>

namespace kaya::soak {

namespace {

namespace fs = std::filesystem;

struct Order {
    std::string kind, program, keep;
    std::uint64_t seed = 1;
    long count = 100, first = 0;
    bool show = false;
};

int run_here(std::vector<std::string> words) {
    words.insert(words.begin(), "kaya");
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return work(static_cast<int>(words.size()), pointers.data());
}

Work work_of(const Order& order) {
    if (order.program.empty()) return run_here;
    return [program = order.program](std::vector<std::string> words) {
        words.insert(words.begin(), program);
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        ::execv(program.c_str(), pointers.data());
        return 99;
    };
}

Limits limits_of(const Order& order) {
    Limits limits;
    limits.waits = !order.program.empty();
    if (const char* slower = std::getenv("KAYA_SLOWER")) {
        limits.asked_after *= std::atof(slower);
        limits.seconds *= std::atof(slower);
    }
    return limits;
}

/// Prints the end of the output of the case, and keeps its files.
void report(const Order& order, long number, const Case& one, const Verdict& verdict, const fs::path& said) {
    fmt::print("finding: {}: soak {} {} 1 --first {}: kaya {}\n", verdict.finding, order.kind, order.seed, number,
               fmt::join(one.words, " "));
    std::string text = test::content_of(said.string());
    if (text.size() > 3000) text.erase(0, text.size() - 3000);
    fmt::print("{}\n", text);
    std::fflush(stdout);
    if (order.keep.empty()) return;
    const fs::path folder = fs::path(order.keep) / fmt::format("{}-{}-{}", order.kind, order.seed, number);
    fs::create_directories(folder);
    for (const File& file : one.files) test::put((folder / file.name).string(), file.bytes);
    test::put((folder / "words").string(), fmt::format("{}\n", fmt::join(one.words, "\n")));
}

struct Sums {
    std::array<long, 4> status{}; ///< 0, 1, 2, others
    long asked = 0, findings = 0;
    double seconds = 0, longest = 0;

    void add(const Verdict& verdict) {
        ++status[static_cast<std::size_t>(std::min(verdict.status, 3))];
        asked += verdict.was_asked;
        findings += !verdict.finding.empty();
        seconds += verdict.seconds;
        longest = std::max(longest, verdict.seconds);
    }
};

/// The journal of a run.
std::string journal(const test::ScratchFolder& folder, const Limits& limits, const Work& work) {
    const fs::path place = folder / "journal";
    const Verdict verdict = trial(Cases::journal_run(), place, folder / "said", limits, work);
    if (verdict.status != 0)
        throw std::runtime_error("the run whose journal is changed fails: " + test::content_of(folder / "said"));
    return test::content_of((place / "good.journal").string());
}

int soak(const Order& order, const Kind& kind) {
    const test::ScratchFolder folder;
    const fs::path home = folder / "home", place = folder / "case", said = folder / "said";
    fs::create_directories(home);
    ::setenv("HOME", home.c_str(), 1);
    ::setenv("XDG_CONFIG_HOME", home.c_str(), 1);
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    const Work work = work_of(order);
    const Limits limits = limits_of(order);
    Cases cases;
    if (kind.make == &Cases::journals) cases.set_journal(journal(folder, limits, work));
    Sums sums;
    for (long number = order.first; number < order.first + order.count; ++number) {
        Chance chance(order.seed * 1000003 + static_cast<std::uint64_t>(number));
        const Case one = (cases.*kind.make)(chance);
        const Verdict verdict = trial(one, place, said, limits, work);
        sums.add(verdict);
        if (!verdict.finding.empty()) report(order, number, one, verdict, said);
        if (!order.show) continue;
        for (const File& file : one.files) fmt::print("--- {}\n{}\n", file.name, file.bytes);
        fmt::print("--- kaya {}: status {}, {:.2f} s\n{}\n", fmt::join(one.words, " "), verdict.status, verdict.seconds,
                   test::content_of(said.string()));
    }
    fmt::print(
        "{}, seed {}: {} cases from {} in {:.0f} s, longest {:.1f} s; status 0: {}, 1: {}, 2: {}, other: {}; asked to stop: {}; findings: {}\n",
        order.kind, order.seed, order.count, order.first, sums.seconds, sums.longest, sums.status[0], sums.status[1],
        sums.status[2], sums.status[3], sums.asked, sums.findings);
    constexpr long enough = 20; // of ten cases none may end normally by chance
    const long least = order.count < enough ? 0 : static_cast<long>(kind.least * static_cast<double>(order.count));
    if (sums.status[0] < least || sums.status[1] + sums.status[2] < least) {
        fmt::print("too few of them were done or refused: the generator of {} tests too little\n", order.kind);
        return 1;
    }
    return sums.findings == 0 ? 0 : 1;
}

/// Shows that findings are detected: work that crashes, fails with an internal error, never ends, or exhausts the memory.
int proof() {
    const test::ScratchFolder folder;
    Limits limits;
    limits.asked_after = 0.2;
    limits.seconds = 0.5;
    struct Fault {
        const char* name;
        Work work;
    };
    const std::vector<Fault> faults{
        {"abort", [](const auto&) -> int { std::abort(); }},
        {"bad address", [](const auto&) -> int { return ::raise(SIGSEGV); }},
        {"status 3", [](const auto&) { return 3; }},
        {"hang",
         [](const auto&) -> int {
             std::signal(SIGINT, SIG_IGN);
             for (;;) ::pause();
         }},
        {"words", [](const auto&) { return std::puts("error: internal error: so it says") < 0; }},
    };
    int missed = 0;
    for (const Fault& fault : faults) {
        const Verdict verdict = trial({}, folder / "case", folder / "said", limits, fault.work);
        if (verdict.finding.empty()) fmt::print("not found: {}\n", fault.name), ++missed;
    }
    const Verdict good = trial({}, folder / "case", folder / "said", limits, [](const auto&) { return 0; });
    if (!good.finding.empty()) fmt::print("found in a good one: {}\n", good.finding), ++missed;
    return missed;
}

std::optional<Order> read(int argc, char** argv) {
    if (argc < 4) return std::nullopt;
    Order order;
    order.kind = argv[1];
    order.seed = std::strtoull(argv[2], nullptr, 10);
    order.count = std::atol(argv[3]);
    for (int k = 4; k < argc; ++k) {
        const std::string word = argv[k];
        if (word == "--show") order.show = true;
        else if (k + 1 == argc) return std::nullopt;
        else if (word == "--first") order.first = std::atol(argv[++k]);
        else if (word == "--program") order.program = fs::absolute(argv[++k]).string();
        else if (word == "--keep") order.keep = fs::absolute(argv[++k]).string();
        else return std::nullopt;
    }
    return order;
}

} // namespace

int start(int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "proof") return proof();
    const auto order = read(argc, argv);
    const auto kind = std::ranges::find_if(kinds(), [&](const Kind& k) { return order && k.name == order->kind; });
    if (order && kind != kinds().end()) return soak(*order, *kind);
    fmt::print(
        stderr,
        "usage: soak KIND SEED COUNT [--first N] [--show] [--program FILE] [--keep FOLDER]\n       soak proof\n");
    for (const Kind& k : kinds()) fmt::print(stderr, "  {:14} {}\n", k.name, k.help);
    return 2;
}

} // namespace kaya::soak

int main(int argc, char** argv) { return kaya::soak::start(argc, argv); }
