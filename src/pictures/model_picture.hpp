// The model as drawings: blocks, joints, arrows.
#pragma once

#include "model/fields/field.hpp"
#include "model/kinds/selection.hpp"
#include "scene/scene.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// A half-space that is removed: where (x - origin) * normal is above 0.
struct CutPlane {
    Vec3 origin = Vec3::Zero(), normal = Vec3::UnitX();
};

/// How the model is shown, for all of its layers.
struct Shown {
    std::vector<Row> blocks; ///< rows, ascending
    double deformation = 0;  ///< displacements are drawn so many times larger
    std::optional<CutPlane> cut;
};

/// A quantity that colours show; a vector by its length, a text by names.
struct ColourField {
    ObjectKind table = ObjectKind::block;
    std::string title; ///< next to the colours: "displacement [length]"
    std::function<FieldValue(const Model&, Row)> get;
    bool motion = false; ///< a displacement or a velocity of gridpoints
};
/// Finds a quantity of gridpoints, zones or blocks by its name in fields(), or by a word of plot lines: disp, vel, sxx, group.
/// None when there is none of that name.
std::optional<ColourField> find_colour_field(const std::string& word);
/// The same of sub-contacts: slip, open, state, nforce ...
std::optional<ColourField> find_joint_field(const std::string& word);

/// Words of plot lines for quantities, beside the names in fields().
std::vector<std::string_view> short_field_words(bool of_joints);

/// The blocks with their edges, by the colours of a quantity or all in one colour. Colours of motion leave out blocks that are held.
void add_blocks(Scene& scene, const Model& model, const Shown& shown, const std::optional<ColourField>& field);
/// The contact faces of blocks, coloured by a quantity; blocks do not hide them.
void add_joints(Scene& scene, const Model& model, const Shown& shown, const ColourField& field);
/// Cables as lines, coloured by a quantity of fields() of their nodes. Blocks do not hide them.
void add_cables(Scene& scene, const Model& model, const Shown& shown, const std::string& field);
/// Elements of beams (lines) or of liners (triangles), by the colours of a number among their fields.
void add_members(Scene& scene, const Model& model, const Shown& shown, ObjectKind kind, const std::string& field);
/// Vectors of gridpoints (of rigid blocks: of blocks). `scale` 0: the longest is a twelfth of the model.
void add_arrows(Scene& scene, const Model& model, const Shown& shown, bool velocity, double scale);

/// The principal stresses of zones as crosses: a line along each, as long as the stress is large. `scale` 0: the longest is about as long as a zone.
void add_crosses(Scene& scene, const Model& model, const Shown& shown, double scale);
/// Surfaces in zones on which a quantity has a value. Of zones and blocks it is averaged to their gridpoints first, by volume.
void add_iso_surfaces(Scene& scene, const Model& model, const Shown& shown, const ColourField& field,
                      const std::vector<double>& levels);

/// Directions in the lower hemisphere, by equal areas: x to the east, y to the north, in a circle of radius 1.
std::array<double, 2> on_net(const Vec3& direction);
/// Directions under the names of their sets.
using NamedDirections = std::vector<std::pair<std::string, std::vector<Vec3>>>;
/// A net with the directions of each set.
Chart direction_net(const NamedDirections& sets, const std::string& title);
/// Poles of the joints by their sets, or the directions in which joints have slipped. Only joints between the blocks shown.
Chart joint_net(const Model& model, const Shown& shown, bool slip);

} // namespace kaya
