// The lines of a .3dgrid file.
#include "base/diagnostic.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <set>

namespace kaya {
namespace {

/// A number of a gridpoint, face, zone, block or set: whole and above 0.
int identity(Words& words, std::string_view what) {
    const long long number = words.integer_in_line(what);
    if (number < 1 || number > std::numeric_limits<int>::max())
        words.fail(fmt::format("{} is {}, and must be above 0", what, number));
    return static_cast<int>(number);
}

/// The numbers up to the end of the line; each must be known.
template <class Known> std::vector<int> known_numbers(Words& words, std::string_view what, const Known& known) {
    std::vector<int> numbers;
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line()) {
        Words one(word, "", "", "");
        int number = 0;
        try {
            number = identity(one, what);
        } catch (const Diagnostic&) {
            words.fail(fmt::format("'{}' is not the number of a {}", word.substr(0, 30), what));
        }
        if (!known.contains(number)) words.fail(fmt::format("{} {} has not been defined above", what, number));
        numbers.push_back(number);
    }
    return numbers;
}

void refuse_repetition(const Words& words, bool fresh, std::string_view what, int number) {
    if (!fresh) words.fail(fmt::format("{} {} is defined twice", what, number));
}

/// Reads one file; one function for each kind of line.
struct Reader {
    Words words;
    Grid3d grid;
    std::set<int> block_numbers;

    void tolerance() { grid.tolerance = words.number_in_line("the tolerance"); }

    void gridpoint() {
        const int number = identity(words, "gridpoint");
        Vec3 p;
        for (int k = 0; k < 3; ++k) p[k] = words.number_in_line("a coordinate");
        refuse_repetition(words, grid.gridpoints.emplace(number, p).second, "gridpoint", number);
    }

    void face() {
        const int number = identity(words, "face");
        const std::vector<int> loop = known_numbers(words, "gridpoint", grid.gridpoints);
        if (loop.size() < 3) words.fail(fmt::format("face {} has {} gridpoints", number, loop.size()), "at least 3");
        refuse_repetition(words, grid.faces.emplace(number, loop).second, "face", number);
    }

    void zone() {
        const int number = identity(words, "zone");
        const std::vector<int> points = known_numbers(words, "gridpoint", grid.gridpoints);
        if (points.size() != 4)
            words.fail(fmt::format("zone {} has {} gridpoints", number, points.size()),
                       "zones are tetrahedra of 4 gridpoints");
        const std::array<int, 4> t{points[0], points[1], points[2], points[3]};
        refuse_repetition(words, grid.zones.emplace(number, t).second, "zone", number);
    }

    void block() {
        Grid3d::Block result;
        result.number = identity(words, "block");
        refuse_repetition(words, block_numbers.insert(result.number).second, "block", result.number);
        const long long region = words.integer_in_line("the region");
        if (region < 0 || region > std::numeric_limits<int>::max())
            words.fail(fmt::format("the region is {}, and must not be below 0", region));
        result.region = static_cast<int>(region);
        const std::string_view kind = words.next_in_line();
        if (same_word(kind, "F")) result.faces = known_numbers(words, "face", grid.faces);
        else if (same_word(kind, "Z")) result.zones = known_numbers(words, "zone", grid.zones);
        else words.fail("after the region of a block stands F with face numbers or Z with zone numbers");
        if (result.faces.empty() && result.zones.empty())
            words.fail(fmt::format("block {} has neither faces nor zones", result.number));
        grid.blocks.push_back(std::move(result));
    }

    void joint_set() {
        Grid3d::JointSet set;
        set.number = identity(words, "joint set");
        for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line()) {
            const std::size_t hyphen = word.find('-');
            if (hyphen == std::string_view::npos)
                words.fail(fmt::format("'{}' is not a pair of blocks like 3-7", word.substr(0, 30)));
            Words first(word.substr(0, hyphen), "", "", ""), second(word.substr(hyphen + 1), "", "", "");
            std::array<int, 2> pair{};
            try {
                pair = {identity(first, "block"), identity(second, "block")};
            } catch (const Diagnostic&) {
                words.fail(fmt::format("'{}' is not a pair of blocks like 3-7", word.substr(0, 30)));
            }
            for (const int number : pair)
                if (!block_numbers.contains(number))
                    words.fail(fmt::format("block {} has not been defined above", number));
            set.blocks.push_back(pair);
        }
        grid.joint_sets.push_back(std::move(set));
    }

