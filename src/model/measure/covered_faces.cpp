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

CoveredFaces::CoveredFaces(const Model& model, const std::vector<FacePair>& tied)
    : model_(model), cover_(model.faces.size(), Cover::none) {
    const auto& contacts = model.contacts;
    std::vector<double> area(model.faces.size(), 0);
    std::vector<Part> all;
    const auto add = [&](const FacePair& pair, const Vec3& normal) {
        for (const Row face : {pair.face1, pair.face2}) {
            if (face == no_row) continue;
            all.push_back({face, pair, normal});
            area[face] += pair.area;
            // The other block has no face opposite: its part of the face is unknown.
            if (pair.face1 == no_row || pair.face2 == no_row) cover_[face] = Cover::whole;
        }
    };
    for (Row c = 0; c < static_cast<Row>(contacts.size()); ++c)
        if (contacts.type[c] == ContactType::face_face)
            add({contacts.face1[c], contacts.face2[c], contacts.area[c]}, contacts.normal[c]);
    for (const FacePair& pair : tied) add(pair, face_area_vector(model, pair.face1).normalized());
    for (const Part& part : all) {
        Cover& cover = cover_[part.face];
        if (cover != Cover::none) continue;
        const bool whole = area[part.face] >= (1 - negligible) * face_area_vector(model, part.face).norm();
        cover = whole ? Cover::whole : Cover::part;
    }
    std::ranges::copy_if(all, std::back_inserter(parts_),
                         [&](const Part& part) { return cover_[part.face] == Cover::part; });
    std::ranges::stable_sort(parts_, {}, &Part::face);
}

const std::vector<std::vector<Vec3>>& CoveredFaces::polygons_on(Row face) const {
    const auto [at, fresh] = polygons_.try_emplace(face);
    if (!fresh) return at->second;
    for (const auto& [own, pair, normal] : std::ranges::equal_range(parts_, face, {}, &Part::face))
        for (auto& polygon : common_polygons(model_, pair.face1, pair.face2, normal))
            at->second.push_back(std::move(polygon));
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

double CoveredFaces::share_of(const std::vector<Corners>& parts, Row triangle) const {
    double covered = 0;
    for (const Corners& part : parts) covered += area_vector(part).norm();
    const double share = covered / triangle_area_vector(model_, triangle).norm();
    return share < negligible ? 0 : share > 1 - negligible ? 1 : share;
}

double CoveredFaces::share(Row triangle) const {
    switch (cover_[model_.triangles.face[triangle]]) {
    case Cover::none: return 0;
    case Cover::whole: return 1;
    case Cover::part: break;
    }
    return share_of(common_parts(triangle), triangle);
}

std::vector<CoveredFaces::Corners> CoveredFaces::parts(Row triangle) const {
    if (cover_[model_.triangles.face[triangle]] != Cover::part) return {};
    auto parts = common_parts(triangle);
    const double covered = share_of(parts, triangle);
    if (covered == 0 || covered == 1) parts.clear();
    return parts;
}

} // namespace kaya
