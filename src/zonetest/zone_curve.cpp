#include "zonetest/zone_curve.hpp"

#include "base/diagnostic.hpp"
#include "jointtest/gnuplot_text.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Checks each step for unphysical behaviour.
class ProgressCallback {
public:
    explicit ProgressCallback(std::vector<ZoneFinding>& findings) : findings_(findings) {}

    void compare(std::size_t step, const SingleZone& before, const SingleZone& after, const SixNumbers& increment,
                 double time) {
        const double size = std::abs(before.put_in) + std::abs(after.put_in) + 1e-300;
        if (after.dissipated - before.dissipated < -1e-9 * size)
            found(negative_, step,
                  fmt::format("plastic flow gives out work: {:.3g} per volume", before.dissipated - after.dissipated));
        const ZoneModuli moduli = after.moduli();
        double answered = 0, square = 0, trace = increment[0] + increment[1] + increment[2];
        for (std::size_t k = 0; k < 6; ++k) {
            answered += (k < 3 ? 1 : 2) * (after.stress[k] - before.stress[k]) * increment[k];
            square += (k < 3 ? 1 : 2) * increment[k] * increment[k];
        }
        const double elastic = 2 * moduli.shear * square + (moduli.bulk - 2.0 / 3.0 * moduli.shear) * trace * trace;
        if (answered > (1 + 1e-6) * elastic && !stiff_)
            if (const double most = stiffest(before, increment, time); most > 1 + doubtful)
                found(
                    stiff_, step,
                    fmt::format("the zone is {:.4g} times as stiff as moduli() says: the time step would be too large",
                                most));
        if (step % 64 == 1) in_a_batch(step, before, after, increment, time);
    }

private:
    /// Beyond what differences of curved laws tell.
    static constexpr double doubtful = 1e-3;

    /// The largest eigenvalue of the stiffness of a step over that of moduli(), which is what the time step depends on. Flow that is not
    /// associated may answer single directions more stiffly.
    static double stiffest(const SingleZone& before, const SixNumbers& increment, double time) {
        const ZoneModuli moduli = before.moduli();
        const double lame = moduli.bulk - 2.0 / 3.0 * moduli.shear;
        double shift = 0;
        for (const double component : increment) shift = std::max(shift, 1e-5 * std::abs(component));
        Eigen::Matrix<double, 6, 6> slopes, elastic = Eigen::Matrix<double, 6, 6>::Zero();
        elastic.topLeftCorner<3, 3>().setConstant(lame);
        elastic.diagonal().array() += 2 * moduli.shear;
        for (int k = 0; k < 6; ++k) {
            SixNumbers more = increment, less = increment;
            more[static_cast<std::size_t>(k)] += shift;
            less[static_cast<std::size_t>(k)] -= shift;
            SingleZone above = before, below = before;
            above.strain_by(more, time);
            below.strain_by(less, time);
            for (int i = 0; i < 6; ++i) {
                const auto row = static_cast<std::size_t>(i);
                slopes(i, k) = (above.stress[row] - below.stress[row]) / (2 * shift);
            }
        }
        return Eigen::Matrix<double, 6, 6>(elastic.inverse() * slopes).eigenvalues().real().maxCoeff();
    }

    void found(bool& once, std::size_t step, std::string text) {
        if (!once) findings_.push_back({step, std::move(text)});
        once = true;
    }

    /// The same zone as one row of many, whose neighbours deform otherwise.
    void in_a_batch(std::size_t step, const SingleZone& before, const SingleZone& after, const SixNumbers& increment,
                    double time) {
        constexpr std::size_t rows = 11, own = 6;
        double strain[6][rows], stress[6][rows], volume[rows], pressure[rows] = {}, dissipation[rows] = {};
        std::uint32_t state[rows];
        std::vector<std::array<double, rows>> history(after.history.size());
        std::vector<double*> columns;
        for (auto& column : history) columns.push_back(column.data());
        for (std::size_t i = 0; i < rows; ++i) {
            const double part = i == own ? 1 : 0.25 * static_cast<double>(i) - 1;
            for (std::size_t k = 0; k < 6; ++k) {
                strain[k][i] = part * increment[k];
                stress[k][i] = before.stress[k];
            }
            for (std::size_t h = 0; h < history.size(); ++h) history[h][i] = before.history[h];
            volume[i] = before.volume;
            state[i] = before.state;
        }
        kaya_zbatch batch{};
        batch.n = rows;
        batch.properties = before.values->data();
        batch.time_step = time;
        batch.volume = volume;
        batch.pore_pressure = pressure;
        batch.dissipation = dissipation;
        batch.state = state;
        batch.history = columns.data();
        for (std::size_t k = 0; k < 6; ++k) {
            batch.strain_inc[k] = strain[k];
            batch.stress[k] = stress[k];
        }
        if (const auto failure = before.model->run(batch))
            return found(neighbours_, step, fmt::format("as one row of many it fails: {}", failure->message));
        bool same = state[own] == after.state;
        for (std::size_t k = 0; k < 6; ++k) same = same && stress[k][own] == after.stress[k];
        for (std::size_t h = 0; h < before.model->history.size(); ++h)
            same = same && history[h][own] == after.history[h];
        if (!same) found(neighbours_, step, "what a row answers depends on the rows next to it");
    }

