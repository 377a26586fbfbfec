#include "geometry/grid/joint_sets.hpp"

#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/surface/surface.hpp"

#include <algorithm>
#include <set>

namespace kaya {
namespace {

/// Faces at a greater distance, in parts of the size of the smaller block, are not against each other. Blocks with zones move and deform.
constexpr double apart = 1e-3;

double near_of(const Polyhedron& a, const Polyhedron& b) {
    return apart * std::min(size_of(a.vertices), size_of(b.vertices));
}

} // namespace

std::vector<Grid3d::JointSet> joint_sets_between(const std::vector<GridShape>& blocks) {
    std::vector<Box> boxes;
    for (const GridShape& block : blocks) {
        Box box = box_around(block.shape->vertices);
        const Vec3 margin = Vec3::Constant(apart * size_of(block.shape->vertices));
        boxes.push_back({box.low - margin, box.high + margin});
    }
    std::map<int, std::set<std::array<int, 2>>> pairs;
    for (const auto& [i, j] : overlapping_boxes(boxes)) {
        const GridShape &one = blocks[static_cast<std::size_t>(std::min(i, j))],
                        &other = blocks[static_cast<std::size_t>(std::max(i, j))];
        for (const auto& [f, g] : faces_against(*one.shape, *other.shape, near_of(*one.shape, *other.shape))) {
            const int own = one.shape->faces[f].joint_set, its = other.shape->faces[g].joint_set;
            if (own == its || own == 0 || its == 0) {
                if (const int set = std::max(own, its); set != 0) pairs[set].insert({one.number, other.number});
            }
        }
    }
    std::vector<Grid3d::JointSet> sets;
    for (const auto& [number, list] : pairs) sets.push_back({number, {list.begin(), list.end()}});
    return sets;
}

void give_joint_sets(const Grid3d& grid, const std::function<std::vector<Polyhedron>*(int)>& parts_of) {
    for (const Grid3d::JointSet& set : grid.joint_sets)
        for (const auto& [a, b] : set.blocks) {
            std::vector<Polyhedron>*one = parts_of(a), *other = parts_of(b);
            if (one == nullptr || other == nullptr) continue;
            for (Polyhedron& part : *one)
                for (Polyhedron& against : *other)
                    for (const auto& [f, g] : faces_against(part, against, near_of(part, against)))
                        part.faces[f].joint_set = against.faces[g].joint_set = set.number;
        }
}

} // namespace kaya
