// kaya compared with the bare method, in one run on one machine: docs/performance.md explains the rows.
#include "base/parallel.hpp"
#include "figures.hpp"
#include "rigid_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

/// As reported by the system.
double bench::resident_bytes() {
    std::ifstream file("/proc/self/statm");
    double pages = 0, resident = 0;
    file >> pages >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

namespace {

using bench::median;
using bench::resident_bytes;
using bench::Row;
using bench::Run;
using bench::timed;

bench::Paired against_kernel(bench::RigidKernel& kernel, int turns, std::int64_t steps,
                             const std::function<void()>& ours) {
    return bench::against_kernel(kernel, 300, turns, steps, ours);
}

std::filesystem::path written(const std::string& name, const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / name;
    std::ofstream(path) << text;
    return path;
}

double count(std::size_t n) { return static_cast<double>(n); }

/// Adjacent pairs, at faces, edges and corners, in a box of n cubes in each direction, with those of its floor and four walls.
double neighbours(double n) {
    const double m = n - 1, cubes = 3 * n * n * m + 6 * n * m * m + 4 * m * m * m;
    return cubes + 5 * n * n;
}

/// A thousand cubes at rest.
bench::RigidKernel kernel_at_rest() {
    bench::RigidKernel kernel(10);
    for (int i = 0; i < 2000; ++i) kernel.step();
    return kernel;
}

/// A thousand cubes at rest, with kept and with rebuilt contacts, compared with the kernel with as many cubes.
void packed_cubes(std::vector<Row>& rows) {
    bench::RigidKernel kernel = kernel_at_rest();
    Run run("packed-cubes-10.3dd");
    run.cycles(1000);
    const double contacts = count(run.model().contacts.size());
    const double pairs = count(kernel.pairs());
    const auto kept = against_kernel(kernel, 9, 200, [&] { run.cycles(200); });
    rows.push_back({"cycle at rest, face pairs per second over the kernel's", contacts / kept.ratio / pairs, "",
                    1.0 / 3, 0.5, true});
    Run fine("packed-cubes-fine.3dd");
    fine.cycles(1000);
    const auto divided = against_kernel(kernel, 9, 200, [&] { fine.cycles(200); });
    rows.push_back({"cubes with sixteen sub-contacts on a face, per sub-contact",
                    count(fine.model().sub_contacts.size()) / divided.ratio / (8 * pairs), "", 1.0 / 3, 0.5, true});
    const auto anew = against_kernel(kernel, 7, 20, [&] { run.rebuilding_cycles(20); });
    // Other programs count every pair of cubes with adjacent boxes, including those with a common edge or corner: 1.4 microseconds for such
    // a pair, where the kernel takes 68.5 nanoseconds for a pair of faces.
    rows.push_back({"contacts made anew in every step: time per pair that is near, over the kernel's per face pair",
                    anew.ratio * pairs / neighbours(10), "", 1.4 / 0.0685, 0.7 / 0.0685});
    rows.push_back({"the same in microseconds", anew.ours / neighbours(10) * 1e6, "us", 1.4, 0.7});
    // A third of these pairs have a common face and therefore a contact.
    rows.push_back({"the same per pair with a common face", anew.ours / contacts * 1e6, "us", 0, 0});
}

void growth(std::vector<Row>& rows) {
    const double before = resident_bytes();
    Run run("packed-cubes-46.3dd");
    run.cycles(30);
    const double kept = resident_bytes() - before;
    Run few("packed-cubes-10.3dd");
    few.cycles(1000);
    std::vector<double> ratios;
    for (int i = 0; i < 7; ++i) { // in turn, as with the kernel
        const auto per_block = [](Run& one, std::int64_t steps) {
            return timed([&] { one.cycles(steps); }) / static_cast<double>(steps) / count(one.model().blocks.size());
        };
        const double small = per_block(few, 600);
        ratios.push_back(per_block(run, 8) / small);
    }
    rows.push_back({"time per block, 97,336 cubes over 1,000", median(ratios), "", 1.3, 1.1});
    const double blocks = count(run.model().blocks.size()), subs = count(run.model().sub_contacts.size());
    const double allowed = 3000 * blocks + 400 * subs;
    rows.push_back(
        {"memory of 97,336 cubes, part of 3 kB a block and 400 B a sub-contact", kept / allowed, "", 1, 0.5});
}

void threads(std::vector<Row>& rows) {
    Run run("packed-cubes-20.3dd");
    run.cycles(30);
    std::vector<double> gains;
    for (int i = 0; i < 5; ++i) {
        kaya::set_threads(1);
        const double one = timed([&] { run.cycles(30); }, bench::seconds);
        kaya::set_threads(2);
        gains.push_back(one / timed([&] { run.cycles(30); }, bench::seconds));
    }
    kaya::set_threads(1);
    rows.push_back({"2 threads over 1, 8,000 cubes", median(gains), "", 1.5, 1.75, true});
}

void small_models(std::vector<Row>& rows) {
    Run run("one-block.3dd");
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) times.push_back(timed([&] { run.cycles(20000); }) / 20000);
    rows.push_back({"model of one block, per step", median(times) * 1e6, "us", 2, 1});
}

/// Joint sets of three materials cross everywhere: sub-contacts of one material must still be consecutive.
void materials(std::vector<Row>& rows) {
    Run one("jointed-rock.3dd"), three("jointed-rock-mixed.3dd");
    one.cycles(20);
    three.cycles(20);
    std::vector<double> ratios;
    for (int i = 0; i < 7; ++i) {
        const double alike = timed([&] { one.cycles(20); });
        ratios.push_back(timed([&] { three.cycles(20); }) / alike);
    }
    rows.push_back({"10,000 blocks with three joint materials over the same with one", median(ratios), "", 1.1, 1.05});
}

/// Blocks that meet along lines, in most of which rounding alone makes an overlap.
double per_contact(Run& run, bench::RigidKernel& kernel, std::int64_t steps) {
    const auto paired = against_kernel(kernel, 5, steps, [&] { run.cycles(steps); });
    return paired.ratio * count(kernel.pairs()) / count(run.model().contacts.size());
}

void prisms(std::vector<Row>& rows) {
    bench::RigidKernel kernel = kernel_at_rest();
    const auto measured = [&](const std::string& deck) {
        Run run(deck);
        run.cycles(100);
        return per_contact(run, kernel, 50);
    };
    rows.push_back({"wall of 2,303 prisms, time per contact over the kernel's per face pair",
                    measured("prism-wall.3dd"), "", 0, 0});
    rows.push_back({"the same held", measured("prism-wall-held.3dd"), "", 0, 0});
}

/// The deck of an example up to a line, which another one replaces.
std::filesystem::path beginning_of(const std::string& example, const std::string& line, const std::string& other) {
    std::ifstream file(KAYA_BENCH_FOLDER "/../../examples/" + example + "/" + example + ".3dd");
    std::ostringstream text;
    for (std::string next; std::getline(file, next) && next != line;) text << next << '\n';
    if (!file) throw std::runtime_error("the example " + example + " has no line " + line);
    text << other << '\n';
    return written("kaya-bench-" + example + ".3dd", text.str());
}

/// Decks of users, in which blocks of all sizes slide, rock and part.
void decks(std::vector<Row>& rows) {
    bench::RigidKernel kernel = kernel_at_rest();
    const auto slope = beginning_of("rock-slope", "solve elastic ratio 1e-5 cycles 20000", "cycle 1");
    Run falling(slope.string());
    falling.cycles(300);
    rows.push_back({"rock-slope after 300 cycles, time per contact over the kernel's per face pair",
                    per_contact(falling, kernel, 20), "", 15, 8});
    falling.cycles(1200);
    rows.push_back({"the same after 1,500 cycles", per_contact(falling, kernel, 20), "", 15, 8});
    const auto wall = beginning_of("masonry-wall", "cycle time 1.2", "cycle time 0.35");
    Run shaken(wall.string());
    rows.push_back({"masonry-wall, shaken for 0.35 s, time per contact over the kernel's per face pair",
                    per_contact(shaken, kernel, 200), "", 15, 8});
}

void building(std::vector<Row>& rows) {
    rows.push_back({"10,000 blocks by joint sets, contacts included", timed([] {
                        Run run("jointed-rock.3dd");
                        run.cycles(1);
                        if (run.model().blocks.size() < 10000) throw std::runtime_error("too few blocks");
                    }),
                    "s", 20, 5});
    std::ostringstream lines;
    for (int i = 0; i < 100000; ++i)
        lines << "poly brick " << i % 50 << ' ' << i % 50 + 1 << ' ' << i / 50 % 50 << ' ' << i / 50 % 50 + 1 << ' '
              << i / 2500 << ' ' << i / 2500 + 1 << '\n';
    const auto deck = written("kaya-bench-lines.3dd", lines.str());
    rows.push_back(
        {"100,000 lines of poly brick: read, bind and build", timed([&] { Run run(deck.string()); }), "s", 1, 0.3});
    std::filesystem::remove(deck);
}

/// The same cubes with Yade's polyhedra, if Debian's yade is installed.
void yade(std::vector<Row>& rows) {
    if (std::system("command -v yade > /dev/null 2>&1") != 0) return;
    const auto result = std::filesystem::temp_directory_path() / "kaya-bench-yade.txt";
    const std::string command =
        "RESULT=" + result.string() + " yade -n -x -j1 " KAYA_BENCH_FOLDER "/yade_cubes.py > /dev/null 2>&1";
    Run run("packed-cubes-10.3dd");
    run.cycles(1000);
    const double ours = timed([&] { run.cycles(300); }) / 300;
    if (std::system(command.c_str()) != 0) return;
    double theirs = 0;
    std::ifstream(result) >> theirs;
    std::filesystem::remove(result);
    if (theirs <= 0) return;
    rows.push_back({"1,000 cubes at rest, times as fast as Yade's polyhedra", theirs / ours, "", 1200, 2500, true});
    const double anew = timed([&] { run.rebuilding_cycles(30); }) / 30;
    // Yade detects its contacts in every step, too.
    rows.push_back({"the same with contacts made anew in every step", theirs / anew, "", 0, 0, true});
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

} // namespace

int main(int argc, char** argv) {
    const std::string csv = argc > 1 ? argv[1] : "ratios.csv";
    const std::string wanted = argc > 2 ? argv[2] : "";
    std::vector<Row> rows;
    const std::pair<std::string_view, void (*)(std::vector<Row>&)> parts[] = {
        {"cubes", packed_cubes}, {"threads", threads}, {"one", small_models},  {"materials", materials},
        {"prisms", prisms},      {"decks", decks},     {"building", building}, {"growth", growth},
        {"zones", bench::zones}, {"yade", yade}};
    for (const auto& [name, part] : parts) {
        if (!wanted.empty() && name != wanted) continue;
        const std::size_t first = rows.size();
        part(rows);
        for (std::size_t i = first; i < rows.size(); ++i)
            fmt::print("{:95} {:10.4g} {:3}{}\n", rows[i].figure, rows[i].value, rows[i].unit,
                       rows[i].must == 0 ? ""
                                         : fmt::format(" must {:8.4g} aim {:8.4g}  {}", rows[i].must, rows[i].aim,
                                                       rows[i].verdict()));
        std::fflush(stdout);
    }
    const bool is_new = !std::filesystem::exists(csv);
    std::ofstream file(csv, std::ios::app);
    if (is_new) file << "processor,figure,value,unit,must,aim,verdict\n";
    for (const auto& row : rows)
        file << fmt::format("\"{}\",\"{}\",{},{},{},{},{}\n", processor(), row.figure, row.value, row.unit, row.must,
                            row.aim, row.verdict());
    return 0; // misses are printed; a busy machine does not fail the build
}
