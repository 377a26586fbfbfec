// Small models for several tests of the engine.
#pragma once

#include "mechanics/supports/boundary.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/cycle/cycle.hpp"
#include "model/edit/build.hpp"
#include "model/kinds/selection.hpp"

#include <numeric>
#include <random>

namespace kaya::test {

/// A model with the joint models that ship.
struct Bench {
    Model model;
    JointRegistry joints;
    Cycle cycle{model, joints};

    Bench() { joints.set_path({KAYA_TEST_JOINTS}); }

    Row brick(const Vec3& low, const Vec3& high, std::int32_t material = 1) {
        NewBlock options;
        options.material = material;
        return add_block(model, make_brick(low, high), options);
    }
    void elastic(std::int32_t number, double density, double bulk, double shear) {
        auto& m = model.materials[number];
        m.density = density;
        m.bulk = bulk;
        m.shear = shear;
    }
    void joint(const std::string& name, const std::vector<std::pair<std::string, double>>& values) {
        find_contacts(model, joints);
        assign_joint_model(model, joints, all_contacts(), name, "");
        set_joint_properties(model, joints, all_contacts(), values, "");
    }
    /// Moves all gridpoints by up to 0.01 along each axis, and gives them random velocities of up to 1.
    void distort(std::mt19937& random) {
        std::uniform_real_distribution<double> small(-0.01, 0.01);
        auto& g = model.gridpoints;
        for (std::size_t p = 0; p < g.size(); ++p) {
            g.position[p] += Vec3(small(random), small(random), small(random));
            g.velocity[p] = 100 * Vec3(small(random), small(random), small(random));
        }
    }
    std::vector<Row> all_contacts() const {
        std::vector<Row> rows(model.contacts.size());
        std::iota(rows.begin(), rows.end(), 0);
        return rows;
    }
    std::vector<Row> gridpoints_of(Row block) const {
        std::vector<Row> rows(model.blocks.gridpoints[block].count);
        std::iota(rows.begin(), rows.end(), model.blocks.gridpoints[block].first);
        return rows;
    }
    void run(int cycles) {
        for (int i = 0; i < cycles; ++i) cycle.advance();
    }
    double normal_force() const {
        return std::accumulate(model.sub_contacts.normal_force.begin(), model.sub_contacts.normal_force.end(), 0.0);
    }
    double area() const { return std::accumulate(model.sub_contacts.area.begin(), model.sub_contacts.area.end(), 0.0); }
    Vec3 shear_force() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t s = 0; s < model.sub_contacts.size(); ++s) sum += model.sub_contacts.shear_force[s];
        return sum;
    }
};

} // namespace kaya::test
