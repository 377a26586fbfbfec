// Tetrahedra and hexahedra of a file of gmsh, ASCII 2.2 and 4.1. The sections are those of gmsh's reference manual, chapter 9.
#include "geometry/grid3d.hpp"
#include "geometry/words.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace kaya {
namespace {

constexpr long long tetrahedron = 4, hexahedron = 5; // types of elements
constexpr int solid = 3;                             // dimensions of a volume

/// Types that fill space and are not read.
constexpr std::array other_solids{
    std::pair{6LL, "prism"}, std::pair{7LL, "pyramid"}, std::pair{11LL, "second-order tetrahedron"},
    std::pair{12LL, "second-order hexahedron"}, std::pair{17LL, "second-order hexahedron"}};

double six_volumes(const Grid3d& grid, const std::array<int, 4>& t) {
    const Vec3& a = grid.gridpoints.at(t[0]);
    return (grid.gridpoints.at(t[1]) - a).cross(grid.gridpoints.at(t[2]) - a).dot(grid.gridpoints.at(t[3]) - a);
}

/// A volume of the geometry, or the part of it that belongs to one physical group.
struct Volume {
    long long entity = 0, physical = 0;
    auto operator<=>(const Volume&) const = default;
};

class Reader {
public:
    Reader(std::string_view text, const std::string& file) : words_(text, file, "", "") {}

    Grid3d read() {
        words_.expect("$MeshFormat");
        format();
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (!word.starts_with('$'))
                words_.fail(fmt::format("expected a section, found '{}'", word.substr(0, 30)),
                            "sections begin with $ and their name");
            const auto known = std::ranges::find(sections_, word.substr(1), &Section::name);
            if (known == sections_.end()) {
                skip(word);
                continue;
            }
            (this->*(is_new_ ? known->read_new : known->read_old))();
            words_.expect(fmt::format("$End{}", known->name));
        }
        if (of_volume_.empty())
            words_.fail("there is no tetrahedron and no hexahedron in it",
                        "mesh volumes (gmsh -3), and save them: with physical groups gmsh saves those only");
        make_blocks();
        return std::move(grid_);
    }

private:
    struct Section {
        std::string_view name;
        void (Reader::*read_old)(); ///< 2.2
        void (Reader::*read_new)(); ///< 4.1
    };

    void format() {
        const std::string_view version = words_.next();
        if (version != "2.2" && version != "4.1")
            words_.fail(fmt::format("the version is '{}'; 2.2 and 4.1 are read", version.substr(0, 30)),
                        "save it as one of these: gmsh -format msh41");
        is_new_ = version == "4.1";
        if (words_.integer("the type of the file") != 0)
            words_.fail("the file is binary, and is read as text only",
                        "save it as ASCII: gmsh without -bin, Mesh.Binary = 0");
        words_.integer("the size of numbers");
        words_.expect("$EndMeshFormat");
    }

    void skip(std::string_view name) {
        const std::string end = fmt::format("$End{}", name.substr(1));
        for (words_.skip_line();; words_.skip_line()) {
            const std::string_view word = words_.peek();
            if (word.empty()) words_.fail(fmt::format("the file ends before {}", end));
            if (word == end) break;
            words_.skip_to_word();
        }
        words_.next();
    }

    long long count(std::string_view what) {
        const long long number = words_.integer(what);
        if (number < 0) words_.fail(fmt::format("{} is {}", what, number));
        return number;
    }

    int tag(std::string_view what) {
        const long long number = words_.integer(what);
        if (number < 1 || number > std::numeric_limits<int>::max())
            words_.fail(
                fmt::format("{} is {}, and must be from 1 to {}", what, number, std::numeric_limits<int>::max()));
        return static_cast<int>(number);
    }

    void physical_names() {
        for (long long left = count("the number of physical names"); left > 0; --left) {
            const long long dimension = words_.integer("a dimension");
            const int number = tag("the number of a physical group");
            const std::string_view name = words_.next_in_line();
            if (name.empty()) words_.fail("the name of a physical group is missing");
            if (dimension == solid) names_[number] = name;
        }
    }

