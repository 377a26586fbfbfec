#include "python/results.hpp"

#include "commands/list/interfaces.hpp"
#include "commands/list/reactions.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "model/kinds/groups.hpp"
#include "model/measure/joint_polygons.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace kaya::python {

namespace py = pybind11;

namespace {

py::array_t<double> array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }
py::array_t<double> array_of(const std::vector<double>& numbers) {
    return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

} // namespace

py::list histories(PythonSession& self) {
    const auto& histories = self.session().engine.model.histories;
    py::list all;
    for (const auto& history : histories.all) {
        const auto first = static_cast<std::ptrdiff_t>(history.first_sample);
        const std::vector<double> time(histories.time.begin() + first, histories.time.end());
        const std::vector<double> cycles(histories.cycle.begin() + first, histories.cycle.end());
        all.append(
            py::make_tuple(history.number, history.label, array_of(time), array_of(cycles), array_of(history.values)));
    }
    return all;
}

py::list interfaces(PythonSession& self) {
    Session& session = self.session();
    Model& model = session.engine.model;
    if (!session.engine.inside_cycle) find_contacts(model, session.engine.joints);
    std::vector<Row> all(model.contacts.size());
    for (std::size_t row = 0; row < all.size(); ++row) all[row] = static_cast<Row>(row);
    py::list result;
    for (const auto& one : interfaces_of(model, all)) {
        py::list polygons;
        for (const Row contact : one.contacts)
            for (const auto& polygon : joint_polygons(model, contact)) {
                py::array_t<double> corners({static_cast<py::ssize_t>(polygon.size()), py::ssize_t{3}});
                double* to = corners.mutable_data();
                for (const auto& corner : polygon)
                    for (const double part : corner) *to++ = part;
                polygons.append(corners);
            }
        py::dict row;
        row["block1"] = model.blocks.number[one.first];
        row["block2"] = model.blocks.number[one.second];
        row["contacts"] = one.contacts;
        row["area"] = one.area;
        row["normal"] = array_of(one.normal);
        row["force"] = array_of(one.force);
        row["moment"] = array_of(one.moment);
        row["centre"] = array_of(one.centre);
        row["point"] = array_of(one.point_of_action());
        row["normal_force"] = one.normal_force();
        row["shear_force"] = one.shear_force();
        row["utilisation"] = utilisation_of(model, session.engine.joints, one);
        row["polygons"] = polygons;
        result.append(row);
    }
    return result;
}

py::dict reactions(PythonSession& self) {
    const Model& model = self.session().engine.model;
    const auto found = reactions_of(model, [](Row) { return true; });
    py::dict groups;
    for (const auto& one : found.groups) {
        py::dict row;
        row["held"] = one.held;
        row["force"] = array_of(one.force);
        row["weight"] = array_of(one.weight);
        groups[py::str(std::string(default_group(model, one.group)))] = row;
    }
    py::dict result;
    result["groups"] = groups;
    result["reaction"] = array_of(found.reaction);
    result["weight"] = array_of(found.weight);
    result["load"] = array_of(found.load);
    result["unbalanced"] = array_of(found.unbalanced);
    return result;
}

} // namespace kaya::python
