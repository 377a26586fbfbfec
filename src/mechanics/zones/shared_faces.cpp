#include "mechanics/zones/shared_faces.hpp"

#include "model/edit/ties.hpp"
#include "model/measure/cell_faces.hpp"
#include "model/measure/measure.hpp"

#include <algorithm>
#include <map>

namespace kaya {

namespace {

TriangleCorners sorted(TriangleCorners corners) {
    std::ranges::sort(corners);
    return corners;
}

/// For each corner of a face the area on which a stress makes its force: half of the corner's part of the triangles of the other diagonal,
/// less half of its part of the zones' own. A linear motion makes nothing of it.
std::array<Vec3, 4> areas_of(const Model& model, const SharedFace& face) {
    const auto& x = model.gridpoints.position;
    const auto& [a, b, c, d] = face.corners; // the zones have the diagonal from b to d
    const auto area = [&](Row one, Row two, Row three) {
        return Vec3(triangle_area_vector(x[one], x[two], x[three]) / 6.0);
    };
    // A third of a half of each triangle at a corner: what the two pairs differ by is the triangle of the other corners.
    return {area(b, c, d), -area(a, c, d), area(a, b, d), -area(a, b, c)};
}

/// For one of the two zones at a face: as both have the same part in it.
constexpr double part = 0.5;

} // namespace

void find_shared_faces(const Model& model, ZoneLaws& laws) {
    auto& found = laws.tiles.shared_faces;
    found.clear();
    if (!laws.any(Together::strains_at_points)) return;
    const CellFaces outer(model, tied_faces(model));
    std::map<TriangleCorners, Row> zone_at; // of the triangles of these faces
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t) {
        const Row block = model.faces.block[model.triangles.face[t]], partner = outer.partner(t);
        if (partner == no_row || laws.of_block(block).together != Together::strains_at_points) continue;
        const TriangleCorners &own = model.triangles.gridpoints[t], &other = model.triangles.gridpoints[partner];
        zone_at.emplace(sorted(own), no_row);
        if (partner < t) continue;
        found.push_back({corners_of_face(own, other), {}});
    }
    for (Row z = 0; z < static_cast<Row>(model.zones.size()); ++z)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& g = model.zones.gridpoints[z];
            const auto at = zone_at.find(sorted({g[(k + 1) % 4], g[(k + 2) % 4], g[(k + 3) % 4]}));
            if (at != zone_at.end()) at->second = z;
        }
    for (SharedFace& face : found) {
        const auto& [a, b, c, d] = face.corners;
        face.zones = {zone_at.at(sorted({a, b, d})), zone_at.at(sorted({b, c, d}))};
    }
}

void add_face_strains(const Model& model, const ZoneLaws& laws, SharedStrains& shared) {
    for (const SharedFace& face : laws.tiles.shared_faces) {
        const std::array<Vec3, 4> areas = areas_of(model, face);
        Mat3 sum = Mat3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            sum += part * model.clock.time_step * model.gridpoints.velocity[face.corners[k]] * areas[k].transpose();
        for (const Row z : face.zones) {
            auto& own = shared.own[z];
            const double over = 1 / shared.volume[z];
            for (std::size_t k = 0; k < 3; ++k)
                own[k] += over * sum(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
            own[3] += 0.5 * over * (sum(0, 1) + sum(1, 0));
            own[4] += 0.5 * over * (sum(0, 2) + sum(2, 0));
            own[5] += 0.5 * over * (sum(1, 2) + sum(2, 1));
        }
    }
}

void add_face_forces(const Model& model, const ZoneLaws& laws, const SharedStrains& shared,
                     std::vector<PointRow>& forces) {
    for (const SharedFace& face : laws.tiles.shared_faces) {
        const std::array<Vec3, 4> areas = areas_of(model, face);
        Stress sum = Stress::Zero();
        for (const Row z : face.zones)
            for (Eigen::Index k = 0; k < 6; ++k) sum[k] += part * shared.stress[z][static_cast<std::size_t>(k)];
        const Mat3 stress = matrix_of(sum);
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 force = -(stress * areas[k]);
            // Any of its points: their rows are summed.
            auto& row = forces[*laws.tiles.points_of.begin(face.corners[k])].value;
            for (std::size_t i = 0; i < 3; ++i) row[i] += force[static_cast<Eigen::Index>(i)];
        }
    }
}

} // namespace kaya
