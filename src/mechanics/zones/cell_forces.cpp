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

/// The initial stresses of eight cells as a field that changes with depth alone.
struct DepthField {
    Eight3 down;
    SixEights mean, slope; ///< the stress in the middle, and its change with depth
    Eight middle;          ///< the depth there, below corner 0

    Eight depth(const Eight3& place) const { return place.dot(down); }
    static Eight3 traction(const SixEights& s, const Eight3& area) {
        return {s[0] * area.x + s[3] * area.y + s[4] * area.z, s[3] * area.x + s[1] * area.y + s[5] * area.z,
                s[4] * area.x + s[5] * area.y + s[2] * area.z};
    }
    Eight3 divergence() const { return traction(slope, down); }
};

using EdgesOfZones = std::array<Edges, zones_of_cell>;

/// Of zones with such edges, in cells of such places.
DepthField depth_field(const Model& model, const CellField& place, const EdgesOfZones& edges, const SixZones& stress) {
    const Vec3& gravity = model.settings.gravity;
    const double size = gravity.norm();
    const Vec3 down = size > 0 ? Vec3(gravity / size) : Vec3::Zero();
    DepthField field{{eights(down.x()), eights(down.y()), eights(down.z())}, mean_of(stress), {}, {}};
    std::array<Eight, zones_of_cell> depth;
    for (Row z = 0; z < zones_of_cell; ++z) {
        depth[z] = 0.25 * field.depth(edges[z][0] + edges[z][1] + edges[z][2]);
        field.middle += depth[z] * (1.0 / zones_of_cell);
    }
    Eight squares{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Eight d = depth[z] - field.middle;
        squares += d * d;
        for (std::size_t k = 0; k < 6; ++k) field.slope[k] += d * stress[z][k];
    }
    // Zones at the same depth have no slope.
    const Eight3& far = place[6];
    const Eight over = 1.0 / (squares + 1e-12 * far.dot(far));
    for (Eight& s : field.slope) s *= over;
    return field;
}

/// Loads, contacts and quiet boundaries see outer faces as the mean of both diagonals, zones see one. The difference is added: half of the
/// tractions on the triangles of the diagonal of the zones, less half of those of the other diagonal.
class OuterFaces {
public:
    OuterFaces(const CellField& place, const DepthField& field, const std::uint8_t* outer) : field_(field) {
        for (std::size_t l = 0; l < eight; ++l) bits_[l] = outer[l];
        for (std::size_t c = 0; c < 8; ++c) place_[c] = c == 0 ? Eight3{Eight{}, Eight{}, Eight{}} : place[c - 1];
    }
    void add_to(CellForces& forces) const {
        for (std::size_t f = 0; f < 6; ++f) {
            Eight half{};
            bool any = false;
            for (std::size_t l = 0; l < eight; ++l)
                if ((bits_[l] & (1 << f)) != 0) half[l] = f < 3 ? -0.5 : 0.5, any = true; // outward at corner 7
            if (any) add_face(f, half, forces);
        }
    }

private:
    void add_face(std::size_t f, const Eight& half, CellForces& forces) const {
        const std::size_t a = f % 3, b = std::size_t{1} << (a + 1) % 3, c = std::size_t{1} << (a + 2) % 3;
        const std::size_t low = f < 3 ? 0 : std::size_t{1} << a, high = low + b + c;
        add_triangle({low, low + b, high}, half, forces);
        add_triangle({low, high, low + c}, half, forces);
        add_triangle({low, low + b, low + c}, -half, forces);
        add_triangle({low + b, high, low + c}, -half, forces);
    }
    /// The loads at the corners of a triangle of a traction that varies linearly.
    void add_triangle(const std::array<std::size_t, 3>& corners, const Eight& share, CellForces& forces) const {
        const Eight3 &x = place_[corners[0]], &y = place_[corners[1]], &z = place_[corners[2]];
        const Eight3 area = (y - x).cross(z - x) * (0.5 * share);
        const Eight3 mean = DepthField::traction(field_.mean, area), slope = DepthField::traction(field_.slope, area);
        const Eight sum = field_.depth(x + y + z) - 4.0 * field_.middle;
        for (const std::size_t c : corners)
            forces[c] = forces[c] + mean * eights(1.0 / 3) + slope * ((field_.depth(place_[c]) + sum) * (1.0 / 12));
    }

    const DepthField& field_;
    std::array<Eight3, 8> place_;
    std::array<std::uint8_t, eight> bits_;
};

/// Forces of the initial stresses of cells, which balance the weights of their zones. `outer`: see ZoneTiles.
CellForces initial_forces(const Model& model, const CellField& place, const SixZones& stress,
                          const std::uint8_t* outer) {
    CellForces forces{};
    std::array<Eight, 8> share{}; // of the volume
    Eight whole{};
    EdgesOfZones edges;
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Edges& own = edges[z] = edges_of_zone(place, z);
        add_forces_of_zone(own, z, stress[z], forces);
        const Eight volume = own[0].dot(own[1].cross(own[2])) * (1.0 / 6);
        for (const std::size_t c : corners_of_zone[z]) share[c] += 0.25 * volume;
        whole += volume;
    }
    // Stresses that change with depth bear the weights of the zones. A corner bears an eighth of its cell instead: the rest, the difference
    // of volume times the divergence of the stresses, is added.
    const DepthField field = depth_field(model, place, edges, stress);
    const Eight3 divergence = field.divergence();
    for (std::size_t c = 0; c < 8; ++c) forces[c] = forces[c] + divergence * (0.125 * whole - share[c]);
    if (std::any_of(outer, outer + eight, [](std::uint8_t bits) { return bits != 0; }))
        OuterFaces(place, field, outer).add_to(forces);
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
                             const SixZones& initial, const SixEights& strain, const Eight& volume,
                             const std::uint8_t* outer)
    : forces(initial_forces(model, place, initial, outer)) {
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
            of_cells = both(
                of_cells, initial_forces(model, place, load_zones(model.zones.initial, zone, cells), rows.outer(zone)));
        sums.add(corners, cells, of_cells);
    }
}

} // namespace kaya
