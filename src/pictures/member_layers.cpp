// add_members.
#include "model/structures/members.hpp"
#include "model/tables/model.hpp"
#include "pictures/colouring.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

/// Elements as lines or triangles, all of one in the colour of its value.
class MemberLayer {
public:
    MemberLayer(const Model& model, const Shown& shown, const Field& field, bool lines)
        : model_(model), shown_(shown), field_(field) {
        layer_.kind = lines ? Layer::Kind::lines : Layer::Kind::triangles;
        if (lines) layer_.width = 5;
    }

    template <std::size_t count> void add(const std::array<Row, count>& nodes, Row element) {
        const auto& table = model_.structures.member_nodes;
        if (shown_.cut)
            for (const Row node : nodes)
                if ((table.position[node] - shown_.cut->origin).dot(shown_.cut->normal) > 0) return;
        const double value = std::get<double>(field_.get(model_, element));
        for (const Row node : nodes) {
            // As blocks: displacements are drawn larger than they are.
            const Vec3 place = table.position[node] + shown_.deformation * table.displacement[node];
            for (int k = 0; k < 3; ++k) layer_.points.push_back(static_cast<float>(place[k]));
            layer_.values.push_back(static_cast<float>(value));
        }
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }

    void finish(Scene& scene, const char* what) {
        if (layer_.points.empty()) return;
        std::string name(field_.name);
        std::ranges::replace(name, '_', ' ');
        layer_.bar = static_cast<std::int32_t>(scene.bars.size());
        scene.bars.push_back(colour_bar(fmt::format("{} of {} [{}]", name, what, field_.unit), low_, high_));
        scene.layers.push_back(std::move(layer_));
    }

private:
    const Model& model_;
    const Shown& shown_;
    const Field& field_;
    Layer layer_;
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

} // namespace

void add_members(Scene& scene, const Model& model, const Shown& shown, ObjectKind kind, const std::string& word) {
    const bool beams = kind == ObjectKind::beam_element;
    MemberLayer layer(model, shown, *find_field(kind, word), beams);
    const auto& structures = model.structures;
    for (Row row = 0; row < static_cast<Row>(count_of(model, kind)); ++row)
        if (beams) layer.add(structures.beams.nodes[row], row);
        else layer.add(structures.liners.nodes[row], row);
    layer.finish(scene, beams ? "beams" : "liners");
}

} // namespace kaya
