// One zone of a zone model, without a block; shared by the tests of zone models.
#pragma once

#include "laws/joint_model.hpp"
#include "laws/zone_model.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace kaya::one_zone {

using Tensor = Eigen::Matrix<double, 6, 1>; ///< xx yy zz xy xz yz

inline Eigen::Matrix3d matrix(const Tensor& t) {
    Eigen::Matrix3d m;
    m << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
    return m;
}

inline Tensor tensor(const Eigen::Matrix3d& m) {
    Tensor t;
    t << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
    return t;
}

/// The rotation of a step with the axial vector of its spin.
inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& spin) {
    Eigen::Matrix3d half;
    half << 0, -spin[2], spin[1], spin[2], 0, -spin[0], -spin[1], spin[0], 0;
    half *= 0.5;
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    return (one - half).inverse() * (one + half);
}

inline ZoneModels& models() {
    static JointRegistry registry;
    registry.set_path({KAYA_TEST_JOINTS});
    return registry.zones;
}

/// A zone of a model.
struct Zone {
    const ZoneModel& model;
    std::vector<double> values;
    Tensor stress = Tensor::Zero();
    std::vector<double> history;
    std::uint32_t state = 0;
    double dissipated = 0;

    Zone(const std::string& name, const std::vector<std::pair<std::string, double>>& given)
        : model(models().get(name)) {
        for (const auto& property : model.properties) values.push_back(property.initial);
        for (const auto& [word, value] : given) values[model.find_property(word).value()] = value;
        EXPECT_EQ(model.check(values), "");
        EXPECT_TRUE(model.missing(values).empty());
        history.resize(model.history.size());
    }
    /// In a step with a spin the engine has turned the stress (equation 4 of docs/theory/zones.md).
    void strain(Tensor increment, const Eigen::Vector3d& spin) {
        const Eigen::Matrix3d q = rotation_of(spin);
        stress = tensor(q * matrix(stress) * q.transpose());
        spin_ = spin;
        strain(increment);
        spin_.reset();
    }
    void strain(Tensor increment) {
        double volume = 1, pressure = 0, dissipation = 0;
        std::vector<double*> columns;
        for (double& h : history) columns.push_back(&h);
        kaya_zbatch batch{};
        batch.n = 1;
        batch.properties = values.data();
        batch.time_step = 1;
        batch.volume = &volume;
        batch.pore_pressure = &pressure;
        batch.dissipation = &dissipation;
        batch.state = &state;
        batch.history = columns.data();
        for (int k = 0; k < 6; ++k) {
            batch.strain_inc[k] = &increment[k];
            batch.stress[k] = &stress[k];
        }
        for (int k = 0; spin_ && k < 3; ++k) batch.spin[k] = &(*spin_)[k];
        const auto failure = model.run(batch);
        ASSERT_FALSE(failure) << failure->message;
        dissipated += dissipation;
    }
    /// Shortens it along z under a constant lateral pressure.
    void triaxial(double step, double side) {
        const Zone before = *this;
        Tensor increment = Tensor::Zero();
        increment[2] = -step;
        for (int i = 0; i < 100; ++i) {
            stress = before.stress, history = before.history, state = before.state, dissipated = before.dissipated;
            strain(increment);
            const double bulk = values[0], shear = values[1], stiff = 2 * (bulk + shear / 3);
            bool done = true;
            for (int k = 0; k < 2; ++k) {
                const double missing = -side - stress[k];
                done = done && std::abs(missing) <= 1e-9 * (1 + std::abs(stress[2]));
                increment[k] += 0.5 * missing / stiff * 1.5;
            }
            if (done) return;
        }
    }
    /// The actual lateral pressure: during yield the bench reaches the requested one only approximately.
    double side_pressure() const { return -0.5 * (stress[0] + stress[1]); }
    double axial_strength(double side, double step, int steps) {
        Tensor all_round = Tensor::Zero();
        all_round.head<3>().setConstant(-side / (3 * values[0]));
        strain(all_round);
        for (int i = 0; i < steps; ++i) triaxial(step, side);
        return -stress[2];
    }

private:
    std::optional<Eigen::Vector3d> spin_;
};

inline const std::vector<std::pair<std::string, double>> moduli{{"bulk", 2e9}, {"shear", 1e9}};

inline std::vector<std::pair<std::string, double>> with(std::vector<std::pair<std::string, double>> more) {
    more.insert(more.begin(), moduli.begin(), moduli.end());
    return more;
}

/// Each model with values at which it yields.
inline std::vector<Zone> all_zones() {
    std::vector<Zone> zones;
    for (const auto& name : models().available()) {
        if (name == "elastic") zones.emplace_back(name, moduli);
        if (name == "anisotropic-elastic")
            zones.emplace_back(name, std::vector<std::pair<std::string, double>>{{"young-plane", 4e9},
                                                                                 {"young-normal", 1e9},
                                                                                 {"poisson-plane", 0.2},
                                                                                 {"poisson-normal", 0.15},
                                                                                 {"shear-normal", 7e8},
                                                                                 {"dip", 50},
                                                                                 {"dip-direction", 70}});
        if (name == "mohr-coulomb")
            zones.emplace_back(name, with({{"cohesion", 1e5}, {"friction", 30}, {"dilation", 12}, {"tension", 3e4}}));
        if (name == "strain-softening")
            zones.emplace_back(name, with({{"cohesion", 1e5}, {"friction", 25}, {"tension", 0}}));
        if (name == "hoek-brown")
            zones.emplace_back(name, with({{"constant-sci", 1e7}, {"constant-mb", 1.7}, {"constant-s", 0.004}}));
        if (name == "drucker-prager")
            zones.emplace_back(name, with({{"cohesion-drucker", 1e5},
                                           {"friction-drucker", 0.4},
                                           {"dilation-drucker", 0.2},
                                           {"tension", 5e4}}));
        if (name == "ubiquitous-joint")
            zones.emplace_back(name, with({{"cohesion", 2e5},
                                           {"friction", 40},
                                           {"tension", 5e4},
                                           {"joint-cohesion", 5e4},
                                           {"joint-friction", 20},
                                           {"joint-dilation", 5},
                                           {"dip", 50},
                                           {"dip-direction", 70}}));
    }
    return zones;
}

inline Tensor random_strain(std::mt19937& random, double size) {
    std::normal_distribution<double> normal;
    Tensor t;
    for (int k = 0; k < 6; ++k) t[k] = size * normal(random);
    return t;
}

} // namespace kaya::one_zone
