// Sub-contact updates per second of one joint law written in three ways: native, in the dialect of 3DEC 9 through the adapter, and in Lua.
// Rows slip back and forth under constant closure, in batches like those of the engine.
#include "commands/world/lua_joint_models.hpp"
#include "laws/batch.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <vector>

namespace {

constexpr std::size_t batch_rows = 512, rows = 16 * batch_rows;

kaya::JointRegistry& registry() {
    static kaya::JointRegistry joints = [] {
        kaya::JointRegistry made;
        kaya::add_lua_loader(made);
        made.set_path({KAYA_TEST_COMPAT, KAYA_TEST_COMPAT_SOURCES});
        return made;
    }();
    return joints;
}

/// Columns of many sub-contacts.
class Rows {
public:
    explicit Rows(const kaya::JointModel& model) : model_(model), objects_(model.keeps_objects() ? rows : 0) {
        for (const auto& property : model.properties) values_.push_back(property.initial);
        const std::pair<const char*, double> given[] = {
            {"kn", 1e9}, {"ks", 5e8}, {"friction", 30}, {"friction-residual", 25}};
        for (const auto& [word, value] : given) values_[model.find_property(word).value()] = value;
        for (auto& column : columns_) column.assign(rows, 0);
        columns_[0].assign(rows, 0.01);
        state_.assign(rows, 0);
        history_.assign(model.history.size(), std::vector<double>(rows, 0));
        pointers_.resize(model.history.size());
        each([this](kaya_jbatch& batch) { return kaya::initialise_batch(model_, batch); });
        step(-1e-4, 0);
    }

    void step(double opening, double slip) {
        columns_[2].assign(rows, opening);
        columns_[6].assign(rows, slip);
        each([this](kaya_jbatch& batch) { return kaya::run_batch(model_, batch); });
    }

private:
    template <class Call> void each(Call call) {
        for (std::size_t first = 0; first < rows; first += batch_rows) {
            auto column = [&](int k) { return columns_[static_cast<std::size_t>(k)].data() + first; };
            kaya_jbatch b{};
            b.n = batch_rows;
            b.properties = values_.data();
            b.time_step = 1e-5;
            b.area = column(0);
            b.normal_disp = column(1);
            b.normal_disp_inc = column(2);
            for (int k = 0; k < 3; ++k) {
                b.shear_disp[k] = column(3 + k);
                b.shear_disp_inc[k] = column(6 + k);
                b.shear_force[k] = column(9 + k);
            }
            b.pore_pressure = column(12);
            b.normal_force = column(13);
            b.normal_stiffness = column(14);
            b.shear_stiffness = column(15);
            b.frictional_work = column(16);
            b.state = state_.data() + first;
            for (std::size_t k = 0; k < pointers_.size(); ++k) pointers_[k] = history_[k].data() + first;
            b.history = pointers_.data();
            b.object = objects_.empty() ? nullptr : objects_[first].address();
            if (const auto failure = call(b)) throw std::runtime_error(failure->message);
        }
    }

    const kaya::JointModel& model_;
    std::vector<double> values_;
    std::array<std::vector<double>, 17> columns_;
    std::vector<std::uint32_t> state_;
    std::vector<std::vector<double>> history_;
    std::vector<double*> pointers_;
    std::vector<kaya::JointObject> objects_;
};

/// Updates per second over the given time, with alternating slip, a quarter of it elastic.
double rate(const char* name, double seconds) {
    using Clock = std::chrono::steady_clock;
    Rows joint(registry().get(name));
    double slip = 1e-5, spent = 0;
    std::size_t steps = 0;
    for (const auto start = Clock::now(); spent < seconds;
         spent = std::chrono::duration<double>(Clock::now() - start).count()) {
        joint.step(0, slip);
        if (++steps % 20 == 0) slip = -slip;
    }
    return static_cast<double>(steps * rows) / spent;
}

} // namespace

int main(int argc, char** argv) {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 1;
    for (const auto& [kind, name] :
         {std::pair{"native", "slip-native"}, {"dialect of 3DEC 9", "slip9"}, {"Lua", "slip-lua"}})
        fmt::print("{:<20}{:>10.2f} million updates/s\n", kind, 1e-6 * rate(name, seconds));
}
