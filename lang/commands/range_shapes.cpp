// Range elements that are places in space: boxes, planes, round bodies, plane figures, orientations.
#include "lang/commands/range_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace kaya::lang {

namespace {

using Kind = RangeElement::Kind;

constexpr double degree = std::numbers::pi / 180;

/// Words in any order that fill a text, from which an element is made. `not` does not belong to them.
template <class Text, class Finish, class TextOf>
Parts<RangeElement> by_text(const std::vector<KeywordSpec>& words, Finish finish, TextOf text_of) {
    return Parts<RangeElement>().words<Text>(words, finish, text_of).set([](RangeElement& e) { e.negated = false; });
}

void box(Keywords<RangePhrase>& table) {
    const auto corner = vector("x y z").unit("length");
    const auto sort_corners = [](Reader&, RangeElement& e) {
        const Vec3 one = e.centre, two = e.end2;
        e.centre = one.cwiseMin(two);
        e.end2 = one.cwiseMax(two);
    };
    table.keyword({"position"},
                  element(Kind::box, Parts<RangeElement>()
                                         .then(corner, &RangeElement::centre)
                                         .then(corner, &RangeElement::end2)
                                         .check(sort_corners)),
                  "inside a box, given by two corners");
}

/// Upward normal of a plane of dip and dip direction in degrees.
Vec3 upward_normal(double dip_degrees, double dip_direction_degrees) {
    const double dip = dip_degrees * degree, dd = dip_direction_degrees * degree;
    return {std::sin(dip) * std::sin(dd), std::sin(dip) * std::cos(dd), std::cos(dip)};
}

/// A vector of length 1 stays as it is, to the last bit.
Vec3 unit_normal(const Vec3& given) {
    constexpr double rounding = 1e-15, least = 1e-150, most = 1e150; // of lengths whose squares are numbers
    const double length = given.norm();
    if (!(length > least && length < most)) return unit_normal(given / given.cwiseAbs().maxCoeff());
    return std::abs(length - 1) <= rounding ? given : Vec3(given / length);
}

/// The distance of a plane that has none.
constexpr double everywhere = std::numeric_limits<double>::infinity();

/// Parts of a plane: `low` and `high` of its element keep dip and dip direction.
struct PlaneText {
    double dip = 0, dip_direction = 0;
    std::optional<Vec3> normal;
    Vec3 origin = Vec3::Zero();
    int side = 0;
    std::optional<double> distance;
    bool both_sides = false;

    void take(int other) {
        both_sides = both_sides || side == -other;
        side = other;
    }
};

std::vector<KeywordSpec> plane_words() {
    Keywords<PlaneText> words;
    words.keyword({"dip"}, real("dip").unit("degrees"), &PlaneText::dip, "angle below the horizontal");
    words.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &PlaneText::dip_direction,
                  "direction of dip, clockwise from +y seen from above");
    words.keyword({"origin", "org"}, vector("x y z").unit("length"), &PlaneText::origin, "a point of the plane");
    words.keyword({"normal"}, vector("nx ny nz"), &PlaneText::normal, "normal, in place of dip and dd");
    words.action(
        {"above"}, [](PlaneText& p) { p.take(1); }, "the side to which the normal points");
    words.action(
        {"below"}, [](PlaneText& p) { p.take(-1); }, "the other side");
    words.keyword({"distance"}, real("distance").unit("length").at_least(0), &PlaneText::distance,
                  "all within this distance of the plane, on the given side if there is one");
    return std::move(words).list();
}

void read_plane(Reader& reader, const PlaneText& plane, RangeElement& element, const std::vector<KeywordSpec>& words) {
    if (plane.side == 0 && !plane.distance)
        lacks_part(reader, "plane", words, "the plane does not say which part is meant",
                   "add above, below, or distance d");
    if (plane.both_sides)
        incomplete_line(reader, "the plane has both sides, above and below",
                        "give one of them, or distance d for both");
    element.low = plane.dip;
    element.high = plane.dip_direction;
    element.normal = upward_normal(plane.dip, plane.dip_direction);
    if (plane.normal) {
        if (plane.normal->isZero(0))
            incomplete_line(reader, "the normal of the plane is zero", "it must have a direction");
        element.normal = unit_normal(*plane.normal);
    }
    element.centre = plane.origin;
    element.side = plane.side;
    element.distance = plane.distance.value_or(everywhere);
}