    void entities() {
        std::array<long long, 4> counts{};
        for (auto& number : counts) number = count("the number of entities");
        for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
            for (long long left = counts[dimension]; left > 0; --left) {
                const long long entity = words_.integer("the number of an entity");
                const int coordinates = dimension == 0 ? 3 : 6;
                for (int k = 0; k < coordinates; ++k) words_.number("a coordinate");
                long long first = 0;
                for (long long groups = count("the number of physical groups"), k = 0; k < groups; ++k) {
                    const long long group = std::llabs(words_.integer("the number of a physical group"));
                    if (k == 0) first = group;
                }
                if (dimension == solid) physical_of_[entity] = first;
                if (dimension == 0) continue;
                for (long long bounds = count("the number of boundaries"); bounds > 0; --bounds)
                    words_.integer("a boundary");
            }
    }

    void add_node(int number, const Vec3& place) {
        if (!grid_.gridpoints.emplace(number, place).second)
            words_.fail(fmt::format("node {} is defined twice", number));
    }

    void old_nodes() {
        for (long long left = count("the number of nodes"); left > 0; --left) {
            const int number = tag("the number of a node");
            add_node(number, words_.point("a coordinate"));
        }
    }

    void new_nodes() {
        const long long blocks = count("the number of entities with nodes");
        for (int k = 0; k < 3; ++k) words_.integer("a number of nodes");
        for (long long block = 0; block < blocks; ++block) {
            const long long dimension = words_.integer("a dimension");
            words_.integer("the number of an entity");
            const bool parametric = words_.integer("parametric or not") != 0;
            const long long here = count("the number of nodes");
            std::vector<int> numbers;
            for (long long k = 0; k < here; ++k) numbers.push_back(tag("the number of a node"));
            for (const int number : numbers) {
                add_node(number, words_.point("a coordinate"));
                for (long long k = 0; parametric && k < dimension; ++k) words_.number("a parameter");
            }
        }
    }

    void old_elements() {
        for (long long left = count("the number of elements"); left > 0; --left) {
            const long long number = words_.integer("the number of an element"),
                            type = words_.integer_in_line("the type of an element");
            const long long tags = words_.integer_in_line("the number of tags");
            Volume volume;
            for (long long k = 0; k < tags; ++k) {
                const long long value = words_.integer_in_line("a tag");
                if (k == 0) volume.physical = std::llabs(value);
                if (k == 1) volume.entity = value;
            }
            element(number, type, volume);
        }
    }

    void new_elements() {
        const long long blocks = count("the number of entities with elements");
        for (int k = 0; k < 3; ++k) words_.integer("a number of elements");
        for (long long block = 0; block < blocks; ++block) {
            const long long dimension = words_.integer("a dimension"),
                            entity = words_.integer("the number of an entity");
            const long long type = words_.integer("the type of elements");
            const auto group = physical_of_.find(entity);
            const Volume volume{entity, dimension == solid && group != physical_of_.end() ? group->second : 0};
            for (long long left = count("the number of elements"); left > 0; --left)
                element(words_.integer("the number of an element"), type, volume);
        }
    }

    /// The nodes to the end of the line.
    template <std::size_t N> std::array<int, N> nodes(long long number) {
        std::array<int, N> result{};
        for (int& node : result) {
            const long long found = words_.integer_in_line("the number of a node");
            if (found < 1 || found > std::numeric_limits<int>::max() ||
                !grid_.gridpoints.contains(static_cast<int>(found)))
                words_.fail(fmt::format("element {} has node {}, which is not there", number, found));
            node = static_cast<int>(found);
        }
        if (const std::string_view rest = words_.next_in_line(); !rest.empty())
            words_.fail(fmt::format("'{}' follows the nodes of element {}", rest.substr(0, 30), number));
        return result;
    }

    void element(long long number, long long type, const Volume& volume) {
        if (type == tetrahedron) add(number, "tetrahedron", volume, {nodes<4>(number)});
        else if (type == hexahedron) add(number, "hexahedron", volume, cut(nodes<8>(number)));
        else if (const auto other = std::ranges::find(other_solids, type, &std::pair<long long, const char*>::first);
                 other != other_solids.end())
            words_.fail(fmt::format("element {} is a {}", number, other->second),
                        "tetrahedra and hexahedra of first order are read: Mesh.ElementOrder = 1");
        else words_.skip_line(); // points, lines and surfaces
    }

