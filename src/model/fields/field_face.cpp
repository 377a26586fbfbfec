// Present quantities of faces, computed from their triangles.
#include "model/fields/field_rows.hpp"
#include "model/measure/measure.hpp"

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::face;
constexpr auto rows_of = &Model::faces;

double area(const Model& model, Row face) { return face_area_vector(model, face).norm(); }

Vec3 normal(const Model& model, Row face) {
    const Vec3 area_vector = face_area_vector(model, face);
    const double length = area_vector.norm();
    return length > 0 ? Vec3(area_vector / length) : area_vector;
}

std::int64_t vertex_count(const Model& model, Row face) {
    return static_cast<std::int64_t>(face_gridpoints(model, face).size());
}

} // namespace

const Fields& face_fields() {
    static const Fields rows{
        {table, "id", "face_id", "block.face.id", "-", "number, from 1; changes when blocks are deleted",
         call<count_from_one>, nullptr},
        {table, "block", "face_block", "block.face.hostblock", "-", "block that it bounds",
         link<rows_of, &Faces::block, ObjectKind::block>, nullptr},
        {table, "joint_set", "face_jset", "block.face.jset", "-", "joint set that cut it, 0 when made with the block",
         read<rows_of, &Faces::joint_set>, nullptr},
        {table, "group", "face_group", "block.face.group", "-", "group that it is in itself, else that of its block",
         read_group<ObjectKind::face>, write_group<ObjectKind::face>},
        {table, "position", "face_pos", "block.face.pos", "length", "centroid", call<face_centroid>, nullptr},
        {table, "x", "face_x", "block.face.pos.x", "length", "x of the centroid", call<face_centroid, 0>, nullptr},
        {table, "y", "face_y", "block.face.pos.y", "length", "y of the centroid", call<face_centroid, 1>, nullptr},
        {table, "z", "face_z", "block.face.pos.z", "length", "z of the centroid", call<face_centroid, 2>, nullptr},
        {table, "normal", "face_n", "block.face.normal", "-", "outward unit normal", call<normal>, nullptr},
        {table, "x_normal", "face_nx", "block.face.normal.x", "-", "x of the normal", call<normal, 0>, nullptr},
        {table, "y_normal", "face_ny", "block.face.normal.y", "-", "y of the normal", call<normal, 1>, nullptr},
        {table, "z_normal", "face_nz", "block.face.normal.z", "-", "z of the normal", call<normal, 2>, nullptr},
        {table, "vertex_count", "face_ngp", "block.face.ngp", "-", "number of gridpoints on it", call<vertex_count>,
         nullptr},
        {table, "area", "face_area", "block.face.area", "area", "area", call<area>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
