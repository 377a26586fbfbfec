// Quantities of zones. Stress: compression negative.
#include "model/fields/field_rows.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/water.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::zone;
constexpr auto rows_of = &Model::zones;

/// The material of the zone's block; one without properties when `prop mat` did not give it.
const Material& material_of(const Model& model, Row zone) {
    static const Material none;
    const auto found = model.materials.find(model.blocks.material[model.zones.block[zone]]);
    return found == model.materials.end() ? none : found->second;
}

std::int64_t material(const Model& model, Row zone) { return model.blocks.material[model.zones.block[zone]]; }
double mass(const Model& model, Row zone) { return material_of(model, zone).density * model.zones.volume[zone]; }
/// A modulus that `zone` or `block zone property` gave to the zone model, else that of the material.
double modulus(const Model& model, Row zone, const char* name, double Material::*member) {
    const Row block = model.zones.block[zone];
    const auto& own = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])].values;
    const auto given = own.find(name);
    return given != own.end() ? given->second : material_of(model, zone).*member;
}
double bulk(const Model& model, Row zone) { return modulus(model, zone, "bulk", &Material::bulk); }
double pore_pressure(const Model& model, Row zone) { return WaterPressure(model).of_zone(zone); }
/// The symmetric part of the gradient of displacements or velocities, with the corners where they were when the zones were
/// made.
Mat3 strain_of(const Model& model, Row zone, const Column<Vec3>& motion) {
    const auto& corner = model.zones.gridpoints[zone];
    const auto& x = model.gridpoints.reference;
    Mat3 edges, shifts;
    for (int k = 0; k < 3; ++k) {
        edges.col(k) = x[corner[k + 1]] - x[corner[0]];
        shifts.col(k) = motion[corner[k + 1]] - motion[corner[0]];
    }
    const Mat3 gradient = shifts * edges.inverse();
    return 0.5 * (gradient + gradient.transpose());
}
double greatest_shear(const Mat3& strain) {
    const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(strain, Eigen::EigenvaluesOnly).eigenvalues();
    return 0.5 * (principal[2] - principal[0]);
}
double volumetric_strain(const Model& model, Row zone) {
    return strain_of(model, zone, model.gridpoints.displacement).trace();
}
double volumetric_strain_rate(const Model& model, Row zone) {
    return strain_of(model, zone, model.gridpoints.velocity).trace();
}
double shear_strain(const Model& model, Row zone) {
    return greatest_shear(strain_of(model, zone, model.gridpoints.displacement));
}
double shear_strain_rate(const Model& model, Row zone) {
    return greatest_shear(strain_of(model, zone, model.gridpoints.velocity));
}
FieldValue model_name(const Model& model, Row zone) {
    const Row block = model.zones.block[zone];
    const auto& given = model.zone_properties[static_cast<std::size_t>(model.blocks.zone_properties[block])];
    if (!given.model.empty()) return given.model;
    return std::string(model.blocks.constitutive[block] == 2 ? "mohr-coulomb" : "elastic");
}
FieldValue state(const Model& model, Row zone) { return static_cast<std::int64_t>(model.zones.state[zone]); }
/// The first two history variables of plastic models.
double plastic_shear(const Model& model, Row zone) {
    return model.zones.history_columns > 0 ? model.zones.history[0][zone] : 0;
}
double plastic_tension(const Model& model, Row zone) {
    return model.zones.history_columns > 1 ? model.zones.history[1][zone] : 0;
}
double shear(const Model& model, Row zone) { return modulus(model, zone, "shear", &Material::shear); }

} // namespace

