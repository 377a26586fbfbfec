#include "slopes/section.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace kaya {

namespace {

/// Height of the upper and the lower edge of a convex polygon at a distance; none outside of it.
std::optional<std::array<double, 2>> heights_at(const std::vector<SectionPoint>& corners, double distance) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const SectionPoint& a = corners[i];
        const SectionPoint& b = corners[(i + 1) % corners.size()];
        if ((a.x() < distance && b.x() < distance) || (a.x() > distance && b.x() > distance)) continue;
        const double part = a.x() == b.x() ? 0 : (distance - a.x()) / (b.x() - a.x());
        const double z = a.y() + part * (b.y() - a.y());
        low = std::min(low, z), high = std::max(high, z);
        if (a.x() == b.x()) low = std::min(low, b.y()), high = std::max(high, b.y());
    }
    if (!(high >= low)) return std::nullopt;
    return std::array{low, high};
}

double between(double left, double right, double part) { return left + part * (right - left); }

} // namespace

SlopeColumns::SlopeColumns(const SlopeSection& section) : section_(section) {
    std::vector<double> marks;
    double low = INFINITY, high = -INFINITY;
    for (const SectionCell& cell : section.cells)
        for (const SectionPoint& corner : cell.corners) {
            marks.push_back(corner.x());
            low = std::min(low, corner.y()), high = std::max(high, corner.y());
        }
    if (marks.empty()) throw Diagnostic("the section cuts no block", "give another place or direction of the section");
    std::ranges::sort(marks);
    lowest_ = low;
    near_ = 1e-9 * (marks.back() - marks.front() + high - low);
    std::vector<double> kept;
    for (const double mark : marks)
        if (kept.empty() || mark - kept.back() > near_) kept.push_back(mark);
    std::vector<std::vector<std::size_t>> cells_of(kept.size());
    for (std::size_t c = 0; c < section.cells.size(); ++c) {
        double from = INFINITY, to = -INFINITY;
        for (const SectionPoint& corner : section.cells[c].corners)
            from = std::min(from, corner.x()), to = std::max(to, corner.x());
        const auto first = std::ranges::lower_bound(kept, from - 2 * near_) - kept.begin();
        for (std::size_t k = static_cast<std::size_t>(first); k + 1 < kept.size() && kept[k] < to - 2 * near_; ++k)
            if (0.5 * (kept[k] + kept[k + 1]) > from) cells_of[k].push_back(c);
    }
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        Strip strip{kept[k], kept[k + 1], {}};
        const double quarter = 0.25 * (strip.to - strip.from);
        for (const std::size_t c : cells_of[k]) {
            // Edges are straight between corners: two points within the strip determine their ends, without rounding errors at the corners.
            const auto one = heights_at(section.cells[c].corners, strip.from + quarter),
                       two = heights_at(section.cells[c].corners, strip.to - quarter);
            if (!one || !two) continue;
            const auto at = [](double a, double b) { return std::array{1.5 * a - 0.5 * b, 1.5 * b - 0.5 * a}; };
            const auto top = at((*one)[1], (*two)[1]), bottom = at((*one)[0], (*two)[0]);
            strip.layers.push_back({c, top[0], top[1], bottom[0], bottom[1]});
        }
        if (strip.layers.empty()) {
            if (strips_.empty()) continue;
            throw Diagnostic("the section has a gap",
                             "slip surfaces need blocks from one end of the section to the other");
        }
        std::ranges::sort(strip.layers, [](const Layer& a, const Layer& b) {
            return a.top_left + a.top_right > b.top_left + b.top_right;
        });
        const Layer& top = strip.layers.front();
        if (ground_.empty() || std::abs(ground_.back().y() - top.top_left) > near_)
            ground_.emplace_back(strip.from, top.top_left);
        ground_.emplace_back(strip.to, top.top_right);
        strips_.push_back(std::move(strip));
    }
    if (strips_.empty())
        throw Diagnostic("the section cuts no block", "give another place or direction of the section");
}

const SlopeColumns::Strip* SlopeColumns::strip_at(double distance) const {
    if (distance < left() - near_ || distance > right() + near_) return nullptr;
    const auto next = std::ranges::upper_bound(strips_, distance, {}, &Strip::from);
    return next == strips_.begin() ? &strips_.front() : &*(next - 1);
}

