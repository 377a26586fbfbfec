#include "commands/list/eigen_modes.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/kept_part.hpp"
#include "mechanics/step/step_matrix.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/joint_water.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Dense = Eigen::MatrixXd;
/// Motion of a body in the coordinates of its frame to that of a place in it.
using ToPlace = Eigen::Matrix<double, 3, 6>;

constexpr int components = 6;

/// Bodies that can move. Coordinates are those in which masses are 1; held components have none.
struct FreeBodies {
    struct Body {
        BodyFrame frame;
        std::array<int, components> unknown{}; ///< its number, or -1
    };
    std::vector<Body> bodies;
    std::vector<int> of_block; ///< the body of each block, or -1
    int unknowns = 0;

    explicit FreeBodies(const Model& model) : of_block(model.blocks.size(), -1) {
        const auto& blocks = model.blocks;
        const JoinedBodies joined = joined_bodies(model);
        for (std::size_t i = 0; i < joined.size(); ++i) {
            const auto members = joined.members(i);
            const BodyMass body = body_mass(model, members);
            std::uint8_t fixed = 0;
            for (const Row b : members) fixed |= blocks.fixed[b];
            add(make_frame(body.centroid, body.mass, body.inertia, fixed));
            for (const Row b : members) of_block[b] = last_body();
        }
        for (Row b = 0; b < static_cast<Row>(blocks.size()); ++b) {
            if (blocks.body[b] != 0) continue;
            const Mat3 turn = turn_of(blocks, b);
            const double density = blocks.mass[b] / blocks.volume[b];
            add(make_frame(blocks.centroid[b], blocks.mass[b], density * (turn * blocks.inertia[b] * turn.transpose()),
                           blocks.fixed[b]));
            of_block[b] = last_body();
        }
    }

private:
    bool added_ = false;

    int last_body() const { return added_ ? static_cast<int>(bodies.size()) - 1 : -1; }

    void add(const BodyFrame& frame) {
        Body body{frame, {}};
        const int before = unknowns;
        for (int k = 0; k < components; ++k) {
            const bool held = !frame.moves() || (frame.fixed & (1 << k)) != 0;
            body.unknown[static_cast<std::size_t>(k)] = held ? -1 : unknowns++;
        }
        added_ = unknowns > before;
        if (added_) bodies.push_back(body);
    }
};

ToPlace motion_of(const BodyFrame& frame, const Vec3& place) {
    const Vec3 r = place - frame.centre;
    Mat3 turn; // theta x r
    turn << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
    ToPlace motion;
    motion.leftCols<3>() = frame.root_of_mass * Mat3::Identity();
    motion.rightCols<3>() = turn * frame.root_of_inertia.transpose();
    return motion;
}

/// The closed part of a joint that is open in part: where its opening, linear over the joint, is below 0.
std::vector<std::vector<Vec3>> closed_polygons(const Model& model, Row contact) {
    const Vec3 n = model.contacts.normal[contact], origin = model.contacts.position[contact];
    Mat3 second = Mat3::Zero();
    Vec3 moment = Vec3::Zero();
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    const auto of = [&](const Vec3& place) { return Vec3(1, u.dot(place - origin), v.dot(place - origin)); };
    const Span span = model.contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s) {
        if (!has_left_place(model, s)) continue;
        const Vec3 at = of(place_on_faces(model, s));
        second += at * at.transpose();
        moment += opening_on_faces(model, s) * at;
    }
    const Eigen::FullPivLU<Mat3> plane(second);
    auto polygons = joint_polygons(model, contact);
    if (!plane.isInvertible()) return polygons;
    const Vec3 opening = plane.solve(moment);
    for (auto& polygon : polygons)
        polygon = kept_part(polygon, [&](const Vec3& corner) { return opening.dot(of(corner)); });
    return polygons;
}

/// Calls add(normal stiffness, shear stiffness, place) with the springs of a contact as it is. A joint that is open in part has those of its closed
/// part; edges and corners have the area of their contact.
template <class Add> void each_spring(const Model& model, Row contact, const Add& add) {
    const auto& contacts = model.contacts;
    const auto& subs = model.sub_contacts;
    const Span span = contacts.sub_contacts[contact];
    if (!follows_overlap(model, contact)) {
        for (Row s = span.first; s < span.end(); ++s)
            add(subs.normal_stiffness[s] * subs.area[s], subs.shear_stiffness[s] * subs.area[s],
                Vec3(subs.position[s]));
        return;
    }
    if (!(contacts.depth[contact] > 0)) return;
    double area = 0;
    for (const auto& polygon : closed_polygons(model, contact))
        each_third(polygon, [&](double part, const Vec3& place) {
            area += part;
            add(subs.normal_stiffness[span.first] * part, 0.0, place);
        });
    for (Row s = span.first; s < span.first + carriers; ++s) {
        const double normal = area > 0 ? 0 : subs.normal_stiffness[s] * subs.area[s];
        add(normal, 0.0, Vec3(subs.position[s]));
        add(0.0, subs.shear_stiffness[s] * subs.area[s], subs.shear_place(s));
    }
}

