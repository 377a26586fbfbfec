#include "mechanics/zones/cell_forces.hpp"

#include "mechanics/contact/dashpots.hpp"

#include <algorithm>

namespace kaya {

namespace {

void load_viscous_warps(const Zones& zones, Row zone, Row cells, WarpStress& viscous) {
    viscous.fill(Eight{});
    if (zones.keeps_warp_dashpots) load_warps(zones.warp_dashpot, zone, cells, viscous); // not before the first step
}

/// Of cells whose zones strain together: the first zone stands for all.
MadeStress of_one_zone(const Model& model, Row zone, Row cells, bool initial) {
    const Zones& zones = model.zones;
    MadeStress made;
    made.mean = load_six(zones.stress[zone].data(), to_next_cell, cells);
    if (initial) made.mean = difference(made.mean, load_six(zones.initial[zone].data(), to_next_cell, cells));
    load_warps(zones.warp, zone, cells, made.warp);
    if (!zones_are_damped(model)) return made;
    made.mean = sum(made.mean, load_six(zones.dashpot[zone].data(), to_next_cell, cells));
    WarpStress viscous;
    load_viscous_warps(zones, zone, cells, viscous);
    made.warp = added(made.warp, 1, viscous);
    return made;
}

/// Of cells whose zones flow.
MadeStress of_layers(const Model& model, const CellShape& shape, const ZoneLaw& law, Row zone, Row cells,
                     bool initial) {
    const Zones& zones = model.zones;
    SixZones stress = load_zones(zones.stress, zone, cells);
    WarpStress kept, viscous{};
    load_warps(zones.warp, zone, cells, kept);
    if (zones_are_damped(model)) {
        stress = sum(stress, load_zones(zones.dashpot, zone, cells));
        load_viscous_warps(zones, zone, cells, viscous);
    }
    if (initial) stress = difference(stress, load_zones(zones.initial, zone, cells));
    MadeStress made = made_stress(planes_of(shape.axis, law.elastic), stress);
    for (std::size_t k = 9; k < 12; ++k) made.warp[k] = kept[k] + viscous[k];
    return made;
}

/// Forces of the initial stresses of cells, which balance the weights of their zones.
CellForces initial_forces(const Model& model, const CellField& place, const SixZones& stress) {
    CellForces forces{};
    std::array<Eight, 8> share{}; // of the volume
    std::array<Eight, zones_of_cell> depth;
    const Vec3& gravity = model.settings.gravity;
    const double size = gravity.norm();
    const Vec3 down = size > 0 ? Vec3(gravity / size) : Vec3::Zero();
    Eight whole{}, mean_depth{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Edges edges = edges_of_zone(place, z);
        add_forces_of_zone(edges, z, stress[z], forces);
        const Eight volume = edges[0].dot(edges[1].cross(edges[2])) * (1.0 / 6);
        for (const std::size_t c : corners_of_zone[z]) share[c] += 0.25 * volume;
        const Eight3 sum = edges[0] + edges[1] + edges[2];
        depth[z] = 0.25 * (sum.x * down.x() + sum.y * down.y() + sum.z * down.z());
        whole += volume;
        mean_depth += depth[z] * (1.0 / zones_of_cell);
    }
    // Stresses that change with depth bear the weights of the zones. A corner bears an eighth of its cell instead: the rest, the difference
    // of volume times the divergence of the stresses, is added.
    Eight squares{};
    SixEights slope{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Eight d = depth[z] - mean_depth;
        squares += d * d;
        for (std::size_t k = 0; k < 6; ++k) slope[k] += d * stress[z][k];
    }
    // Zones at the same depth have no slope.
    const Eight3& far = place[6];
    const Eight over = 1.0 / (squares + 1e-12 * far.dot(far));
    const double x = down.x(), y = down.y(), z = down.z();
    const Eight3 divergence =
        Eight3{slope[0] * x + slope[3] * y + slope[4] * z, slope[3] * x + slope[1] * y + slope[5] * z,
               slope[4] * x + slope[5] * y + slope[2] * z} *
        over;
    for (std::size_t c = 0; c < 8; ++c) forces[c] = forces[c] + divergence * (0.125 * whole - share[c]);
    return forces;
}

} // namespace

bool has_initial(const Zones& zones, Row zone, Row cells) {
    if (!zones.keeps_initial) return false;
    const double* const first = zones.initial[zone].data();
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(to_next_cell) * cells,
                       [](double s) { return s != 0; });
}

InitialForces::InitialForces(const Model& model, const CellShape& shape, const CellField& place, const CellField& shift,
                             const SixZones& initial, const SixEights& strain, const Eight& volume)
    : forces(initial_forces(model, place, initial)) {
    SixEights mean = mean_of(initial);
    work = volume * product(mean, strain);
    for (Eight& s : mean) s *= -1;
    // The forces are the same before and after the step.
    const CellForces beyond = both(forces, forces_of(shape, mean, WarpStress{}));
    for (std::size_t c = 1; c < 8; ++c) work -= beyond[c].dot(shift[c - 1]);
}

void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces) {
    const TileRows rows(model, tiles, tile);
    TileForces sums(tile, forces);
    for (Row zone = tile.first; zone < tile.last; zone += zones_of_group) {
        const Row cells = cells_from(zone, tile.last);
        const CellGroupCorners corners = rows.cells_at(zone);
        const CellField place = from_first(rows.places(), corners);
        const CellShape shape(place, RuledFaces(rows.ruled(zone)));
        const bool initial = has_initial(model.zones, zone, cells);
        const auto [mean, warp] = law.together == Together::flow_in_cells
                                      ? of_layers(model, shape, law, zone, cells, initial)
                                      : of_one_zone(model, zone, cells, initial);
        CellForces of_cells = forces_of(shape, mean, warp);
        if (initial)
            of_cells = both(of_cells, initial_forces(model, place, load_zones(model.zones.initial, zone, cells)));
        sums.add(corners, cells, of_cells);
    }
}

} // namespace kaya