std::optional<double> SlopeColumns::ground_at(double distance, Side side) const {
    const Strip* strip = strip_at(distance);
    if (strip == nullptr) return std::nullopt;
    if (side == Side::left && distance - strip->from < near_ && strip != &strips_.front()) --strip;
    const Layer& top = strip->layers.front();
    return between(top.top_left, top.top_right,
                   std::clamp((distance - strip->from) / (strip->to - strip->from), 0.0, 1.0));
}

SlopeColumns::Column SlopeColumns::column(const SectionPoint& base) const {
    Column sum;
    const Strip* strip = strip_at(base.x());
    if (strip == nullptr) return sum;
    const double part = std::clamp((base.x() - strip->from) / (strip->to - strip->from), 0.0, 1.0);
    for (const Layer& layer : strip->layers) {
        const double top = between(layer.top_left, layer.top_right, part);
        if (top <= base.y()) break;
        const double bottom = std::max(base.y(), between(layer.bottom_left, layer.bottom_right, part));
        const double weight = section_.cells[layer.cell].unit_weight * (top - bottom);
        sum.weight += weight;
        sum.moment += weight * (0.5 * (top + bottom) - base.y());
    }
    return sum;
}

std::vector<SlopeColumns::Base> SlopeColumns::bases_of_weak_layers() const {
    std::vector<Base> bases;
    const auto strength_under = [&](const Layer& layer, double stress) {
        const Strength& strength = section_.strengths[section_.cells[layer.cell].strength];
        return strength.fails() ? strength.tangent(stress).at(stress) : INFINITY;
    };
    for (const Strip& strip : strips_)
        for (std::size_t i = 1; i < strip.layers.size(); ++i) {
            const Layer &weak = strip.layers[i - 1], &strong = strip.layers[i];
            const SectionPoint from(strip.from, weak.bottom_left), to(strip.to, weak.bottom_right);
            const double stress = column(0.5 * (from + to)).weight;
            if (strength_under(weak, stress) < strength_under(strong, stress)) bases.push_back({from, to});
        }
    return bases;
}

const Strength* SlopeColumns::strength_at(const SectionPoint& place, const SectionPoint& along) const {
    const std::span<const SectionJoint> joints = along.isZero() ? std::span<const SectionJoint>() : section_.joints;
    for (const SectionJoint& joint : joints) {
        const SectionPoint line = joint.to - joint.from, to_place = place - joint.from;
        const double length = line.norm();
        if (!(length > near_)) continue;
        const auto cross = [](const SectionPoint& a, const SectionPoint& b) { return a.x() * b.y() - a.y() * b.x(); };
        const double part = line.dot(to_place) / (length * length);
        // Numbers of a deck have six digits or so.
        if (part < 0 || part > 1 || std::abs(cross(line, to_place)) / length > 1e5 * near_) continue;
        if (std::abs(cross(line, along)) < 1e-3 * length * along.norm()) return &section_.strengths[joint.strength];
    }
    const Strip* strip = strip_at(place.x());
    if (strip == nullptr) return nullptr;
    const double part = std::clamp((place.x() - strip->from) / (strip->to - strip->from), 0.0, 1.0);
    for (const Layer& layer : strip->layers)
        if (place.y() >= between(layer.bottom_left, layer.bottom_right, part) - near_)
            return &section_.strengths[section_.cells[layer.cell].strength];
    return nullptr;
}