PlaneText text_of_plane(const RangeElement& e) {
    PlaneText plane{e.low, e.high, {}, e.centre, e.side, {}};
    const Vec3 of_dip = upward_normal(e.low, e.high);
    for (int k = 0; k < 3; ++k)
        if (std::bit_cast<std::uint64_t>(e.normal[k]) != std::bit_cast<std::uint64_t>(of_dip[k]))
            plane.normal = e.normal;
    if (e.distance != everywhere) plane.distance = e.distance;
    return plane;
}

void plane(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = plane_words();
    const auto read = [](Reader& reader, const PlaneText& plane, RangeElement& element) {
        read_plane(reader, plane, element, words);
    };
    table.keyword({"plane"}, element(Kind::plane, by_text<PlaneText>(words, read, text_of_plane)),
                  "one side of a plane, or objects near it");
}

/// A sphere or a cylinder while its words are read.
struct RoundText {
    std::optional<Vec3> centre, end;
    std::optional<double> inner, outer;
};

Parts<RoundText> radii() {
    const auto order = [](Reader& reader, RoundText& round) {
        if (round.inner && *round.inner > *round.outer) std::swap(round.inner, round.outer);
        if (*round.outer > 0 || reader.wildcards()) return;
        throw Diagnostic("radius must be greater than 0, not 0").at(reader.previous().place);
    };
    const auto radius = real("radius").unit("length").at_least(0);
    // One radius is the outer one; of two it is the second.
    return Parts<RoundText>()
        .argument(radius.spec)
        .argument(real("outer").unit("length").above(0).optional().spec)
        .by(
            [radius](Reader& reader, RoundText& round) {
                round.outer = reader.real(radius.spec);
                if (!reader.at_number()) return;
                round.inner = round.outer;
                round.outer = reader.real(radius.spec);
            },
            [](Parts<RoundText>::Form form, const RoundText& round) {
                if (round.inner) print_value(form.words, *round.inner);
                print_value(form.words, *round.outer);
                form.after.inner = round.inner;
                form.after.outer = round.outer;
                return Parts<RoundText>::Forms{std::move(form)};
            })
        .check(order);
}

std::vector<KeywordSpec> sphere_words() {
    Keywords<RoundText> words;
    words.keyword({"center", "centre", "c"}, vector("x y z").unit("length"), &RoundText::centre, "the centre");
    words.keyword({"radius", "r"}, radii(), "the radius; two make a hollow ball");
    return std::move(words).list();
}

std::vector<KeywordSpec> cylinder_words() {
    Keywords<RoundText> words;
    words.keyword({"end1", "end-1"}, vector("x y z").unit("length"), &RoundText::centre, "one end of the axis");
    words.keyword({"end2", "end-2"}, vector("x y z").unit("length"), &RoundText::end, "the other end");
    words.keyword({"radius", "r"}, radii(), "the radius; two make a pipe");
    return std::move(words).list();
}

