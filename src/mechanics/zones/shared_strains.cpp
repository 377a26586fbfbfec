#include "mechanics/zones/shared_strains.hpp"

#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/shared_faces.hpp"

namespace kaya {

void share_strains(const Model& model, const ZoneLaws& laws, SharedStrains& shared) {
    const std::size_t zones = model.zones.size();
    shared.volume.resize(zones);
    for (auto* column : {&shared.own, &shared.strain, &shared.stress}) column->resize(zones);
    for_deformations<Deformation>(model, laws, Together::strains_at_points,
                                  [&](Row z, Row count, const Deformation& d) {
                                      store_rows(shared.volume.data() + z, count, d.volume);
                                      store_six(shared.own[z].data(), 6, count, d.strain);
                                  });
    add_face_strains(model, laws, shared);
    average_at_points(
        laws, Together::strains_at_points, shared.volume, shared.at_point, [&](Row z) { return shared.own[z]; },
        [&](Row z, const SharedStrains::Six& mean) { shared.strain[z] = mean; });
}

void share_stresses(const Model& model, const ZoneLaws& laws, const std::vector<double>& pressure,
                    SharedStrains& shared) {
    const bool damped = zones_are_damped(model), wet = !pressure.empty();
    const auto pressure_of = [&](Row z) {
        double sum = 0;
        for (const Row g : model.zones.gridpoints[z]) sum += pressure[g];
        return 0.25 * sum;
    };
    average_at_points(
        laws, Together::strains_at_points, shared.volume, shared.at_point,
        [&](Row z) {
            SharedStrains::Six stress;
            for (std::size_t k = 0; k < 6; ++k) {
                stress[k] = model.zones.stress[z][static_cast<Eigen::Index>(k)];
                if (damped) stress[k] += model.zones.dashpot[z][static_cast<Eigen::Index>(k)];
                if (wet && k < 3) stress[k] += pressure_of(z);
            }
            return stress;
        },
        [&](Row z, const SharedStrains::Six& mean) {
            shared.stress[z] = mean;
            if (wet)
                for (std::size_t k = 0; k < 3; ++k) shared.stress[z][k] -= pressure_of(z);
        });
}

} // namespace kaya
