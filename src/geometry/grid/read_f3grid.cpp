// Grids of FLAC3D and 3DEC as text (.f3grid): gridpoints, zones of several shapes, groups of zones.
#include "base/diagnostic.hpp"
#include "geometry/grid/cell_zones.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {
namespace {

/// A shape of zones: its corners in FLAC3D's order, which goes along the axes first, for those in the usual order.
struct ZoneShape {
    std::string_view word;
    CellKind kind;
    std::array<std::size_t, 8> order;
};
constexpr std::array zone_shapes{
    ZoneShape{"B8", CellKind::hexahedron, {0, 1, 4, 2, 3, 6, 7, 5}},
    ZoneShape{"W6", CellKind::wedge, {0, 1, 3, 2, 4, 5}},
    ZoneShape{"P5", CellKind::pyramid, {0, 1, 4, 2, 3}},
    ZoneShape{"T4", CellKind::tetrahedron, {0, 1, 2, 3}},
};

class F3gridReader {
public:
    F3gridReader(std::string_view text, const std::string& file) : words_(text, file, ",", "*;"), file_(file) {}

    Grid3d read() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (same_word(word, "G")) gridpoint();
            else if (same_word(word, "Z")) zone();
            else if (same_word(word, "ZGROUP")) group(true);
            else if (same_word(word, "FGROUP")) group(false);
            else if (same_word(word, "F")) words_.skip_line(); // faces of zones
            else
                words_.fail(fmt::format("a line cannot begin with '{}'", word.substr(0, 30)),
                            "lines begin with G, Z, F, ZGROUP or FGROUP; a binary grid must be exported as text");
        }
        if (zones_.empty()) throw Diagnostic(fmt::format("{} holds no zones", file_), "export the grid with its zones");
        return blocks();
    }

private:
    int identity(std::string_view what) { return words_.identity(words_.integer_in_line(what), what); }

    void gridpoint() {
        const int number = identity("the number of a gridpoint");
        Vec3 place;
        for (int k = 0; k < 3; ++k) place[k] = words_.number_in_line("a coordinate");
        words_.end_line();
        if (!grid_.gridpoints.emplace(number, place).second)
            words_.fail(fmt::format("gridpoint {} is defined twice", number));
    }

    void zone() {
        const std::string_view word = words_.next_in_line();
        const auto shape =
            std::ranges::find_if(zone_shapes, [&](const ZoneShape& s) { return same_word(s.word, word); });
        if (shape == zone_shapes.end())
            words_.fail(fmt::format("'{}' is not a shape of zones", word.substr(0, 30)),
                        "shapes are B8, W6, P5 and T4");
        const int number = identity("the number of a zone");
        std::vector<int> given;
        while (given.size() < corners_of(shape->kind)) {
            given.push_back(identity("the number of a gridpoint"));
            if (!grid_.gridpoints.contains(given.back()))
                words_.fail(
                    fmt::format("zone {} has gridpoint {}, which has not been defined above", number, given.back()));
        }
        words_.end_line();
        std::vector<int> corners;
        for (std::size_t k = 0; k < given.size(); ++k) corners.push_back(given[shape->order[k]]);
        ZoneSet one;
        add_cell(grid_, one, fail_, shape->kind, number, corners);
        if (!zones_.emplace(number, Zone{std::move(one.zones), 0}).second)
            words_.fail(fmt::format("zone {} is defined twice", number));
    }

    /// The name, perhaps a slot, then numbers in this line and in those below that begin with one.
    void group(bool of_zones) {
        std::string name(words_.next_in_line());
        if (name.empty()) words_.fail("the name of a group is missing");
        std::string_view word = words_.next_in_line();
        if (same_word(word, "slot")) {
            words_.next_in_line();
            word = words_.next_in_line();
        }
        const auto known = std::ranges::find(groups_, name);
        const std::size_t number = static_cast<std::size_t>(known - groups_.begin());
        if (known == groups_.end()) groups_.push_back(std::move(name));
        for (;; word = words_.next_in_line()) {
            if (!word.empty()) {
                if (of_zones) member(word, number);
                continue;
            }
            const std::string_view next = words_.peek();
            if (next.empty() || next[0] < '0' || next[0] > '9') break;
            words_.skip_to_word();
        }
    }

    /// A zone belongs to the first group that names it.
    void member(std::string_view word, std::size_t group) {
        Words one(word, "", "", "");
        long long number = 0;
        try {
            number = one.integer("the number of a zone");
        } catch (const Diagnostic&) {
            words_.fail(fmt::format("'{}' is not the number of a zone", word.substr(0, 30)));
        }
        const auto zone = zones_.find(number);
        if (zone == zones_.end()) words_.fail(fmt::format("zone {} has not been defined above", number));
        if (zone->second.group == 0) zone->second.group = group;
    }

    Grid3d blocks() {
        std::vector<ZoneSet> sets(groups_.size());
        for (std::size_t k = 0; k < sets.size(); ++k) sets[k].group = groups_[k];
        for (const auto& [number, zone] : zones_)
            sets[zone.group].zones.insert(sets[zone.group].zones.end(), zone.zones.begin(), zone.zones.end());
        for (const ZoneSet& set : sets) make_blocks(grid_, set);
        return std::move(grid_);
    }

    struct Zone {
        std::vector<int> zones; ///< tetrahedra
        std::size_t group = 0;
    };
    Words words_;
    FailHere fail_ = [this](const std::string& message, const std::string& hint) { words_.fail(message, hint); };
    std::string file_;
    Grid3d grid_;
    std::map<long long, Zone> zones_;
    std::vector<std::string> groups_{""}; ///< the first for zones without
};

} // namespace

Grid3d read_f3grid(std::string_view text, const std::string& file) { return F3gridReader(text, file).read(); }

} // namespace kaya