void round_elements(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> of_sphere = sphere_words(), of_cylinder = cylinder_words();
    const auto fill = [](RangeElement& element, const RoundText& round) {
        element.centre = *round.centre;
        element.radius1 = round.inner.value_or(0);
        element.radius2 = *round.outer;
    };
    const auto text_of = [](const RangeElement& e) {
        RoundText round{e.centre, {}, {}, e.radius2};
        if (e.radius1 != 0 || std::signbit(e.radius1)) round.inner = e.radius1;
        return round;
    };
    const auto sphere = [fill](Reader& reader, const RoundText& round, RangeElement& element) {
        if (!round.centre || !round.outer)
            lacks_part(reader, "sphere", of_sphere, "the sphere needs center and radius",
                       "write: sphere center x y z radius r");
        fill(element, round);
    };
    const auto cylinder = [fill](Reader& reader, const RoundText& round, RangeElement& element) {
        if (!round.centre || !round.end || !round.outer)
            lacks_part(reader, "cylinder", of_cylinder, "the cylinder needs end1, end2 and radius",
                       "write: cylinder end1 x y z end2 x y z radius r");
        fill(element, round);
        element.end2 = *round.end;
    };
    const auto text_of_cylinder = [text_of](const RangeElement& e) {
        RoundText round = text_of(e);
        round.end = e.end2;
        return round;
    };
    table.keyword({"sphere", "annulus"}, element(Kind::sphere, by_text<RoundText>(of_sphere, sphere, text_of)),
                  "inside a sphere");
    table.keyword({"cylinder"}, element(Kind::cylinder, by_text<RoundText>(of_cylinder, cylinder, text_of_cylinder)),
                  "inside a cylinder");
}

/// Dip and dip direction with a tolerance while they are read; `low` and `high` of the element keep the first two.
struct OrientationText {
    std::optional<double> dip;
    double dip_direction = 0;
    std::optional<double> tolerance;
};

void ground(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<RangeElement> list;
        list.action(
            {"above"}, [](RangeElement& e) { e.side = 1; }, "objects above the surface");
        list.action(
            {"below"}, [](RangeElement& e) { e.side = -1; }, "objects below it");
        list.keyword({"shift"}, vector("dx dy dz").unit("length"), &RangeElement::centre, "moves the surface");
        return std::move(list).list();
    }();
    const auto needs_side = [](Reader& reader, RangeElement& e) {
        if (e.side == 0)
            lacks_part(reader, "ground", words, "the ground needs above or below", "write: ground 'file' above");
    };
    table.keyword({"ground"},
                  element(Kind::ground,
                          Parts<RangeElement>().then(text("file"), &RangeElement::name).words(words).check(needs_side)),
                  "above or below a ground surface; objects outside of its plan are neither");
}

/// The name of a set of surfaces, in lower case.
Parts<RangeElement> set_name() {
    return Parts<RangeElement>().in(
        next_of(&RangeElement::sets),
        Parts<std::string>().then(text("name"),
                                  Through{[](std::string& to, const std::string& name) { to = fold(name); },
                                          [](const std::string& name) { return std::optional(name); }}));
}

/// More sets of surfaces than the first: `set 'name'`.
void add_set_word(Keywords<RangeElement>& list) { list.keyword({"set"}, set_name(), "another set of surfaces"); }

/// An odd number of crossings (1) or an even one (-1), whatever words before it say.
auto crossed(int side) {
    return [side](RangeElement& e) {
        e.side = side;
        e.low = 0;
    };
}

/// `count odd`, `count even` or `count n`.
Parts<RangeElement> crossings() {
    const auto count = integer("n").at_least(0);
    return Parts<RangeElement>()
        .argument(count.spec)
        .by(
            [count](Reader& reader, RangeElement& e) {
                const Word* next = reader.peek();
                const bool odd = next != nullptr && next->folded == "odd";
                if (odd || (next != nullptr && next->folded == "even")) {
                    reader.take();
                    e.side = odd ? 1 : -1;
                    return;
                }
                e.side = 2;
                e.low = static_cast<double>(reader.integer(count.spec));
            },
            [](Parts<RangeElement>::Form form, const RangeElement& e) {
                if (e.side != 2) return Parts<RangeElement>::Forms{}; // the words inside and outside say it
                form.after.side = e.side;
                form.after.low = e.low;
                print_value(form.words, static_cast<std::int64_t>(e.low));
                return Parts<RangeElement>::Forms{std::move(form)};
            });
}

