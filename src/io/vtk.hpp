// Pictures of the model for ParaView and its like: VTK's XML files of unstructured grids, and series of
// them with the model time.
#pragma once

#include "model/model.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace kaya {

/// NAME_blocks_N.vtu as bytes: tetrahedra for zones, a polyhedron for each rigid block.
/// Point data: displacement, velocity. Cell data: block_id, region, group, material, deformable, stress
/// (XX YY ZZ XY YZ XZ, compression negative; 0 in rigid blocks). Field data: time, cycle, group_names.
std::string vtk_blocks(const Model& model);

/// NAME_joints_N.vtu as bytes: a vertex for each sub-contact. Cell data: force_normal, force_shear (vector on
/// block2), stress_normal, stress_shear (its size), disp_normal, disp_shear (vector), normal (from block1 to
/// block2), area, state, joint_set, contact_id, subcontact_id, block1, block2, jmodel (index into the field
/// data jmodel_names, -1 for none). Field data: time, cycle, jmodel_names.
/// `history` names what each joint model remembers: an array jmodel_NAME for each variable, NaN where a model has none.
using HistoryNames = std::map<std::string, std::vector<std::string>>;
std::string vtk_joints(const Model& model, const HistoryNames& history = {});

/// The series of one run: each name counts its writes from 0.
class VtkSeries {
public:
    /// Writes the two files of the next number and then both series, NAME.pvd (blocks) and
    /// NAME_joints.pvd. An ending .vtu or .pvd in the name is left out. A name that an earlier run used is
    /// begun anew: its files are replaced one after the other and its series lists those of this run.
    /// Throws Diagnostic (Fault::run); files that were complete before stay so. Returns the four paths.
    std::vector<std::string> write(const Model& model, const std::string& name, const HistoryNames& history = {});

    std::function<void(const std::string&)> before_writing; ///< may refuse a file; asked before the first is written

private:
    std::map<std::string, std::vector<double>> times_; ///< model time of each write, by name
};

} // namespace kaya
