#include "test_joint.hpp"

#include <cmath>

namespace kaya::test {

const JointModel& shipped(const std::string& name) {
    static JointRegistry registry = [] {
        JointRegistry made;
        made.set_path({KAYA_SHIPPED_MODELS});
        return made;
    }();
    return registry.get(name);
}

const JointModel& plugin(const std::string& name) {
    static JointRegistry registry = [] {
        JointRegistry made;
        made.set_path({KAYA_TEST_PLUGINS});
        return made;
    }();
    return registry.get(name);
}

const JointModel& compat(const std::string& name) {
    static JointRegistry registry = [] {
        JointRegistry made;
        made.set_path({KAYA_TEST_COMPAT});
        made.tables().set_source([](const std::string& table) -> std::optional<JointTables::Points> {
            if (table == "7") return JointTables::Points{{0, 0.001}, {30, 20}};
            if (table == "8") return JointTables::Points{{0, 0.001}, {1, 2}};
            return std::nullopt;
        });
        return made;
    }();
    return registry.get(name);
}

Values with(Values base, const Values& more) {
    for (const auto& [word, value] : more) base[word] = value;
    return base;
}

std::vector<double> values_of(const JointModel& model, const Values& given) {
    std::vector<double> values;
    for (const auto& property : model.properties) values.push_back(property.initial);
    for (const auto& [word, value] : given) {
        const auto index = model.find_property(word);
        EXPECT_TRUE(index) << model.name << " has no property " << word;
        if (index) values[*index] = value;
    }
    return values;
}

TestJoint::TestJoint(const JointModel& model_, const Values& given, double area_, std::size_t rows)
    : model(&model_), values(values_of(model_, given)), area(rows, area_) {
    EXPECT_EQ(model->check(values), "");
    EXPECT_TRUE(model->missing(values).empty());
    for (auto* column : {&normal_disp, &normal_disp_inc, &pore_pressure, &normal_force, &normal_stiffness,
                         &shear_stiffness, &frictional_work})
        column->assign(rows, 0);
    for (int k = 0; k < 3; ++k)
        for (auto* vector : {&shear_disp, &shear_disp_inc, &shear_force}) (*vector)[k].assign(rows, 0);
    state.assign(rows, 0);
    history.assign(model->history.size(), std::vector<double>(rows, 0));
    for (const auto& f : model->fields) field.emplace_back(rows, f.property ? values[*f.property] : f.initial);
    object.resize(model->keeps_objects() ? rows : 0);
    initialise();
}

kaya_jbatch TestJoint::batch() {
    history_columns_.clear();
    for (auto& column : history) history_columns_.push_back(column.data());
    field_columns_.clear();
    for (auto& column : field) field_columns_.push_back(column.data());
    kaya_jbatch b{};
    b.n = area.size();
    b.properties = values.data();
    b.time_step = time_step;
    b.area = area.data();
    b.normal_disp = normal_disp.data();
    b.normal_disp_inc = normal_disp_inc.data();
    for (int k = 0; k < 3; ++k) {
        b.shear_disp[k] = shear_disp[k].data();
        b.shear_disp_inc[k] = shear_disp_inc[k].data();
        b.shear_force[k] = shear_force[k].data();
    }
    b.pore_pressure = pore_pressure.data();
    b.normal_force = normal_force.data();
    b.normal_stiffness = normal_stiffness.data();
    b.shear_stiffness = shear_stiffness.data();
    b.frictional_work = frictional_work.data();
    b.state = state.data();
    b.history = history_columns_.data();
    b.field = field.empty() ? nullptr : field_columns_.data();
    b.object = object.empty() ? nullptr : object[0].address();
    b.tables = model->tables;
    return b;
}

void TestJoint::initialise() {
    auto b = batch();
    const auto failure = initialise_batch(*model, b);
    EXPECT_FALSE(failure) << failure->message;
}

void TestJoint::step(double opening, const Vector& slip) {
    for (std::size_t i = 0; i < area.size(); ++i) {
        normal_disp_inc[i] = opening;
        for (int k = 0; k < 3; ++k) shear_disp_inc[k][i] = slip[k];
    }
    auto b = batch();
    const auto failure = run_batch(*model, b);
    ASSERT_FALSE(failure) << failure->message;
    for (std::size_t i = 0; i < area.size(); ++i) {
        normal_disp[i] += opening;
        for (int k = 0; k < 3; ++k) shear_disp[k][i] += slip[k];
    }
}

void TestJoint::slip_at_stress(double stress, const Vector& slip) {
    const auto error_of = [&](double opening) {
        TestJoint trial = *this;
        trial.step(opening, slip);
        return trial.normal_stress() - stress;
    };
    // The stress decreases as the joint opens: bracket the opening of the given stress, then bisect.
    double low = 0, high = 0, width = std::max(std::abs(stress), 1e-3) / normal_stiffness[0] + 1e-12;
    while (error_of(high) > 0) high += width *= 2;
    width = std::max(std::abs(stress), 1e-3) / normal_stiffness[0] + 1e-12;
    while (error_of(low) < 0) low -= width *= 2;
    while (true) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (error_of(middle) > 0 ? low : high) = middle;
    }
    step(high, slip);
}

double TestJoint::shear_stress(std::size_t row) const {
    return std::hypot(shear_force[0][row], shear_force[1][row], shear_force[2][row]) / area[row];
}

double TestJoint::history_value(const std::string& name, std::size_t row) const {
    for (std::size_t k = 0; k < model->history.size(); ++k)
        if (model->history[k].name == name) return history[k][row];
    ADD_FAILURE() << model->name << " has no history variable " << name;
    return std::nan("");
}

bool TestJoint::in_state(const std::string& name, std::size_t row) const {
    for (std::size_t bit = 0; bit < model->states.size(); ++bit)
        if (model->states[bit] == name) return (state[row] >> bit & 1) != 0;
    ADD_FAILURE() << model->name << " has no state " << name;
    return false;
}

double work_of_step(const TestJoint& before, const TestJoint& after) {
    double work = -0.5 * (before.normal_force[0] + after.normal_force[0]) * after.normal_disp_inc[0];
    for (int k = 0; k < 3; ++k)
        work -= 0.5 * (before.shear_force[k][0] + after.shear_force[k][0]) * after.shear_disp_inc[k][0];
    return work;
}

} // namespace kaya::test
