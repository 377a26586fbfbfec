// bench_joints [ROWS]: sub-contact updates per second of every joint model that ships, on one thread: rows that fit into the cache, and a
// million rows that do not. The last column is the memory traffic of the million rows relative to that of a = b + s c over as much memory,
// in the same run: near 1 the model is limited by memory.
#include "laws/batch.hpp"
#include "laws/joint_model.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

namespace {

using kaya::JointModel;
using Column = std::vector<double>;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Best of several runs, to reduce the effect of other load on the machine.
template <class Call> double best_of(int runs, Call call) {
    double best = INFINITY;
    for (int i = 0; i < runs; ++i) {
        const double start = seconds();
        call();
        best = std::min(best, seconds() - start);
    }
    return best;
}

/// MPa and m; every second row slips.
const std::map<std::string, std::map<std::string, double>> values_given = {
    {"elastic", {}},
    {"mohr", {{"friction", 30}, {"cohesion", 0.1}, {"dilation", 5}}},
    {"bilinear-mohr", {{"friction", 35}, {"friction-2", 25}, {"cohesion-2", 0.5}}},
    {"softening-mohr", {{"friction", 35}, {"friction-residual", 25}, {"dc", 1e-3}}},
    {"fracture-energy", {{"friction", 35}, {"cohesion", 0.1}, {"g2", 1e-4}}},
    {"nonlinear", {{"friction", 30}, {"exponent-normal", 0.5}, {"exponent-shear", 0.5}}},
    {"power", {{"friction", 30}, {"constant-1", 1e-6}, {"exponent-1", 3}}},
    {"velocity-weakening", {{"friction-static", 35}, {"friction-dynamic", 20}, {"reference-velocity", 0.1}}},
    {"continuously-yielding", {{"friction", 30}, {"friction-initial", 45}, {"roughness", 3e-3}}},
    {"barton-bandis", {{"friction-residual", 25}, {"jrco", 8}, {"jcso", 100}, {"sigmac", 150}}},
};

/// Rows of one model, under 1 MPa, sheared back and forth.
class Rows {
public:
    Rows(const JointModel& model, std::size_t n) : model_(model), n_(n), state_(n, 0) {
        for (const auto& p : model.properties) values_.push_back(p.initial);
        const auto set = [&](const std::string& word, double value) { values_[*model.find_property(word)] = value; };
        set("jkn", 1e4);
        set("jks", 5e3);
        for (const auto& [word, value] : values_given.at(model.name)) set(word, value);
        if (const auto fault = model.check(values_); !fault.empty()) throw std::runtime_error(fault);
        for (auto* column :
             {&area_, &opening_, &normal_disp_, &pressure_, &normal_, &normal_stiffness_, &shear_stiffness_, &work_})
            column->assign(n, 0);
        for (int k = 0; k < 3; ++k) way_[k].assign(n, 0), disp_[k].assign(n, 0), force_[k].assign(n, 0);
        for (std::size_t i = 0; i < n; ++i) area_[i] = 0.01, normal_[i] = 0.01;
        history_.assign(model.history.size(), Column(n, 0));
        for (auto& column : history_) pointers_.push_back(column.data());
        for (const auto& f : model.fields) fields_.emplace_back(n, f.property ? values_[*f.property] : f.initial);
        field_pointers_.resize(fields_.size());
        auto b = batch(0, n);
        if (const auto failure = kaya::initialise_batch(model, b)) throw std::runtime_error(failure->message);
    }

    /// One step of all rows, in batches like those of the engine.
    void step(int count) {
        const double way = (count / 50) % 2 == 0 ? 2e-5 : -2e-5;
        if (count % 50 == 0)
            for (std::size_t i = 0; i < n_; ++i) way_[0][i] = i % 2 ? way : 0.1 * way;
        constexpr std::size_t rows_of_batch = 512;
        for (std::size_t first = 0; first < n_; first += rows_of_batch) {
            auto b = batch(first, std::min(rows_of_batch, n_ - first));
            if (const auto failure = kaya::run_batch(model_, b)) throw std::runtime_error(failure->message);
        }
    }

