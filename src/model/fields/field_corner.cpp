// Corners of the triangles of faces: three rows for each triangle. FISH walks those of a face with face_vlist and
// vl_next.
#include "model/fields/field_rows.hpp"

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::corner;

FieldValue face(const Model& model, Row corner) { return Link{ObjectKind::face, model.triangles.face[corner / 3]}; }
FieldValue gridpoint(const Model& model, Row corner) {
    return Link{ObjectKind::gridpoint, model.triangles.gridpoints[corner / 3][corner % 3]};
}

} // namespace

const Fields& corner_fields() {
    static const Fields rows{
        {table, "face", "", "", "-", "face that it is on", face, nullptr},
        {table, "gridpoint", "vl_gp", "", "-", "gridpoint that is there", gridpoint, nullptr},
        {table, "vertex", "vl_vertex", "", "-", "the same: a vertex of a rigid block is a gridpoint", gridpoint,
         nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