    /// BGROUP name, then block numbers in this line and in the lines below that begin with one.
    void group() {
        const std::string name(words.next_in_line());
        if (name.empty()) words.fail("the name of the group is missing");
        std::set<int> members;
        const auto take_line = [&] {
            for (const int number : known_numbers(words, "block", block_numbers)) members.insert(number);
        };
        if (const std::string_view next = words.peek(); same_word(next, "slot")) {
            words.next_in_line();
            words.next_in_line(); // blocks have one group in kaya, whatever the slot
        }
        take_line();
        for (std::string_view next = words.peek(); !next.empty() && next[0] >= '0' && next[0] <= '9';
             next = words.peek()) {
            words.skip_to_word();
            take_line();
        }
        for (auto& one : grid.blocks)
            if (members.contains(one.number)) one.group = name;
    }
};

struct LineKind {
    std::string_view word;
    void (Reader::*read)();
};
constexpr std::array line_kinds{
    LineKind{"TOL", &Reader::tolerance}, LineKind{"G", &Reader::gridpoint}, LineKind{"F", &Reader::face},
    LineKind{"Z", &Reader::zone},        LineKind{"B", &Reader::block},     LineKind{"JS", &Reader::joint_set},
    LineKind{"BGROUP", &Reader::group},
};

} // namespace

Grid3d read_grid3d(std::string_view text, const std::string& file) {
    Reader reader{Words(text, file, ",", "*"), {}, {}};
    Words& words = reader.words;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto kind = std::find_if(line_kinds.begin(), line_kinds.end(),
                                       [&](const LineKind& k) { return same_word(k.word, word); });
        if (kind == line_kinds.end())
            words.fail(fmt::format("a line cannot begin with '{}'", word.substr(0, 30)),
                       "lines begin with TOL, G, F, Z, B, JS or BGROUP");
        (reader.*kind->read)();
        words.end_line();
    }
    if (reader.grid.blocks.empty()) throw Diagnostic(fmt::format("{} holds no blocks", file));
    return std::move(reader.grid);
}

std::string quoted_name(std::string name) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return c < ' '; }, ' ');
    if (name.find('"') == name.npos) return '"' + name + '"';
    std::ranges::replace(name, '\'', '"');
    return '\'' + name + '\'';
}

std::string write_grid3d(const Grid3d& grid) {
    std::string text = "* written by kaya\n";
    if (grid.tolerance > 0) text += fmt::format("TOL {}\n", grid.tolerance);
    for (const auto& [number, p] : grid.gridpoints) text += fmt::format("G {} {} {} {}\n", number, p.x(), p.y(), p.z());
    for (const auto& [number, loop] : grid.faces) text += fmt::format("F {} {}\n", number, fmt::join(loop, " "));
    for (const auto& [number, t] : grid.zones) text += fmt::format("Z {} {}\n", number, fmt::join(t, " "));
    std::map<std::string, std::vector<int>> groups;
    for (const auto& block : grid.blocks) {
        const bool rigid = block.zones.empty();
        text += fmt::format("B {} {} {} {}\n", block.number, block.region, rigid ? 'F' : 'Z',
                            fmt::join(rigid ? block.faces : block.zones, " "));
        if (!block.group.empty()) groups[block.group].push_back(block.number);
    }
    for (const auto& set : grid.joint_sets) {
        text += fmt::format("JS {}", set.number);
        for (const auto& [a, b] : set.blocks) text += fmt::format(" {}-{}", a, b);
        text += '\n';
    }
    for (const auto& [name, members] : groups)
        text += fmt::format("BGROUP {} {}\n", quoted_name(name), fmt::join(members, " "));
    return text;
}

} // namespace kaya