std::optional<SlipSurface> circle_surface(const SlopeColumns& columns, const SectionPoint& centre, double radius) {
    // Where the ground passes from above the circle to below it, on either side of the lowest point.
    std::vector<double> crossings;
    const auto& ground = columns.ground();
    for (std::size_t i = 0; i + 1 < ground.size(); ++i) {
        const SectionPoint from = ground[i] - centre, along = ground[i + 1] - ground[i];
        const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
        const double root = b * b - a * c;
        if (!(a > 0) || !(root > 0)) continue;
        for (const double sign : {-1.0, 1.0}) {
            const double part = (-b + sign * std::sqrt(root)) / a;
            const double height = from.y() + part * along.y();
            if (part >= 0 && part < 1 && height <= 0) crossings.push_back(ground[i].x() + part * along.x());
        }
    }
    std::ranges::sort(crossings);
    // The deepest part of the circle.
    std::optional<std::array<double, 2>> best;
    double deepest = 0;
    const auto height = [&](double x) {
        return centre.y() - std::sqrt(std::max(0.0, radius * radius - (x - centre.x()) * (x - centre.x())));
    };
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        double depth = 0;
        for (int k = 1; k < 8; ++k) {
            const double x = between(crossings[i], crossings[i + 1], k / 8.0);
            depth = std::max(depth, columns.ground_at(x).value_or(-INFINITY) - height(x));
        }
        if (depth > deepest) deepest = depth, best = {crossings[i], crossings[i + 1]};
    }
    if (!best || !(deepest > 1e-6 * radius)) return std::nullopt;
    const auto angle = [&](double x) { return std::asin(std::clamp((x - centre.x()) / radius, -1.0, 1.0)); };
    const double first = angle((*best)[0]), last = angle((*best)[1]);
    SlipSurface surface;
    surface.circle = SlipSurface::Circle{centre, radius};
    constexpr int pieces = 64;
    for (int k = 0; k <= pieces; ++k) {
        const double a = between(first, last, static_cast<double>(k) / pieces);
        surface.points.emplace_back(centre.x() + radius * std::sin(a), centre.y() - radius * std::cos(a));
        if (surface.points.back().y() < columns.lowest()) return std::nullopt;
    }
    return surface;
}

namespace {

/// Height of a surface at a distance; exact for a circle.
double surface_height(const SlipSurface& surface, double x) {
    if (surface.circle) {
        const double d = x - surface.circle->centre.x();
        return surface.circle->centre.y() -
               std::sqrt(std::max(0.0, surface.circle->radius * surface.circle->radius - d * d));
    }
    const auto& points = surface.points;
    const auto next = std::ranges::upper_bound(points, x, {}, [](const SectionPoint& p) { return p.x(); });
    const std::size_t i = next == points.end()
                              ? points.size() - 1
                              : std::max<std::size_t>(1, static_cast<std::size_t>(next - points.begin()));
    const SectionPoint &a = points[i - 1], &b = points[i];
    return b.x() == a.x() ? a.y() : between(a.y(), b.y(), (x - a.x()) / (b.x() - a.x()));
}

/// The point, from the upper end on, where the depth of the surface is less than that of the crack.
double crack_end(const SlopeColumns& columns, const SlipSurface& surface, double upper, double lower) {
    const double depth = columns.section().crack_depth;
    const SlopeColumns::Side side = upper < lower ? SlopeColumns::Side::right : SlopeColumns::Side::left;
    const auto covered = [&](double x) {
        return columns.ground_at(x, side).value_or(-INFINITY) - surface_height(surface, x) >= depth;
    };
    constexpr int steps = 400;
    for (int k = 1; k <= steps; ++k) {
        double out = between(upper, lower, (k - 1.0) / steps),
               in = between(upper, lower, static_cast<double>(k) / steps);
        if (!covered(in)) continue;
        for (int i = 0; i < 60; ++i) (covered(0.5 * (out + in)) ? in : out) = 0.5 * (out + in);
        return in;
    }
    return lower;
}

/// Cuts the body above a slip surface, from x = first to last, into slices.
class Slicer {
public:
    Slicer(const SlopeColumns& columns, const SlipSurface& surface, double first, double last, bool rightward)
        : columns_(columns), section_(columns.section()), surface_(surface), first_(first), last_(last),
          sense_(rightward ? 1 : -1),
          chord_(last - first, surface_height(surface, last) - surface_height(surface, first)) {}