const Fields& zone_fields() {
    static const Fields rows{
        {table, "id", "z_id", "block.zone.id", "-", "number, from 1; changes when blocks are deleted",
         call<count_from_one>, nullptr},
        {table, "block", "z_block", "block.zone.hostblock", "-", "block that it belongs to",
         link<rows_of, &Zones::block, ObjectKind::block>, nullptr},
        {table, "position", "z_cen", "block.zone.pos", "length", "centroid", call<zone_centroid>, nullptr},
        {table, "x", "z_x", "block.zone.pos.x", "length", "x of the centroid", call<zone_centroid, 0>, nullptr},
        {table, "y", "z_y", "block.zone.pos.y", "length", "y of the centroid", call<zone_centroid, 1>, nullptr},
        {table, "z", "z_z", "block.zone.pos.z", "length", "z of the centroid", call<zone_centroid, 2>, nullptr},
        {table, "volume", "z_vol", "block.zone.vol", "volume", "volume as it is now", call<zone_volume>, nullptr},
        {table, "mass", "z_mass", "block.zone.mass", "mass",
         "density times the volume when made, NaN without a density", call<mass>, nullptr},
        {table, "group", "z_group", "block.zone.group", "-", "group that it is in itself, else that of its block",
         read_group<ObjectKind::zone>, write_group<ObjectKind::zone>},
        {table, "model", "z_model", "block.zone.model", "-", "name of its zone model", model_name, nullptr},
        {table, "state", "z_state", "block.zone.state", "-",
         "bits of its state, which its zone model names; elastic zones have none", state, nullptr},
        {table, "plastic_shear_strain", "z_psh", "", "-",
         "first history variable of its zone model: plastic shear strain of those that ship", call<plastic_shear>,
         nullptr},
        {table, "plastic_tensile_strain", "z_pte", "", "-",
         "second history variable of its zone model: plastic strain by the tension cut-off of those that ship",
         call<plastic_tension>, nullptr},
        {table, "material", "z_mat", "", "-", "number of its material", call<material>, nullptr},
        {table, "bulk", "z_bulk", "", "stress", "bulk modulus, NaN when not given", call<bulk>, nullptr},
        {table, "shear", "z_shear", "", "stress", "shear modulus, NaN when not given", call<shear>, nullptr},
        {table, "xx_stress", "z_sxx", "block.zone.stress.xx", "stress", "xx stress", read<rows_of, &Zones::stress, 0>,
         write<rows_of, &Zones::stress, 0>},
        {table, "yy_stress", "z_syy", "block.zone.stress.yy", "stress", "yy stress", read<rows_of, &Zones::stress, 1>,
         write<rows_of, &Zones::stress, 1>},
        {table, "zz_stress", "z_szz", "block.zone.stress.zz", "stress", "zz stress", read<rows_of, &Zones::stress, 2>,
         write<rows_of, &Zones::stress, 2>},
        {table, "xy_stress", "z_sxy", "block.zone.stress.xy", "stress", "xy stress", read<rows_of, &Zones::stress, 3>,
         write<rows_of, &Zones::stress, 3>},
        {table, "xz_stress", "z_sxz", "block.zone.stress.xz", "stress", "xz stress", read<rows_of, &Zones::stress, 4>,
         write<rows_of, &Zones::stress, 4>},
        {table, "yz_stress", "z_syz", "block.zone.stress.yz", "stress", "yz stress", read<rows_of, &Zones::stress, 5>,
         write<rows_of, &Zones::stress, 5>},
        {table, "pore_pressure", "z_pp", "block.zone.pp", "stress", "mean water pressure at its gridpoints",
         call<pore_pressure>, nullptr},
        {table, "volumetric_strain", "z_vsi", "block.zone.strain.vol.inc", "-",
         "volumetric strain by the displacements of its gridpoints", call<volumetric_strain>, nullptr},
        {table, "volumetric_strain_rate", "z_vsr", "block.zone.strain.vol.rate", "1/time",
         "the same by their velocities", call<volumetric_strain_rate>, nullptr},
        {table, "shear_strain", "z_ssi", "block.zone.strain.shear.inc", "-",
         "half the difference of largest and smallest principal strain, by the displacements of its gridpoints",
         call<shear_strain>, nullptr},
        {table, "shear_strain_rate", "z_ssr", "block.zone.strain.shear.rate", "1/time", "the same by their velocities",
         call<shear_strain_rate>, nullptr},
        {table, "principal_stress_1", "z_sig1", "block.zone.stress.prin.min", "stress",
         "most compressive principal stress", call<principal_stresses, 0>, nullptr},
        {table, "principal_stress_2", "z_sig2", "block.zone.stress.int", "stress", "middle principal stress",
         call<principal_stresses, 1>, nullptr},
        {table, "principal_stress_3", "z_sig3", "block.zone.stress.prin.max", "stress",
         "least compressive principal stress", call<principal_stresses, 2>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
