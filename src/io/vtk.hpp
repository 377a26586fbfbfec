// Files of the model for ParaView and similar programs: VTK's XML files of unstructured grids, and series of them with the model time.
#pragma once

#include "model/tables/model.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace kaya {

/// Values of joint models at sub-contacts, by the name of the joint model and of the value; NaN where the model does not have it.
using OwnValues = std::map<std::string, std::map<std::string, std::function<double(const Model&, Row)>>>;

/// Files of unstructured grids as bytes. Arrays are the fields of model/fields/field.hpp by their names, each with its kind of quantity where
/// VTK keeps units (docs/results.md). Field data: time, cycle, and NAME_names for each array NAME of texts.
/// NAME_blocks_N.vtu: tetrahedra for zones, a polyhedron for each rigid block. Point data: gridpoints. Cell data: zones (NaN, or -1 in
/// whole numbers, for a rigid block), `stress` (XX YY ZZ XY YZ XZ, compression negative), and block_NAME of the block.
std::string vtk_blocks(const Model& model);

/// NAME_faces_N.vtu: the triangles of all faces. Point data: gridpoints. Cell data: faces, and block_NAME of the block.
std::string vtk_faces(const Model& model);

/// NAME_joints_N.vtu: polygons where two faces are in contact. Point data and cell data: the nearest sub-contact, with jmodel_NAME for the
/// history of its joint model. Cell data also contact_NAME of the contact.
std::string vtk_joints(const Model& model, const OwnValues& own = {});

/// NAME_subcontacts_N.vtu: a vertex for each sub-contact, including those of corners and edges. Cell data as in NAME_joints_N.vtu.
std::string vtk_sub_contacts(const Model& model, const OwnValues& own = {});
/// The bars of cables as lines.
std::string vtk_cables(const Model& model);
/// Elements of beams as lines, of liners as triangles. Point data: nodes of beams and liners. Cell data: the elements.
std::string vtk_beams(const Model& model);
std::string vtk_liners(const Model& model);

/// The series of one run: the writes of each name are numbered from 0.
class VtkSeries {
public:
    /// Writes the files of the next number, then the series NAME.pvd (blocks), NAME_faces.pvd, NAME_joints.pvd and NAME_subcontacts.pvd
    /// (and NAME_cables.pvd, NAME_beams.pvd, NAME_liners.pvd if there are any), and NAME_paraview.py, which opens them in ParaView. An
    /// ending .vtu or .pvd in the name is left out. A name that an earlier run used starts again: its files are replaced in order, and its
    /// series list those of this run. Throws Diagnostic (Fault::run); files that were complete before remain complete. Returns the paths.
    std::vector<std::string> write(const Model& model, const std::string& name, const OwnValues& own = {});

    std::function<void(const std::string&)> before_writing; ///< may refuse a file; called before the first is written

private:
    std::map<std::string, std::vector<double>> times_; ///< model time of each write, by name
    /// The first write with cables, beams or liners, by name and by that word.
    std::map<std::string, std::map<std::string, std::size_t>> first_with_;
};

} // namespace kaya