    /// Slices end where the ground or the surface bends, so that both are straight over each of them.
    std::vector<double> ends(int slices) const {
        std::vector<double> marks;
        for (int k = 0; k <= slices; ++k) marks.push_back(between(first_, last_, static_cast<double>(k) / slices));
        const double least = 1e-3 * (last_ - first_) / slices;
        const auto add = [&](double x) {
            if (x > first_ + least && x < last_ - least) marks.push_back(x);
        };
        for (const SectionPoint& point : columns_.ground()) add(point.x());
        for (const SectionTraction& traction : section_.tractions) add(traction.from.x()), add(traction.to.x());
        if (!surface_.circle)
            for (const SectionPoint& point : surface_.points) add(point.x());
        std::ranges::sort(marks);
        marks.erase(std::unique(marks.begin(), marks.end(), [&](double a, double b) { return b - a < least; }),
                    marks.end());
        marks.back() = last_;
        return marks;
    }

    /// The middle of the base of the slice between two places.
    SectionPoint base(double from, double to) const { return 0.5 * (on_surface(from) + on_surface(to)); }

    /// None when the slice has no ground above it, or no known material below.
    std::optional<Slice> slice(double from, double to) const {
        const SectionPoint a = on_surface(from), b = on_surface(to), base = 0.5 * (a + b);
        const double middle = 0.5 * (from + to);
        const auto top = columns_.ground_at(middle);
        if (!top || *top < base.y() - 1e-9 * chord_.norm() || base.y() < columns_.lowest() - 1e-9 * chord_.norm())
            return std::nullopt;
        const SlopeColumns::Column column = columns_.column(base);
        Slice slice;
        slice.width = to - from;
        slice.base_angle = sense_ * std::atan2(a.y() - b.y(), to - from);
        slice.weight = column.weight * slice.width;
        slice.centroid_arm = column.weight > 0 ? column.moment / column.weight : 0;
        slice.pore_pressure = pressure(base) + section_.pressure_ratio * column.weight;
        slice.strength = columns_.strength_at(base, surface_.circle ? SectionPoint::Zero() : SectionPoint(b - a));
        if (slice.strength == nullptr) return std::nullopt;
        const double covered = add_loads(slice, from, to, base);
        add_open_water(slice, from, to, {middle, *top}, base, 1 - covered);
        return slice;
    }

    /// Distance of the middle of a base from the chord.
    double depth(const SectionPoint& base) const {
        const SectionPoint off = base - SectionPoint(first_, surface_height(surface_, first_));
        return std::abs(chord_.x() * off.y() - chord_.y() * off.x()) / chord_.norm();
    }
    double chord() const { return chord_.norm(); }

private:
    const SlopeColumns& columns_;
    const SlopeSection& section_;
    const SlipSurface& surface_;
    double first_, last_, sense_;
    SectionPoint chord_;

    SectionPoint on_surface(double x) const { return {x, surface_height(surface_, x)}; }

    double pressure(const SectionPoint& at) const {
        return section_.pore_pressure ? std::max(0.0, section_.pore_pressure(at)) : 0.0;
    }

    /// A force at a place, to the right of the section and upward.
    void push(Slice& slice, const SectionPoint& force, const SectionPoint& at, const SectionPoint& base) const {
        slice.downward -= force.y();
        slice.rightward += sense_ * force.x();
        slice.load_moment += sense_ * (force.x() * (at.y() - base.y()) - force.y() * (at.x() - base.x()));
    }

    /// Stresses on the ground and forces in the body, but for those below the slip surface. Returns the part of the slice's top that has
    /// a stress.
    double add_loads(Slice& slice, double from, double to, const SectionPoint& base) const {
        const double near = 1e-9 * chord_.norm();
        const auto in_body = [&](const SectionPoint& at) { return at.y() >= surface_height(surface_, at.x()) - near; };
        const auto here = [&](double x) { return x >= from && (x < to || to == last_) && x <= to; };
        double covered = 0;
        for (const SectionTraction& t : section_.tractions) {
            if (t.from.x() > to) break;
            const double run = t.to.x() - t.from.x(), length = (t.to - t.from).norm();
            const double first = std::max(t.from.x(), from), last = std::min(t.to.x(), to);
            const bool upright = run < near;
            if (upright ? !here(t.from.x()) : !(last > first)) continue;
            const double begin = upright ? 0 : (first - t.from.x()) / run,
                         end = upright ? 1 : (last - t.from.x()) / run;
            // Two places of Gauss are exact for force and moment.
            for (const double place : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
                const double part = between(begin, end, place);
                const SectionPoint at = t.from + part * (t.to - t.from);
                if (in_body(at))
                    push(slice, 0.5 * (end - begin) * length * (t.at_from + part * (t.at_to - t.at_from)), at, base);
            }
            const SectionPoint middle = t.from + 0.5 * (begin + end) * (t.to - t.from);
            if (std::abs(columns_.ground_at(middle.x()).value_or(INFINITY) - middle.y()) < 1e3 * near && !upright)
                covered += (last - first) / (to - from);
        }
        for (const SectionForce& force : section_.forces) {
            if (force.at.x() > to) break;
            if (here(force.at.x()) && in_body(force.at)) push(slice, force.force, force.at, base);
        }
        return std::min(covered, 1.0);
    }