    std::vector<ZoneFinding>& findings_;
    bool negative_ = false, stiff_ = false, neighbours_ = false;
};

} // namespace

ZoneCurve follow_zone_path(const ZoneModel& model, const std::vector<double>& values, const ZonePath& path,
                           const ZoneCurveSettings& settings) {
    SingleZone zone(model, values, settings.volume);
    zone.stress = settings.stress;
    for (std::size_t k = 0; k < 6; ++k)
        (path.is_stress[k] ? zone.stress : zone.strain)[k] = path.points.front().value[k];
    ZoneCurve curve;
    ProgressCallback progress(curve.findings);
    curve.points.push_back(zone);
    curve.time.push_back(path.points.front().time);
    for (std::size_t p = 1; p < path.points.size(); ++p) {
        const ZonePoint &from = path.points[p - 1], &to = path.points[p];
        for (int i = 1; i <= settings.steps; ++i) {
            const double part = static_cast<double>(i) / settings.steps;
            ZoneStep step;
            step.is_stress = path.is_stress;
            step.time = (to.time - from.time) / settings.steps;
            for (std::size_t k = 0; k < 6; ++k) {
                const double whole = to.value[k] - from.value[k];
                step.value[k] = path.is_stress[k] ? from.value[k] + part * whole : whole / settings.steps;
            }
            const SingleZone before = zone;
            try {
                const SixNumbers increment = zone.step(step);
                progress.compare(curve.points.size(), before, zone, increment, step.time);
            } catch (Diagnostic& problem) {
                throw problem.add(
                    fmt::format("on the way to point {} of the path, in step {} of {}", p + 1, i, settings.steps));
            }
            curve.points.push_back(zone);
            curve.time.push_back(from.time + part * (to.time - from.time));
        }
    }
    return curve;
}

CsvTable zone_curve_table(const ZoneCurve& curve) {
    CsvTable table;
    const auto column = [&](std::string name, const auto& value) {
        std::vector<double> numbers;
        for (const auto& zone : curve.points) numbers.push_back(value(zone));
        table.add(std::move(name), std::move(numbers));
    };
    table.add("time", curve.time);
    for (std::size_t k = 0; k < 6; ++k)
        column(fmt::format("{}_strain", component_names[k]), [k](const SingleZone& z) { return z.strain[k]; });
    for (std::size_t k = 0; k < 6; ++k)
        column(fmt::format("{}_stress", component_names[k]), [k](const SingleZone& z) { return z.stress[k]; });
    column("mean_stress", [](const SingleZone& z) { return z.mean_stress(); });
    column("deviator", [](const SingleZone& z) { return z.deviator(); });
    column("volume_strain", [](const SingleZone& z) { return z.volume_strain(); });
    column("put_in", [](const SingleZone& z) { return z.put_in; });
    column("dissipated", [](const SingleZone& z) { return z.dissipated; });
    column("state", [](const SingleZone& z) { return static_cast<double>(z.state); });
    const auto& kept = curve.points.front().model->history;
    for (std::size_t h = 0; h < kept.size(); ++h)
        column(kept[h].name, [h](const SingleZone& z) { return z.history[h]; });
    return table;
}

std::string zone_curve_figure(const ZoneCurve& curve, const std::string& title) {
    std::size_t axial = 0;
    std::array<double, 6> widest{};
    for (const auto& zone : curve.points)
        for (std::size_t k = 0; k < 6; ++k) widest[k] = std::max(widest[k], std::abs(zone.strain[k]));
    axial = static_cast<std::size_t>(std::ranges::max_element(widest) - widest.begin());
    std::string script = "$curve << EOD\n";
    constexpr std::size_t most_points = 800; // enough for the eye
    const std::size_t every = std::max<std::size_t>(1, curve.points.size() / most_points);
    for (std::size_t i = 0; i < curve.points.size(); i += every) {
        const auto& zone = curve.points[i];
        script += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", zone.strain[axial], zone.deviator(), zone.mean_stress(),
                              zone.volume_strain());
    }
    return fmt::format(
        "{}EOD\nset multiplot layout 2,1 title {}\nset xlabel \"{} strain\"\nset key outside top center horizontal\n"
        "set ylabel \"stress\"\nplot $curve using 1:2 with lines lw 2 title \"deviator\", "
        "$curve using 1:3 with lines lw 1.5 title \"mean\"\n"
        "set ylabel \"volume strain\"\nset key off\nplot $curve using 1:4 with lines lw 2\nunset multiplot\n",
        script, gnuplot_text(title), component_names[axial]);
}

} // namespace kaya
