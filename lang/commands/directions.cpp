#include "lang/commands/directions.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace kaya::lang {

namespace {

Vec3 read_direction(Reader& reader, const ArgumentSpec& spec) {
    const Word* word = reader.peek();
    const Vec3 direction = reader.vector(spec);
    const double length = direction.norm();
    if (!reader.wildcards() && !(length > 0 && std::isfinite(length)))
        throw Diagnostic(fmt::format("({:g}, {:g}, {:g}) is not a direction", direction[0], direction[1], direction[2]),
                         "give a vector of any length but 0, such as 1 1 0")
            .at(word->place);
    return direction;
}

} // namespace

Parts<Vec3> direction(const ArgumentSpec& spec) {
    return Parts<Vec3>().argument(spec).by([spec](Reader& reader, Vec3& to) { to = read_direction(reader, spec); },
                                           [](Parts<Vec3>::Form form, const Vec3& wanted) {
                                               form.after = wanted;
                                               return print_value(form.words, wanted) ? Parts<Vec3>::Forms{form}
                                                                                      : Parts<Vec3>::Forms{};
                                           });
}

void read_local_axes(Reader& reader, const std::array<std::array<double, 6>*, 4>& tensors, const ArgumentSpec& first,
                     const ArgumentSpec& second) {
    const Vec3 a = read_direction(reader, first);
    const Word* word = reader.peek();
    const Vec3 b = read_direction(reader, second);
    bool found = false; // the place of the second vector in the line
    for (const Word& other : reader.statement().words) {
        found = found || &other == word;
        if (!found || other.kind != WordKind::word) continue;
        for (const std::string_view gradient : {"xgradient", "ygradient", "zgradient", "stress"})
            if (other.folded.size() > 2 && gradient.starts_with(other.folded))
                throw Diagnostic(
                    fmt::format("'{}' stands after local, which rotates only what is before it", other.text),
                    "put local after it")
                    .at(other.place);
    }
    if (reader.wildcards()) return;
    constexpr double parallel = 1e-6; // sine of the angle between them
    const Vec3 x = a.normalized(), normal = x.cross(b.normalized());
    if (normal.norm() < parallel)
        throw Diagnostic(
            fmt::format("({:g}, {:g}, {:g}) is parallel to ({:g}, {:g}, {:g})", b[0], b[1], b[2], a[0], a[1], a[2]),
            "the second vector shows in which plane the second axis lies")
            .at(word->place);
    const Vec3 z = normal.normalized();
    Mat3 axes; // as columns
    axes << x, z.cross(x), z;
    for (auto* tensor : tensors) {
        const Stress turned = stress_of(axes * matrix_of(Stress(tensor->data())) * axes.transpose());
        for (std::size_t k = 0; k < 6; ++k) (*tensor)[k] = turned[static_cast<Eigen::Index>(k)];
    }
}

} // namespace kaya::lang
