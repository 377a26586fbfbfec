// Tetrahedra, pyramids, wedges and hexahedra of a file of gmsh, ASCII 2.2 and 4.1. The sections are those of gmsh's reference manual, chapter 9.
#include "geometry/grid/cell_zones.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace kaya {
namespace {

constexpr int solid = 3; // dimensions of a volume

/// A type of elements that fills space: its corners come first, those inside its edges, faces and volume after them.
struct ElementType {
    long long type;
    CellKind kind;
    std::size_t nodes;
};
constexpr std::array element_types{
    ElementType{4, CellKind::tetrahedron, 4},  ElementType{11, CellKind::tetrahedron, 10},
    ElementType{5, CellKind::hexahedron, 8},   ElementType{17, CellKind::hexahedron, 20},
    ElementType{12, CellKind::hexahedron, 27}, ElementType{6, CellKind::wedge, 6},
    ElementType{18, CellKind::wedge, 15},      ElementType{13, CellKind::wedge, 18},
    ElementType{7, CellKind::pyramid, 5},      ElementType{19, CellKind::pyramid, 13},
    ElementType{14, CellKind::pyramid, 14},
};

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
            words_.fail("there is no element in it that fills space",
                        "mesh volumes (gmsh -3), and save them: with physical groups gmsh saves those only");
        for (auto& [volume, set] : of_volume_) {
            name(volume, set);
            make_blocks(grid_, set);
        }
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

    int tag(std::string_view what) {
        const long long number = words_.integer(what);
        if (number < 1 || number > std::numeric_limits<int>::max())
            words_.fail(
                fmt::format("{} is {}, and must be from 1 to {}", what, number, std::numeric_limits<int>::max()));
        return static_cast<int>(number);
    }

    void physical_names() {
        for (long long left = words_.count("the number of physical names"); left > 0; --left) {
            const long long dimension = words_.integer("a dimension");
            const int number = tag("the number of a physical group");
            const std::string_view name = words_.next_in_line();
            if (name.empty()) words_.fail("the name of a physical group is missing");
            if (dimension == solid) names_[number] = name;
        }
    }

    void entities() {
        std::array<long long, 4> counts{};
        for (auto& number : counts) number = words_.count("the number of entities");
        for (std::size_t dimension = 0; dimension < counts.size(); ++dimension)
            for (long long left = counts[dimension]; left > 0; --left) {
                const long long entity = words_.integer("the number of an entity");
                const int coordinates = dimension == 0 ? 3 : 6;
                for (int k = 0; k < coordinates; ++k) words_.number("a coordinate");
                long long first = 0;
                for (long long groups = words_.count("the number of physical groups"), k = 0; k < groups; ++k) {
                    const long long group = std::llabs(words_.integer("the number of a physical group"));
                    if (k == 0) first = group;
                }
                if (dimension == solid) physical_of_[entity] = first;
                if (dimension == 0) continue;
                for (long long bounds = words_.count("the number of boundaries"); bounds > 0; --bounds)
                    words_.integer("a boundary");
            }
    }

    void add_node(int number, const Vec3& place) {
        if (!grid_.gridpoints.emplace(number, place).second)
            words_.fail(fmt::format("node {} is defined twice", number));
    }

    void old_nodes() {
        for (long long left = words_.count("the number of nodes"); left > 0; --left) {
            const int number = tag("the number of a node");
            add_node(number, words_.point("a coordinate"));
        }
    }

    void new_nodes() {
        const long long blocks = words_.count("the number of entities with nodes");
        for (int k = 0; k < 3; ++k) words_.integer("a number of nodes");
        for (long long block = 0; block < blocks; ++block) {
            const long long dimension = words_.integer("a dimension");
            words_.integer("the number of an entity");
            const bool parametric = words_.integer("parametric or not") != 0;
            const long long here = words_.count("the number of nodes");
            std::vector<int> numbers;
            for (long long k = 0; k < here; ++k) numbers.push_back(tag("the number of a node"));
            for (const int number : numbers) {
                add_node(number, words_.point("a coordinate"));
                for (long long k = 0; parametric && k < dimension; ++k) words_.number("a parameter");
            }
        }
    }

    void old_elements() {
        for (long long left = words_.count("the number of elements"); left > 0; --left) {
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
        const long long blocks = words_.count("the number of entities with elements");
        for (int k = 0; k < 3; ++k) words_.integer("a number of elements");
        for (long long block = 0; block < blocks; ++block) {
            const long long dimension = words_.integer("a dimension"),
                            entity = words_.integer("the number of an entity");
            const long long type = words_.integer("the type of elements");
            const auto group = physical_of_.find(entity);
            const Volume volume{entity, dimension == solid && group != physical_of_.end() ? group->second : 0};
            for (long long left = words_.count("the number of elements"); left > 0; --left)
                element(words_.integer("the number of an element"), type, volume);
        }
    }

    /// The nodes to the end of the line.
    std::vector<int> nodes(long long number, std::size_t count) {
        std::vector<int> result;
        while (result.size() < count) {
            const long long found = words_.integer_in_line("the number of a node");
            if (found < 1 || found > std::numeric_limits<int>::max() ||
                !grid_.gridpoints.contains(static_cast<int>(found)))
                words_.fail(fmt::format("element {} has node {}, which is not there", number, found));
            result.push_back(static_cast<int>(found));
        }
        if (const std::string_view rest = words_.next_in_line(); !rest.empty())
            words_.fail(fmt::format("'{}' follows the nodes of element {}", rest.substr(0, 30), number));
        return result;
    }

    void element(long long number, long long type, const Volume& volume) {
        const auto known = std::ranges::find(element_types, type, &ElementType::type);
        if (known == element_types.end()) return words_.skip_line(); // points, lines and surfaces
        std::vector<int> corners = nodes(number, known->nodes);
        corners.resize(corners_of(known->kind)); // edges are straight
        add_cell(grid_, of_volume_[volume], fail_, known->kind, number, corners);
    }

    void name(const Volume& volume, ZoneSet& set) const {
        if (volume.physical == 0 || volume.physical > std::numeric_limits<int>::max()) return;
        set.region = set.material = static_cast<int>(volume.physical);
        const auto known = names_.find(set.region);
        set.group = known != names_.end() ? known->second : fmt::format("physical-{}", set.region);
    }

    static constexpr std::array<Section, 4> sections_{
        {{"PhysicalNames", &Reader::physical_names, &Reader::physical_names},
         {"Entities", &Reader::entities, &Reader::entities},
         {"Nodes", &Reader::old_nodes, &Reader::new_nodes},
         {"Elements", &Reader::old_elements, &Reader::new_elements}}};
    Words words_;
    FailHere fail_ = [this](const std::string& message, const std::string& hint) { words_.fail(message, hint); };
    Grid3d grid_;
    bool is_new_ = false;
    std::map<int, std::string> names_;           ///< of physical groups of volumes
    std::map<long long, long long> physical_of_; ///< volume of the geometry: its first physical group
    std::map<Volume, ZoneSet> of_volume_;
};

} // namespace

Grid3d read_msh(std::string_view text, const std::string& file) { return Reader(text, file).read(); }

} // namespace kaya