    /// Six tetrahedra around the corner with the lowest number. All faces are cut through their lowest corner, and so from both
    /// sides in the same way (Dompierre et al. 1999, How to subdivide pyramids, prisms and hexahedra into tetrahedra).
    static std::vector<std::array<int, 4>> cut(const std::array<int, 8>& corner) {
        static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
            {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
        const int lowest = *std::ranges::min_element(corner);
        std::vector<std::array<int, 4>> parts;
        for (const auto& face : faces) {
            std::array<int, 4> loop{corner[face[0]], corner[face[1]], corner[face[2]], corner[face[3]]};
            if (std::ranges::find(loop, lowest) != loop.end()) continue;
            std::ranges::rotate(loop, std::ranges::min_element(loop));
            // Faces run outward, seen from outside against the clock.
            parts.push_back({lowest, loop[0], loop[1], loop[2]});
            parts.push_back({lowest, loop[0], loop[2], loop[3]});
        }
        return parts;
    }

    void add(long long number, std::string_view what, const Volume& volume,
             const std::vector<std::array<int, 4>>& parts) {
        constexpr double flat = 1e-12; // of the cube of its size
        int right = 0, wrong = 0;
        for (const auto& part : parts) {
            double size = 0;
            for (const int node : part)
                size = std::max(size, (grid_.gridpoints.at(node) - grid_.gridpoints.at(part[0])).norm());
            const double volumes = six_volumes(grid_, part);
            if (!(std::abs(volumes) > flat * size * size * size))
                words_.fail(fmt::format("{} {} has no volume", what, number));
            (volumes > 0 ? right : wrong) += 1;
        }
        if (right > 0 && wrong > 0)
            words_.fail(fmt::format("{} {} is turned inside out in part", what, number),
                        "its nodes stand in a wrong order, or it is warped too much");
        for (const auto& part : parts) {
            const int zone = static_cast<int>(grid_.zones.size()) + 1;
            grid_.zones.emplace(zone, part);
            of_volume_[volume].push_back(zone);
        }
    }

    /// Zones of a volume that hang together by faces become a block.
    void make_blocks() {
        for (const auto& [volume, zones] : of_volume_) {
            std::vector<std::size_t> leader(zones.size());
            std::iota(leader.begin(), leader.end(), std::size_t{0});
            const auto first_of = [&](std::size_t z) {
                while (leader[z] != z) z = leader[z] = leader[leader[z]];
                return z;
            };
            std::map<std::array<int, 3>, std::size_t> owner;
            for (std::size_t z = 0; z < zones.size(); ++z) {
                const auto& corner = grid_.zones.at(zones[z]);
                for (std::size_t left_out = 0; left_out < 4; ++left_out) {
                    std::array<int, 3> face{};
                    for (std::size_t k = 0, i = 0; k < 4; ++k)
                        if (k != left_out) face[i++] = corner[k];
                    std::ranges::sort(face);
                    const auto [other, is_new] = owner.emplace(face, z);
                    if (is_new) continue;
                    const std::size_t a = first_of(other->second), b = first_of(z);
                    leader[std::max(a, b)] = std::min(a, b);
                }
            }
            std::map<std::size_t, std::size_t> block_of;
            for (std::size_t z = 0; z < zones.size(); ++z) {
                const auto [found, is_new] = block_of.try_emplace(first_of(z), grid_.blocks.size());
                if (is_new) grid_.blocks.push_back(block_in(volume));
                grid_.blocks[found->second].zones.push_back(zones[z]);
            }
        }
    }

    Grid3d::Block block_in(const Volume& volume) const {
        Grid3d::Block block;
        block.number = static_cast<int>(grid_.blocks.size()) + 1;
        if (volume.physical == 0 || volume.physical > std::numeric_limits<int>::max()) return block;
        block.region = block.material = static_cast<int>(volume.physical);
        const auto name = names_.find(block.region);
        block.group = name != names_.end() ? name->second : fmt::format("physical-{}", block.region);
        return block;
    }

    static constexpr std::array<Section, 4> sections_{
        {{"PhysicalNames", &Reader::physical_names, &Reader::physical_names},
         {"Entities", &Reader::entities, &Reader::entities},
         {"Nodes", &Reader::old_nodes, &Reader::new_nodes},
         {"Elements", &Reader::old_elements, &Reader::new_elements}}};
    Words words_;
    Grid3d grid_;
    bool is_new_ = false;
    std::map<int, std::string> names_;           ///< of physical groups of volumes
    std::map<long long, long long> physical_of_; ///< volume of the geometry: its first physical group
    std::map<Volume, std::vector<int>> of_volume_;
};

} // namespace

Grid3d read_msh(std::string_view text, const std::string& file) { return Reader(text, file).read(); }

} // namespace kaya
