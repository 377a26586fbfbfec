#include "mechanics/assign/parted_joints.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/common/masses.hpp"
#include "mechanics/contact/advance_joints.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "mechanics/supports/water.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/block_box.hpp"
#include "model/measure/held.hpp"
#include "model/measure/turn.hpp"
#include "model/structures/structures.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace kaya {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Reach = Eigen::Matrix<double, 3, 6>; ///< motion of a place by that of its part

/// Forces on blocks and their moments about the centroids.
class Loads {
public:
    Loads(const Model& model, const JointForces& forces)
        : model_(model), force_(model.blocks.size(), Vec3::Zero()), moment_(model.blocks.size(), Vec3::Zero()),
          pushed_(model.blocks.size(), 0) {
        const auto& contacts = model.contacts;
        for (std::size_t c = 0; c < contacts.size(); ++c) {
            push(contacts.block1[c], -forces.of_contact[c], contacts.position[c], -forces.moment[c]);
            push(contacts.block2[c], forces.of_contact[c], contacts.position[c], forces.moment[c]);
        }
        each_structure_force(model, [this](Row block, const Vec3& force, const Vec3& place, const Vec3& moment) {
            push(block, force, place, moment);
        });
    }

    Vec3 force(Row b, double mass) const { return force_[b] + model_.blocks.load[b] + mass * model_.settings.gravity; }
    Vec3 moment(Row b) const { return moment_[b] + load_moment(model_, b); }
    /// Whether other bodies or structures act on it.
    bool pushed(Row b) const { return pushed_[b] != 0; }

private:
    void push(Row b, const Vec3& force, const Vec3& place, const Vec3& moment) {
        force_[b] += force;
        moment_[b] += (place - model_.blocks.centroid[b]).cross(force) + moment;
        pushed_[b] = pushed_[b] || !force.isZero(0);
    }

    const Model& model_;
    std::vector<Vec3> force_, moment_;
    std::vector<char> pushed_;
};

Mat3 cross_of(const Vec3& v) {
    Mat3 m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
}

/// The parts of what was one body, and the joints between them. Lengths in parts of the body's size, from one of its places.
class PartedBody {
public:
    PartedBody(const Model& model, const Loads& loads, const std::vector<Row>& blocks) : model_(model) {
        origin_ = model.blocks.centroid[blocks.front()];
        size_ = 0;
        for (const Row b : blocks) {
            const Box box = block_box(model, b);
            size_ = std::max(size_, (box.high - box.low).maxCoeff());
        }
        std::map<std::int32_t, std::size_t> of_joined;
        for (const Row b : blocks) {
            std::size_t part = parts_.size();
            if (model.blocks.body[b] != 0) part = of_joined.try_emplace(model.blocks.body[b], part).first->second;
            if (part == parts_.size()) parts_.emplace_back();
            part_of_[b] = part;
            add_block(parts_[part], loads, b);
        }
        together_.resize(parts_.size());
        std::iota(together_.begin(), together_.end(), std::size_t{0});
    }

    bool usable() const { return known_ && pushed_ && parts_.size() > 1; }

    void add_joint(Row contact) {
        joints_.push_back(contact);
        const std::size_t a = first_of(part(model_.contacts.block1[contact])),
                          b = first_of(part(model_.contacts.block2[contact]));
        together_[std::max(a, b)] = std::min(a, b);
    }

    /// Calls put(sub-contact, force on the second block).
    template <class Put> void solve(const Put& put) {
        if (joints_.empty()) return;
        leave_common_motion();
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd load(6 * parts_.size());
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            load.segment<6>(static_cast<Eigen::Index>(6 * p)) = parts_[p].load;
            if (first_of(p) == p)
                add(entries, p, p, Mat6(Mat6::Identity() * model_.contacts.area[joints_.front()])); // it stays
        }
        each_place([&](Row, std::size_t one, std::size_t two, double area, const Reach& reach) {
            const Mat6 stiffness = area * reach.transpose() * reach;
            add(entries, one, one, stiffness);
            add(entries, two, two, stiffness);
            add(entries, one, two, -stiffness);
            add(entries, two, one, -stiffness);
        });
        const auto size = static_cast<Eigen::Index>(load.size());
        Eigen::SparseMatrix<double> matrix(size, size);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inverse(matrix);
        if (inverse.info() != Eigen::Success) return;
        const Eigen::VectorXd moved = inverse.solve(load);
        if (!moved.allFinite()) return;
        each_place([&](Row s, std::size_t one, std::size_t two, double area, const Reach& reach) {
            const auto at = [&](std::size_t p) { return moved.segment<6>(static_cast<Eigen::Index>(6 * p)); };
            put(s, Vec3(-area * (reach * (at(two) - at(one)))));
        });
    }