Sparse stiffness_of(const Model& model, const FreeBodies& free) {
    std::vector<Eigen::Triplet<double>> parts;
    const auto add = [&](const FreeBodies::Body& one, const FreeBodies::Body& other, const Mat6& k) {
        for (int i = 0; i < components; ++i)
            for (int j = 0; j < components; ++j) {
                const int row = one.unknown[static_cast<std::size_t>(i)],
                          column = other.unknown[static_cast<std::size_t>(j)];
                if (row >= 0 && column >= 0) parts.emplace_back(row, column, k(i, j));
            }
    };
    const auto& contacts = model.contacts;
    for (Row c = 0; c < static_cast<Row>(contacts.size()); ++c) {
        const std::array<int, 2> sides{free.of_block[contacts.block1[c]], free.of_block[contacts.block2[c]]};
        if (sides[0] == sides[1]) continue; // within a body, or between bodies that are held
        const Vec3& n = contacts.normal[c];
        const Mat3 across = n * n.transpose(), along = Mat3::Identity() - across;
        std::array<std::array<Mat6, 2>, 2> sums;
        for (auto& row : sums) row.fill(Mat6::Zero());
        each_spring(model, c, [&](double normal, double shear, const Vec3& place) {
            if (!(std::max(normal, shear) > 0)) return;
            std::array<ToPlace, 2> motion;
            for (std::size_t i = 0; i < 2; ++i)
                motion[i] = sides[i] < 0 ? ToPlace(ToPlace::Zero())
                                         : motion_of(free.bodies[static_cast<std::size_t>(sides[i])].frame, place);
            const Mat3 k = normal * across + shear * along;
            for (std::size_t i = 0; i < 2; ++i)
                for (std::size_t j = 0; j < 2; ++j)
                    sums[i][j] += (i == j ? 1 : -1) * motion[i].transpose() * k * motion[j];
        });
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j)
                if (sides[i] >= 0 && sides[j] >= 0)
                    add(free.bodies[static_cast<std::size_t>(sides[i])],
                        free.bodies[static_cast<std::size_t>(sides[j])], sums[i][j]);
    }
    Sparse matrix(free.unknowns, free.unknowns);
    matrix.setFromTriplets(parts.begin(), parts.end());
    return matrix;
}

/// The smallest eigenvalues, ascending, with unit vectors as columns.
struct Lowest {
    Eigen::VectorXd values;
    Dense vectors;
};

/// Subspace iteration with the inverse of K + shift (Bathe 1971): each round multiplies the part of a higher mode by the ratio of the
/// eigenvalues.
Lowest lowest_of(const Sparse& stiffness, int count, const ProgressCallback& progress) {
    const auto n = static_cast<int>(stiffness.rows());
    const int width = std::min(n, std::max(2 * count, count + 8));
    // Free bodies have the eigenvalue 0: the shift makes the matrix regular.
    constexpr double part_of_mean = 1e-7, rounding = 1e-10, nothing = 1e-12;
    const double mean = stiffness.diagonal().sum() / n;
    const double shift = mean > 0 ? part_of_mean * mean : 1;
    Sparse shifted = stiffness;
    for (int i = 0; i < n; ++i) shifted.coeffRef(i, i) += shift;
    const Eigen::SimplicialLDLT<Sparse> inverse(shifted);
    Dense space(n, width);
    for (int j = 0; j < width; ++j) // neither even nor of one place, and the same in every run
        for (int i = 0; i < n; ++i) space(i, j) = i % width == j ? 1 : 1e-3 * std::sin(1.0 + i * (j + 1));
    Lowest lowest;
    constexpr int most_rounds = 500;
    for (int round = 0; round < most_rounds; ++round) {
        if (progress) progress(static_cast<double>(round) / most_rounds);
        const Dense next = inverse.solve(space);
        const Dense basis = Eigen::HouseholderQR<Dense>(next).householderQ() * Dense::Identity(n, width);
        const Eigen::SelfAdjointEigenSolver<Dense> small(basis.transpose() * (stiffness * basis));
        const Eigen::VectorXd before = lowest.values;
        lowest = {small.eigenvalues(), basis * small.eigenvectors()};
        space = lowest.vectors;
        const auto first = lowest.values.head(std::min(count, width));
        if (before.size() > 0 &&
            ((first - before.head(first.size())).array().abs() <= rounding * (first.array().abs() + shift)).all())
            break;
    }
    for (double& value : lowest.values)
        if (value < nothing * mean) value = 0;
    return lowest;
}

void refuse_what_has_no_modes(const Model& model) {
    const auto& blocks = model.blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (blocks.deformable[b])
            throw Diagnostic(fmt::format("modes are those of rigid blocks, and block {} has zones", blocks.number[b]),
                             "leave out `gen`, or record the motion after an impact: hist zvel");
    if (model.structures.any())
        throw Diagnostic("modes are those of rigid blocks, and the model has structures", "remove them first");
}

} // namespace

std::vector<EigenMode> eigen_modes(const Model& model, int count, const ProgressCallback& progress) {
    refuse_what_has_no_modes(model);
    const FreeBodies free(model);
    if (free.unknowns == 0) throw Diagnostic("no block can move", "free some blocks, or give them a density");
    const Lowest lowest = lowest_of(stiffness_of(model, free), count, progress);

    // Rigid motions along the axes in the coordinates of unit masses.
    Dense along = Dense::Zero(free.unknowns, 3);
    double mass = 0;
    for (const auto& body : free.bodies) {
        const double root = 1 / body.frame.root_of_mass;
        mass += root * root;
        for (int k = 0; k < 3; ++k)
            if (const int unknown = body.unknown[static_cast<std::size_t>(k)]; unknown >= 0) along(unknown, k) = root;
    }
    std::vector<EigenMode> modes;
    for (int m = 0; m < std::min(count, static_cast<int>(lowest.values.size())); ++m) {
        const Vec3 part = along.transpose() * lowest.vectors.col(m);
        modes.push_back({std::sqrt(lowest.values[m]) / (2 * std::numbers::pi), part.cwiseProduct(part) / mass});
    }
    return modes;
}

} // namespace kaya