    /// Bytes per row that a step reads and writes.
    double traffic() const {
        const double in = 5 + 2; // area and increments; the guard reads both stiffnesses
        const double both = 5 + static_cast<double>(history_.size()); // forces, work, history
        return 8 * (in + 2 * both) + 2 * 4;
    }

private:
    kaya_jbatch batch(std::size_t first, std::size_t count) {
        kaya_jbatch b{};
        b.n = count;
        b.properties = values_.data();
        b.time_step = 1e-5;
        b.area = area_.data() + first;
        b.normal_disp = normal_disp_.data() + first;
        b.normal_disp_inc = opening_.data() + first;
        for (int k = 0; k < 3; ++k) {
            b.shear_disp[k] = disp_[k].data() + first;
            b.shear_disp_inc[k] = way_[k].data() + first;
            b.shear_force[k] = force_[k].data() + first;
        }
        b.pore_pressure = pressure_.data() + first;
        b.normal_force = normal_.data() + first;
        b.normal_stiffness = normal_stiffness_.data() + first;
        b.shear_stiffness = shear_stiffness_.data() + first;
        b.frictional_work = work_.data() + first;
        b.state = state_.data() + first;
        for (std::size_t k = 0; k < history_.size(); ++k) pointers_[k] = history_[k].data() + first;
        b.history = pointers_.data();
        for (std::size_t k = 0; k < fields_.size(); ++k) field_pointers_[k] = fields_[k].data() + first;
        if (!fields_.empty()) b.field = field_pointers_.data();
        return b;
    }

    const JointModel& model_;
    std::size_t n_;
    Column values_, area_, opening_, normal_disp_, pressure_, normal_, normal_stiffness_, shear_stiffness_, work_;
    std::array<Column, 3> way_, disp_, force_;
    std::vector<std::uint32_t> state_;
    std::vector<Column> history_, fields_;
    std::vector<double*> pointers_;
    std::vector<const double*> field_pointers_;
};

/// Bytes per second of a = b + s c over as many bytes as the columns of a model, much more than a cache.
double triad(std::size_t n) {
    Column a(n, 0), b(n, 1), c(n, 2);
    const double time = best_of(15, [&] {
        for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3 * c[i];
    });
    if (a[n / 2] != 7) std::abort();
    return 4 * 8 * static_cast<double>(n) / time; // a is read before it is written
}

double seconds_per_row(const JointModel& model, std::size_t n, int steps) {
    Rows rows(model, n);
    int count = 0;
    for (; count < 50; ++count) rows.step(count);
    const double time = best_of(5, [&] {
        for (int i = 0; i < steps; ++i) rows.step(++count);
    });
    return time / (static_cast<double>(n) * steps);
}

} // namespace

int main(int argc, char** argv) {
    kaya::JointRegistry registry;
    registry.set_path({KAYA_JOINT_FOLDER});
    const std::size_t few = 512, many = argc > 1 ? std::max(1ul, std::strtoul(argv[1], nullptr, 10)) : 1'000'000;
    const std::size_t column = 7 * many;
    const double memory = triad(column);
    fmt::print("a = b + s c over {:.3g} MB: {:.1f} GB/s\n\n", 3e-6 * sizeof(double) * static_cast<double>(column),
               memory / 1e9);
    fmt::print("{:22} {:>24} {:>24} {:>12} {:>12}\n", "model", fmt::format("{} rows, M updates/s", few),
               fmt::format("{} rows, M updates/s", many), "GB/s", "of a=b+sc");
    for (const auto& [name, values] : values_given) {
        const JointModel& model = registry.get(name);
        const double near = seconds_per_row(model, few, 400), far = seconds_per_row(model, many, 3);
        const double bytes = Rows(model, 1).traffic();
        fmt::print("{:22} {:24.1f} {:24.1f} {:12.1f} {:12.2f}\n", name, 1e-6 / near, 1e-6 / far, bytes / far / 1e9,
                   bytes / far / memory);
        std::fflush(stdout);
    }
    return 0;
}