private:
    struct Part {
        Vec6 load = Vec6::Zero();
        Mat6 mass = Mat6::Zero();
    };

    std::size_t part(Row block) const { return part_of_.at(block); }
    std::size_t first_of(std::size_t p) const {
        while (together_[p] != p) p = together_[p];
        return p;
    }
    Reach reach_of(const Vec3& place) const {
        Reach reach;
        reach << Mat3::Identity(), -cross_of((place - origin_) / size_);
        return reach;
    }

    void add_block(Part& part, const Loads& loads, Row b) {
        const auto& blocks = model_.blocks;
        const double mass = density_of(model_, b) * blocks.volume[b];
        known_ = known_ && std::isfinite(mass) && !blocks.deformable[b] && !is_held(model_, b) && blocks.fixed[b] == 0;
        pushed_ = pushed_ || loads.pushed(b);
        const Reach reach = reach_of(blocks.centroid[b]);
        const Mat3 turn = turn_of(blocks, b);
        part.load += reach.transpose() * loads.force(b, mass);
        part.load.tail<3>() += loads.moment(b) / size_;
        part.mass += mass * reach.transpose() * reach;
        part.mass.bottomRightCorner<3, 3>() +=
            mass / blocks.volume[b] / (size_ * size_) * turn * blocks.inertia[b] * turn.transpose();
    }

    /// Takes off what accelerates parts that hang together as one body.
    void leave_common_motion() {
        std::map<std::size_t, Part> whole;
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            Part& sum = whole[first_of(p)];
            sum.load += parts_[p].load;
            sum.mass += parts_[p].mass;
        }
        std::map<std::size_t, Vec6> acceleration;
        for (const auto& [first, sum] : whole) acceleration[first] = sum.mass.ldlt().solve(sum.load);
        for (std::size_t p = 0; p < parts_.size(); ++p) parts_[p].load -= parts_[p].mass * acceleration[first_of(p)];
    }

    template <class See> void each_place(const See& see) const {
        const auto& contacts = model_.contacts;
        const auto& subs = model_.sub_contacts;
        for (const Row c : joints_) {
            const Span span = contacts.sub_contacts[c];
            for (Row s = span.first; s < span.end(); ++s)
                see(s, part(contacts.block1[c]), part(contacts.block2[c]), subs.area[s], reach_of(subs.load_place(s)));
        }
    }

    static void add(std::vector<Eigen::Triplet<double>>& entries, std::size_t row, std::size_t column, const Mat6& m) {
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                entries.emplace_back(static_cast<int>(6 * row) + i, static_cast<int>(6 * column) + j, m(i, j));
    }

    const Model& model_;
    Vec3 origin_;
    double size_;
    bool known_ = true, pushed_ = false;
    std::vector<Part> parts_;
    std::map<Row, std::size_t> part_of_;
    std::vector<Row> joints_;
    std::vector<std::size_t> together_; ///< by part: an earlier one that joints connect with it, or itself
};

/// Whether any body acts on another one, or a structure does.
bool any_force(const Model& model) {
    const auto acts = [](double force) { return force != 0; };
    const auto pulls = [](const Vec3& force) { return !force.isZero(0); };
    const auto& subs = model.sub_contacts;
    return std::ranges::any_of(subs.normal_force, acts) ||
           std::ranges::any_of(subs.shear_force.component,
                               [&](const auto& c) { return std::ranges::any_of(c, acts); }) ||
           std::ranges::any_of(model.structures.member_nodes.rock_force, pulls) ||
           std::ranges::any_of(model.structures.cable_nodes.force, pulls);
}

} // namespace

void load_parted_joints(Model& model, JointRegistry& joints, const std::vector<std::vector<Row>>& bodies) {
    if (bodies.empty() || !any_force(model)) return;
    find_contacts(model, joints);
    find_ends_of_water(model);
    put_water(model);
    JointForces forces;
    joint_forces(model, forces);
    const Loads loads(model, forces);
    std::vector<PartedBody> parted;
    std::vector<std::size_t> body_of(model.blocks.size(), bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        parted.emplace_back(model, loads, bodies[i]);
        if (parted.back().usable())
            for (const Row b : bodies[i]) body_of[b] = i;
    }
    const auto& contacts = model.contacts;
    for (Row c = 0; c < static_cast<Row>(contacts.size()); ++c) {
        const std::size_t body = body_of[contacts.block1[c]];
        if (body == bodies.size() || body != body_of[contacts.block2[c]]) continue;
        if (contacts.kind[c] == ContactKind::joint && contacts.type[c] == ContactType::face_face)
            parted[body].add_joint(c);
    }
    auto& subs = model.sub_contacts;
    std::vector<char> marked(subs.size(), 0);
    for (PartedBody& body : parted)
        body.solve([&](Row s, const Vec3& force) {
            const Vec3 n = contacts.normal[subs.contact[s]];
            subs.normal_force[s] = force.dot(n);
            subs.shear_force.set(s, force - force.dot(n) * n);
            marked[s] = 1;
        });
    initialise_sub_contacts(model, joints, marked);
    ModelEdit(model, Change::properties);
}

} // namespace kaya
