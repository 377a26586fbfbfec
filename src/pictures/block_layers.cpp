// add_blocks: surfaces, the faces that a cut makes, and edges.
#include "model/measure/held.hpp"
#include "pictures/colouring.hpp"
#include "pictures/half_space.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace kaya {

namespace {

/// Whether nothing can move a block, and nothing has.
bool stands_held(const Model& model, Row block) {
    const auto& g = model.gridpoints;
    const Span points = model.blocks.gridpoints[block];
    for (Row point = points.first; point < points.end(); ++point)
        if (!g.displacement[point].isZero(0) || !g.velocity[point].isZero(0)) return false;
    return is_held(model, block);
}

class BlockPainter {
public:
    BlockPainter(const Model& model, const Shown& shown, Colouring* colouring)
        : model_(model), shown_(shown), colouring_(colouring) {}

    void add(Row block) {
        block_ = block;
        block_value_ =
            colouring_ != nullptr && colouring_->table() == ObjectKind::block ? colouring_->value(model_, block) : 0;
        held_ = colouring_ != nullptr && colouring_->of_motion() && stands_held(model_, block);
        zone_of_face_.clear();
        if (colouring_ != nullptr && colouring_->table() == ObjectKind::zone) find_zones();
        rim_.clear();
        const Span faces = model_.blocks.faces[block];
        for (Row face = faces.first; face < faces.end(); ++face) add_face(face);
        if (shown_.cut) add_cut_face();
    }

    Layer surface, edges;

private:
    /// The zone below each triangle of the surface, by the three gridpoints.
    void find_zones() {
        const Span zones = model_.blocks.zones[block_];
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            const auto& corner = model_.zones.gridpoints[zone];
            for (std::size_t left_out = 0; left_out < 4; ++left_out) {
                std::array<Row, 3> key{};
                for (std::size_t i = 0, k = 0; i < 4; ++i)
                    if (i != left_out) key[k++] = corner[i];
                std::ranges::sort(key);
                zone_of_face_[key] = zone;
            }
        }
    }

    float zone_value(Row zone) {
        return zone == no_row ? colouring_->grey("no value") : colouring_->value(model_, zone);
    }

    Corner corner(Row gridpoint, float value) {
        const auto& g = model_.gridpoints;
        Corner result{g.position[gridpoint] + shown_.deformation * g.displacement[gridpoint], value};
        if (colouring_ != nullptr && colouring_->table() == ObjectKind::gridpoint)
            result.value = held_ ? colouring_->grey("held") : colouring_->value(model_, gridpoint);
        return result;
    }

    void add_face(Row face) {
        std::set<std::pair<Row, Row>> sides; // edges without a counterpart in the other direction
        const Span triangles = model_.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            const auto& ids = model_.triangles.gridpoints[t];
            add_triangle(ids);
            for (std::size_t k = 0; k < 3; ++k) {
                const Row from = ids[k], to = ids[(k + 1) % 3];
                if (sides.erase({to, from}) == 0) sides.emplace(from, to);
            }
        }
        for (const auto& [from, to] : sides) {
            const Corner a = corner(from, 0), b = corner(to, 0);
            const Polygon line = shown_.cut ? kept_line(a, b, *shown_.cut) : Polygon{a, b};
            if (line.size() == 2) add_line(edges, line[0], line[1]);
        }
    }

    void add_triangle(const std::array<Row, 3>& ids) {
        float value = block_value_;
        if (colouring_ != nullptr && colouring_->table() == ObjectKind::zone) {
            std::array<Row, 3> key = ids;
            std::ranges::sort(key);
            const auto found = zone_of_face_.find(key);
            value = zone_value(found == zone_of_face_.end() ? no_row : found->second);
        }
        const Polygon triangle{corner(ids[0], value), corner(ids[1], value), corner(ids[2], value)};
        if (!shown_.cut) return add_polygon(surface, triangle);
        const Polygon kept = kept_part(triangle, *shown_.cut);
        add_polygon(surface, kept);
        // The part of the triangle on the plane is an edge of the face that the cut makes.
        Polygon on_plane;
        for (const Corner& c : kept)
            if (std::abs((c.place - shown_.cut->origin).dot(shown_.cut->normal)) <= 1e-9 * (1 + c.place.norm()))
                on_plane.push_back(c);
        if (on_plane.size() != 2) return;
        add_line(edges, on_plane[0], on_plane[1]);
        rim_.insert(rim_.end(), on_plane.begin(), on_plane.end());
    }

    void add_cut_face() {
        const Span zones = model_.blocks.zones[block_];
        if (zones.count == 0) {
            put_in_order(rim_, shown_.cut->normal);
            return add_polygon(surface, rim_);
        }
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            const float value =
                colouring_ != nullptr && colouring_->table() == ObjectKind::zone ? zone_value(zone) : block_value_;
            std::array<Corner, 4> corners;
            for (std::size_t k = 0; k < 4; ++k) corners[k] = corner(model_.zones.gridpoints[zone][k], value);
            add_polygon(surface, slice_of(corners, *shown_.cut));
        }
    }

    const Model& model_;
    const Shown& shown_;
    Colouring* colouring_;
    Row block_ = 0;
    float block_value_ = 0;
    bool held_ = false;
    std::map<std::array<Row, 3>, Row> zone_of_face_;
    Polygon rim_;
};

} // namespace

void add_blocks(Scene& scene, const Model& model, const Shown& shown, const std::optional<ColourField>& field) {
    std::optional<Colouring> colouring;
    if (field) colouring.emplace(*field);
    BlockPainter painter(model, shown, colouring ? &*colouring : nullptr);
    for (const Row block : shown.blocks) painter.add(block);
    painter.surface.colour = {0.83F, 0.80F, 0.74F};
    if (colouring) {
        painter.surface.bar = static_cast<std::int32_t>(scene.bars.size());
        scene.bars.push_back(colouring->bar());
    }
    painter.edges.kind = Layer::Kind::lines;
    painter.edges.colour = {0.12F, 0.12F, 0.12F};
    // Edges of thousands of blocks would hide the blocks.
    painter.edges.width = shown.blocks.size() > 2000 ? 0.6F : 1.2F;
    painter.edges.opacity = shown.blocks.size() > 2000 ? 0.45F : 0.85F;
    painter.edges.values.clear();
    scene.layers.push_back(std::move(painter.surface));
    scene.layers.push_back(std::move(painter.edges));
}

} // namespace kaya
