#include "model/measure/covered_faces.hpp"

#include "geometry/polyhedra/face_contact.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {

namespace {

constexpr double negligible = 1e-3;

Vec3 area_vector(const CoveredFaces::Corners& x) { return triangle_area_vector(x[0], x[1], x[2]); }

} // namespace

CoveredFaces::CoveredFaces(const Model& model) : model_(model), cover_(model.faces.size(), Cover::none) {
    const auto& contacts = model.contacts;
    std::vector<double> area(model.faces.size(), 0);
    std::vector<std::pair<Row, Row>> all;
    for (Row c = 0; c < static_cast<Row>(contacts.size()); ++c) {
        if (contacts.type[c] != ContactType::face_face) continue;
        const bool both = contacts.face1[c] != no_row && contacts.face2[c] != no_row;
        for (const Row face : {contacts.face1[c], contacts.face2[c]}) {
            if (face == no_row) continue;
            all.emplace_back(face, c);
            area[face] += contacts.area[c];
            // The other block has no face opposite: its part of the face is unknown.
            if (!both) cover_[face] = Cover::whole;
        }
    }
    for (const auto& [face, c] : all) {
        if (cover_[face] != Cover::none) continue;
        const bool whole = area[face] >= (1 - negligible) * face_area_vector(model, face).norm();
        cover_[face] = whole ? Cover::whole : Cover::part;
    }
    std::ranges::copy_if(all, std::back_inserter(face_contact_),
                         [&](const auto& pair) { return cover_[pair.first] == Cover::part; });
    std::ranges::sort(face_contact_);
}

const std::vector<std::vector<Vec3>>& CoveredFaces::polygons_on(Row face) const {
    const auto [at, fresh] = polygons_.try_emplace(face);
    if (fresh)
        for (auto i = std::ranges::lower_bound(face_contact_, std::pair(face, Row{0}));
             i != face_contact_.end() && i->first == face; ++i)
            for (auto& polygon : joint_polygons(model_, i->second)) at->second.push_back(std::move(polygon));
    return at->second;
}

std::vector<CoveredFaces::Corners> CoveredFaces::common_parts(Row triangle) const {
    std::vector<Vec3> outline;
    for (const Row g : model_.triangles.gridpoints[triangle]) outline.push_back(model_.gridpoints.position[g]);
    const Vec3 normal = triangle_area_vector(model_, triangle);
    std::vector<Corners> parts;
    for (const auto& polygon : polygons_on(model_.triangles.face[triangle])) {
        const auto common = common_part(polygon, outline, normal);
        for (std::size_t k = 1; k + 1 < common.size(); ++k) {
            Corners part{common[0], common[k], common[k + 1]};
            if (area_vector(part).dot(normal) < 0) std::swap(part[1], part[2]);
            parts.push_back(part);
        }
    }
    return parts;
}

double CoveredFaces::share(Row triangle) const {
    switch (cover_[model_.triangles.face[triangle]]) {
    case Cover::none: return 0;
    case Cover::whole: return 1;
    case Cover::part: break;
    }
    double covered = 0;
    for (const Corners& part : common_parts(triangle)) covered += area_vector(part).norm();
    const double share = covered / triangle_area_vector(model_, triangle).norm();
    return share < negligible ? 0 : share > 1 - negligible ? 1 : share;
}

std::vector<CoveredFaces::Corners> CoveredFaces::parts(Row triangle) const {
    const double covered = share(triangle);
    return covered > 0 && covered < 1 ? common_parts(triangle) : std::vector<Corners>{};
}

} // namespace kaya
