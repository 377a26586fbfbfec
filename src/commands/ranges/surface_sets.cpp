#include "commands/ranges/surface_sets.hpp"

#include "commands/ranges/saved_text.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr const char* what = "sets of surfaces";

std::string text_of(const std::map<std::string, PolygonSet>& sets) {
    std::string text = fmt::format("{}\n", sets.size());
    for (const auto& [name, polygons] : sets) {
        text += fmt::format("{} {} {}\n", name.size(), name, polygons.size());
        for (const auto& polygon : polygons) {
            text += fmt::format("{}", polygon.size());
            for (const Vec3& corner : polygon) text += fmt::format(" {:a} {:a} {:a}", corner[0], corner[1], corner[2]);
            text += '\n';
        }
    }
    return text;
}

std::map<std::string, PolygonSet> read_sets(SavedText& text) {
    std::map<std::string, PolygonSet> sets;
    for (std::size_t left = text.count(); left > 0; --left) {
        PolygonSet& polygons = sets[text.name()];
        for (std::size_t more = text.count(); more > 0; --more) {
            auto& polygon = polygons.emplace_back();
            for (std::size_t corners = text.count(); corners > 0; --corners) {
                const double x = text.number(), y = text.number(), z = text.number();
                if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) text.refuse();
                polygon.emplace_back(x, y, z);
            }
            if (polygon.size() < 3) text.refuse();
        }
    }
    return sets;
}

} // namespace

std::string surfaces_text(const SurfaceSets& sets) {
    return text_of(sets.surfaces) + text_of(sets.fractures) + fmt::format("{} {}\n", sets.current.size(), sets.current);
}

SurfaceSets surfaces_from_text(const std::string& saved) {
    SavedText text(saved, what);
    SurfaceSets sets;
    sets.surfaces = read_sets(text);
    sets.fractures = read_sets(text);
    sets.current = text.name();
    return sets;
}

} // namespace kaya