void geometry_space(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<RangeElement> list;
        add_set_word(list);
        list.action({"inside"}, crossed(1), "objects inside of closed surfaces: an odd number of crossings");
        list.action({"outside"}, crossed(-1), "objects outside of them: an even number");
        list.keyword({"count"}, crossings(),
                     "objects from which a ray crosses the surfaces so many times; or `count odd`, `count even`");
        list.keyword({"direction"}, vector("x y z"), &RangeElement::normal, "of the ray, upward if not given");
        return std::move(list).list();
    }();
    const auto check = [](Reader& reader, RangeElement& e) {
        if (e.side == 0)
            lacks_part(reader, "geometry-space", words, "the element does not say which part is meant",
                       "write: geometry-space 'name' inside, outside, or count n");
        if (!reader.wildcards() && !(e.normal.norm() > 0))
            throw Diagnostic("the direction has no length").at(reader.previous().place);
    };
    table.keyword({Spelling{"geometry-space", 10}}, element(Kind::geometry_space, set_name().words(words).check(check)),
                  "inside or outside of the surfaces of `geometry set`, by the number of them that a ray crosses");
}

void geometry_distance(Keywords<RangePhrase>& table) {
    Keywords<RangeElement> list;
    add_set_word(list);
    list.keyword({"gap"}, real("distance").unit("length").at_least(0), &RangeElement::distance,
                 "greatest distance; only objects on the surfaces if not given");
    table.keyword({Spelling{"geometry-distance", 10}},
                  element(Kind::geometry_distance, set_name().words(std::move(list).list())),
                  "near the surfaces of `geometry set`");
}

/// A plane figure while its words are read.
struct FigureText {
    std::vector<Vec3> vertices;
    std::optional<Vec3> centre, axis1, axis2;
    double distance = 0;
};

std::vector<KeywordSpec> figure_words(bool round) {
    Keywords<FigureText> list;
    if (round) {
        list.keyword({"center", "centre"}, vector("x y z").unit("length"), &FigureText::centre, "the centre");
        list.keyword({"axis1", "axis-1"}, vector("x y z").unit("length"), &FigureText::axis1,
                     "from the centre to the end of one half axis");
        list.keyword({"axis2", "axis-2"}, vector("x y z").unit("length"), &FigureText::axis2,
                     "the same, of the other half axis");
    } else {
        list.keyword({"vertices"}, Parts<FigureText>().each(vector("x y z").unit("length"), &FigureText::vertices),
                     "the corners, in order");
    }
    list.keyword({"distance"}, real("distance").unit("length").at_least(0), &FigureText::distance,
                 "all within this distance of its plane");
    return std::move(list).list();
}

/// Refuses corners in one plane: they enclose no volume.
void check_flat(const Reader& reader, const std::vector<Vec3>& vertices) {
    Vec3 normal = Vec3::Zero();
    double size = 0;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
        normal += (vertices[i] - vertices[0]).cross(vertices[i + 1] - vertices[0]);
    for (const Vec3& v : vertices) size = std::max(size, (v - vertices[0]).norm());
    constexpr double flat = 1e-6;
    if (!(normal.norm() > flat * size * size))
        throw Diagnostic("the corners of the figure enclose no area", "give them in order around it")
            .at(reader.previous().place);
    for (const Vec3& v : vertices)
        if (std::abs(normal.normalized().dot(v - vertices[0])) > flat * size)
            throw Diagnostic("the corners of the figure do not lie in one plane").at(reader.previous().place);
}

void read_rectangle(Reader& reader, FigureText& figure, const std::vector<KeywordSpec>& words) {
    auto& v = figure.vertices;
    if (v.size() != 3)
        lacks_part(reader, "rectangle", words, "the rectangle needs three corners",
                   "write: rectangle vertices x y z  x y z  x y z distance d; the fourth follows");
    v.push_back(v[0] + v[2] - v[1]);
    if (reader.wildcards()) return;
    check_flat(reader, v);
    const Vec3 one = v[0] - v[1], two = v[2] - v[1];
    if (std::abs(one.dot(two)) > 1e-6 * one.norm() * two.norm())
        throw Diagnostic("the sides of the rectangle are not at right angles",
                         "give three corners in order, or use polygon")
            .at(reader.previous().place);
}

