#include "zonetest/single_zone.hpp"

#include "base/diagnostic.hpp"
#include "laws/zone_trial.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The components whose stress is prescribed, as equations for their strain increments.
class StressEquations {
public:
    StressEquations(const SingleZone& zone, const ZoneStep& step) : zone_(zone), step_(step) {
        for (std::size_t k = 0; k < 6; ++k)
            if (step.is_stress[k]) unknown_.push_back(k);
    }

    Eigen::Index count() const { return static_cast<Eigen::Index>(unknown_.size()); }
    SixNumbers increment(const Vector& x) const {
        SixNumbers strain = step_.value;
        for (std::size_t i = 0; i < unknown_.size(); ++i) strain[unknown_[i]] = x[static_cast<Eigen::Index>(i)];
        return strain;
    }
    Vector residual(const Vector& x) const {
        SingleZone tried = zone_;
        tried.strain_by(increment(x), step_.time);
        Vector r(count());
        for (std::size_t i = 0; i < unknown_.size(); ++i)
            r[static_cast<Eigen::Index>(i)] = tried.stress[unknown_[i]] - step_.value[unknown_[i]];
        return r;
    }
    Matrix slope(const Vector& x, const Vector& at_x, double shift) const {
        Matrix m(count(), count());
        for (Eigen::Index k = 0; k < count(); ++k) {
            Vector moved = x;
            moved[k] += shift;
            m.col(k) = (residual(moved) - at_x) / shift;
        }
        return m;
    }
    Matrix elastic_slope(const ZoneModuli& moduli) const {
        Matrix m = Matrix::Zero(count(), count());
        for (Eigen::Index i = 0; i < count(); ++i)
            for (Eigen::Index k = 0; k < count(); ++k) {
                const bool both_normal =
                    unknown_[static_cast<std::size_t>(i)] < 3 && unknown_[static_cast<std::size_t>(k)] < 3;
                if (both_normal) m(i, k) = moduli.bulk - 2.0 / 3.0 * moduli.shear;
                if (i == k) m(i, k) += 2 * moduli.shear;
            }
        return m;
    }

private:
    const SingleZone& zone_;
    const ZoneStep& step_;
    std::vector<std::size_t> unknown_;
};

/// First with the elastic slopes while the residual falls, which preserves symmetry: on an edge of a yield surface the flow is not unique.
/// Then by Newton's method with slopes by differences.
bool solve(const StressEquations& equations, const ZoneModuli& moduli, double exact, double step_strain, Vector& x) {
    const Matrix elastic = equations.elastic_slope(moduli);
    const auto elastic_inverse = elastic.fullPivLu();
    Vector r = equations.residual(x);
    constexpr int most = 2000;
    constexpr double worth_going_on = 0.99;
    for (int k = 0; k < most && r.norm() > exact; ++k) {
        const Vector nearer = x - elastic_inverse.solve(r), at_nearer = equations.residual(nearer);
        if (!(at_nearer.norm() < worth_going_on * r.norm())) break;
        x = nearer, r = at_nearer;
    }
    for (int k = 0; k < most && r.norm() > exact; ++k) {
        const double shift = 1e-6 * std::max({x.norm(), step_strain, r.norm() / moduli.shear});
        const Vector by_slope = x - equations.slope(x, r, shift).fullPivLu().solve(r);
        const Vector by_elastic = x - elastic_inverse.solve(r);
        const Vector at_slope = by_slope.allFinite() ? equations.residual(by_slope) : r;
        const Vector at_elastic = equations.residual(by_elastic);
        if (!(at_slope.norm() < at_elastic.norm())) {
            if (!(at_elastic.norm() < (1 - 1e-12) * r.norm())) return false;
            x = by_elastic, r = at_elastic;
        } else {
            if (!(at_slope.norm() < (1 - 1e-12) * r.norm())) return false;
            x = by_slope, r = at_slope;
        }
    }
    return r.norm() <= exact;
}

} // namespace

SingleZone::SingleZone(const ZoneModel& model_, std::vector<double> values_, double volume_)
    : model(&model_), values(std::make_shared<const std::vector<double>>(std::move(values_))), volume(volume_) {
    if (const auto missing = model->missing(*values); !missing.empty())
        throw Diagnostic(fmt::format("zone model {} lacks {}", model->name, fmt::join(missing, ", ")),
                         fmt::format("give it after the path: {}=1e9", missing.front()));
    if (const auto fault = model->check(*values); !fault.empty())
        throw Diagnostic(fmt::format("zone model {}: {}", model->name, fault), "correct the values");
}

double SingleZone::deviator() const {
    const double p = mean_stress();
    double second = stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
    for (int k = 0; k < 3; ++k) second += 0.5 * (stress[k] - p) * (stress[k] - p);
    return std::sqrt(3 * second);
}

void SingleZone::strain_by(const SixNumbers& increment, double time) {
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> columns{};
    for (std::size_t k = 0; k < history.size(); ++k) columns[k] = &history[k];
    const double pressure = 0;
    double taken = 0;
    const SixNumbers before = stress;
    kaya_zbatch batch{};
    batch.n = 1;
    batch.properties = values->data();
    batch.time_step = time;
    batch.volume = &volume;
    batch.pore_pressure = &pressure;
    batch.dissipation = &taken;
    batch.state = &state;
    batch.history = columns.data();
    for (std::size_t k = 0; k < 6; ++k) {
        batch.strain_inc[k] = &increment[k];
        batch.stress[k] = &stress[k];
    }
    if (const auto failure = run_fenced(*model, batch))
        throw Diagnostic(failure->message, fmt::format("the strain so far is {:g}", fmt::join(strain, ", ")),
                         Fault::run);
    for (std::size_t k = 0; k < 6; ++k) {
        strain[k] += increment[k];
        put_in += (k < 3 ? 0.5 : 1) * (before[k] + stress[k]) * increment[k];
    }
    dissipated += taken;
}

SixNumbers SingleZone::step(const ZoneStep& step) {
    const StressEquations equations(*this, step);
    SixNumbers increment = step.value;
    if (equations.count() > 0) {
        const ZoneModuli stiff = moduli();
        double scale = 0, strain_size = 1e-12;
        for (std::size_t k = 0; k < 6; ++k) {
            scale = std::max({scale, std::abs(stress[k]), step.is_stress[k] ? std::abs(step.value[k]) : 0.0});
            if (!step.is_stress[k]) strain_size = std::max(strain_size, std::abs(step.value[k]));
        }
        constexpr double part = 1e-12; // of the stresses
        const double exact = part * (scale + stiff.shear * strain_size);
        Vector x = Vector::Zero(equations.count());
        if (!solve(equations, stiff, exact, strain_size, x)) {
            std::vector<std::string> wanted;
            for (std::size_t k = 0; k < 6; ++k)
                if (step.is_stress[k]) wanted.push_back(fmt::format("{} {:g}", component_names[k], step.value[k]));
            throw Diagnostic(
                fmt::format("zone model {} cannot carry the stress {} here", model->name, fmt::join(wanted, ", ")),
                "beyond its strength no strain does: prescribe a strain there", Fault::run);
        }
        increment = equations.increment(x);
    }
    strain_by(increment, step.time);
    return increment;
}

} // namespace kaya