    /// Open water lies on the ground: its pressure acts along the normal, into it; and beside an upright part of the ground, on the
    /// slice that it bounds. `part` of the top has no stress that the deck gave: such a stress holds the water's.
    void add_open_water(Slice& slice, double from, double to, const SectionPoint& top, const SectionPoint& base,
                        double part) const {
        if (!section_.water_is_open) return;
        using Side = SlopeColumns::Side;
        const double left = *columns_.ground_at(from, Side::right), right = *columns_.ground_at(to, Side::left);
        const double on_top = pressure(top), before = slice.rightward;
        if (on_top > 0)
            slice.still_pressure = std::min(slice.pore_pressure, on_top + section_.water_weight * (top.y() - base.y()));
        push(slice, part * on_top * SectionPoint(right - left, -slice.width), {base.x(), top.y()}, base);
        const auto limit_side = [&](double x, double high, double low, double direction) {
            if (!(high > low)) return;
            const double force = 0.5 * (pressure({x, high}) + pressure({x, low})) * (high - low);
            push(slice, {part * direction * force, 0}, {base.x(), between(low, high, 1.0 / 3)}, base);
        };
        limit_side(to, right, to < last_ ? *columns_.ground_at(to, Side::right) : right, -1);
        limit_side(from, left, from > first_ ? *columns_.ground_at(from, Side::left) : left, 1);
        slice.water_push = slice.rightward - before;
    }
};

void add_crack_water(SlipBody& body, const SlopeSection& section, const SlipSurface& surface, double crack) {
    const double height = std::min(section.crack_water, section.crack_depth);
    body.water_force = 0.5 * section.water_weight * height * height;
    body.water_arm = height / 3;
    if (surface.circle)
        body.water_height = surface.circle->centre.y() - (surface_height(surface, crack) + body.water_arm);
}

} // namespace

std::optional<SlipBody> body_above(const SlopeColumns& columns, const SlipSurface& surface, int slices) {
    const SlopeSection& section = columns.section();
    if (surface.points.size() < 2) return std::nullopt;
    double first = surface.points.front().x(), last = surface.points.back().x();
    if (!(first < last)) return std::nullopt;
    const bool rightward = surface.points.front().y() > surface.points.back().y();
    if (section.crack_depth > 0) {
        (rightward ? first : last) = crack_end(columns, surface, rightward ? first : last, rightward ? last : first);
        if (!(first < last)) return std::nullopt;
    }
    SlipBody body;
    body.seismic = section.seismic;
    const Slicer slicer(columns, surface, first, last, rightward);
    const std::vector<double> ends = slicer.ends(slices);
    double depth = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        const auto slice = slicer.slice(ends[k], ends[k + 1]);
        if (!slice) return std::nullopt;
        body.slices.push_back(*slice);
        const SectionPoint base = slicer.base(ends[k], ends[k + 1]);
        if (surface.circle) body.centre_heights.push_back(surface.circle->centre.y() - base.y());
        depth = std::max(depth, slicer.depth(base));
    }
    if (surface.circle) body.radius = surface.circle->radius;
    body.depth_ratio = depth / slicer.chord();
    if (section.crack_water > 0 && section.crack_depth > 0)
        add_crack_water(body, section, surface, rightward ? first : last);
    if (!rightward) {
        std::ranges::reverse(body.slices);
        std::ranges::reverse(body.centre_heights);
    }
    return body;
}

} // namespace kaya