void figures(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> of_corners = figure_words(false), of_ellipse = figure_words(true);
    const auto polygon = [](Reader& reader, FigureText& figure, RangeElement& element) {
        if (figure.vertices.size() < 3)
            lacks_part(reader, "polygon", of_corners, "the polygon needs three corners or more",
                       "write: polygon vertices x y z  x y z  x y z ... distance d");
        if (!reader.wildcards()) check_flat(reader, figure.vertices);
        element.vertices = std::move(figure.vertices);
        element.distance = figure.distance;
    };
    const auto rectangle = [](Reader& reader, FigureText& figure, RangeElement& element) {
        read_rectangle(reader, figure, of_corners);
        element.vertices = std::move(figure.vertices);
        element.distance = figure.distance;
    };
    const auto text_of_polygon = [](const RangeElement& e) { return FigureText{e.vertices, {}, {}, {}, e.distance}; };
    table.keyword({"polygon"}, element(Kind::polygon, by_text<FigureText>(of_corners, polygon, text_of_polygon)),
                  "inside a plane polygon; in its plane if no distance is given");
    // Its four corners are those of a polygon.
    table
        .keyword({Spelling{"rectangle", 3}},
                 element(Kind::polygon, by_text<FigureText>(of_corners, rectangle, text_of_polygon)),
                 "inside a rectangle, given by three corners")
        .prints({});
    const auto ellipse = [](Reader& reader, const FigureText& figure, RangeElement& element) {
        if (!figure.centre || !figure.axis1 || !figure.axis2)
            lacks_part(reader, "ellipse", of_ellipse, "the ellipse needs center, axis1 and axis2",
                       "write: ellipse center x y z axis1 x y z axis2 x y z distance d");
        const Vec3 &one = *figure.axis1, &two = *figure.axis2;
        if (!reader.wildcards() && !(one.cross(two).norm() > 1e-6 * one.norm() * two.norm()))
            throw Diagnostic("the two axes of the ellipse enclose no area").at(reader.previous().place);
        element.centre = *figure.centre;
        element.end2 = one;
        element.normal = two;
        element.distance = figure.distance;
    };
    const auto text_of_ellipse = [](const RangeElement& e) {
        return FigureText{{}, e.centre, e.end2, e.normal, e.distance};
    };
    table.keyword({Spelling{"ellipse", 3}},
                  element(Kind::ellipse, by_text<FigureText>(of_ellipse, ellipse, text_of_ellipse)),
                  "inside an ellipse");
}

} // namespace

Parts<RangePhrase> orientation_element(double default_tolerance) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<OrientationText> list;
        list.keyword({"dip"}, real("dip").unit("degrees"), &OrientationText::dip, "angle below the horizontal");
        list.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &OrientationText::dip_direction,
                     "direction of dip, clockwise from +y seen from above");
        list.keyword({"tolerance"}, real("tolerance").unit("degrees").at_least(0).at_most(90),
                     &OrientationText::tolerance, "greatest angle between the normals");
        return std::move(list).list();
    }();
    const auto read = [default_tolerance](Reader& reader, const OrientationText& text, RangeElement& element) {
        if (!text.dip)
            lacks_part(reader, "orientation", words, "the orientation needs dip",
                       "write: orientation dip d dd a tolerance t");
        element.low = *text.dip;
        element.high = text.dip_direction;
        element.normal = upward_normal(element.low, element.high);
        element.radius1 = text.tolerance.value_or(default_tolerance);
    };
    const auto text_of = [default_tolerance](const RangeElement& e) {
        OrientationText text{e.low, e.high, {}};
        if (e.radius1 != default_tolerance) text.tolerance = e.radius1;
        return text;
    };
    return element(Kind::orientation, by_text<OrientationText>(words, read, text_of));
}

void space_elements(Keywords<RangePhrase>& table) {
    box(table);
    plane(table);
    round_elements(table);
}

void figure_elements(Keywords<RangePhrase>& table) {
    table.keyword({Spelling{"orientation", 4}}, orientation_element(1),
                  "faces and contacts of an orientation, within 1 degree if no tolerance is given");
    ground(table);
    geometry_space(table);
    geometry_distance(table);
    figures(table);
}

} // namespace kaya::lang
