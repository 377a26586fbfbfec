// Range elements that are places in space: boxes, planes, round bodies, plane figures, orientations.
#include "lang/commands/range_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya::lang {

namespace {

using Kind = RangeElement::Kind;

constexpr double degree = std::numbers::pi / 180;

void box(Keywords<RangePhrase>& table) {
    const auto corner = vector("x y z").unit("length").spec;
    table.special(
        {"position"}, {corner, corner},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::box);
            const Vec3 one = reader.vector(corner), two = reader.vector(corner);
            phrase.elements.back().centre = one.cwiseMin(two);
            phrase.elements.back().end2 = one.cwiseMax(two);
        },
        "inside a box, given by two corners");
}

/// Upward normal of a plane of dip and dip direction in degrees.
Vec3 upward_normal(double dip_degrees, double dip_direction_degrees) {
    const double dip = dip_degrees * degree, dd = dip_direction_degrees * degree;
    return {std::sin(dip) * std::sin(dd), std::sin(dip) * std::cos(dd), std::cos(dip)};
}

/// The parts of a plane that have been read so far.
struct PlaneText {
    double dip = 0, dip_direction = 0;
    std::optional<Vec3> normal;
    Vec3 origin = Vec3::Zero();
    int side = 0;
    std::optional<double> distance;
};

std::vector<KeywordSpec> plane_words() {
    Keywords<PlaneText> words;
    words.keyword({"dip"}, real("dip").unit("degrees"), &PlaneText::dip, "angle below the horizontal");
    words.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &PlaneText::dip_direction,
                  "direction of dip, clockwise from +y seen from above");
    words.keyword({"origin", "org"}, vector("x y z").unit("length"), &PlaneText::origin, "a point of the plane");
    words.keyword({"normal"}, vector("nx ny nz"), &PlaneText::normal, "normal, in place of dip and dd");
    words.action(
        {"above"}, [](PlaneText& p) { p.side = 1; }, "the side to which the normal points");
    words.action(
        {"below"}, [](PlaneText& p) { p.side = -1; }, "the other side");
    words.keyword({"distance"}, real("distance").unit("length").at_least(0), &PlaneText::distance,
                  "all within this distance of the plane");
    return std::move(words).list();
}

void plane(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = plane_words();
    const auto read = [](Reader& reader, RangePhrase& phrase) {
        RangeElement& element = add(reader, phrase, Kind::plane);
        PlaneText plane;
        read_keywords(reader, words, &plane);
        if (plane.side == 0 && !plane.distance)
            lacks_part(reader, "plane", words, "the plane does not say which part is meant",
                       "add above, below, or distance d");
        Vec3 normal = upward_normal(plane.dip, plane.dip_direction);
        if (plane.normal) {
            const double length = plane.normal->norm();
            if (length == 0) incomplete_line(reader, "the normal of the plane is zero", "it must have a direction");
            normal = *plane.normal / length;
        }
        element.normal = normal;
        element.centre = plane.origin;
        element.side = plane.side;
        element.distance = plane.distance.value_or(0);
    };
    table.special({"plane"}, {}, read, "one side of a plane, or objects near it", words);
}

/// A sphere or a cylinder while its words are read.
struct RoundText {
    std::optional<Vec3> centre, end;
    std::optional<double> inner, outer;
};

void read_radii(Reader& reader, RoundText& round) {
    const auto radius = real("radius").unit("length").at_least(0).spec;
    round.outer = reader.real(radius);
    if (reader.at_number()) {
        round.inner = *round.outer;
        round.outer = reader.real(radius);
        if (*round.inner > *round.outer) std::swap(round.inner, round.outer);
    }
    if (*round.outer > 0 || reader.wildcards()) return;
    throw Diagnostic("radius must be greater than 0, not 0").at(reader.previous().place);
}

std::vector<KeywordSpec> sphere_words() {
    Keywords<RoundText> words;
    words.keyword({"center", "centre", "c"}, vector("x y z").unit("length"), &RoundText::centre, "the centre");
    words.special(
        {"radius", "r"},
        {real("radius").unit("length").at_least(0).spec, real("outer").unit("length").above(0).optional().spec},
        read_radii, "the radius; two make a hollow ball");
    return std::move(words).list();
}

std::vector<KeywordSpec> cylinder_words() {
    Keywords<RoundText> words;
    words.keyword({"end1", "end-1"}, vector("x y z").unit("length"), &RoundText::centre, "one end of the axis");
    words.keyword({"end2", "end-2"}, vector("x y z").unit("length"), &RoundText::end, "the other end");
    words.special(
        {"radius", "r"},
        {real("radius").unit("length").at_least(0).spec, real("outer").unit("length").above(0).optional().spec},
        read_radii, "the radius; two make a pipe");
    return std::move(words).list();
}

void round_elements(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> of_sphere = sphere_words(), of_cylinder = cylinder_words();
    const auto fill = [](RangeElement& element, const RoundText& round) {
        element.centre = *round.centre;
        element.radius1 = round.inner.value_or(0);
        element.radius2 = *round.outer;
    };
    table.special(
        {"sphere", "annulus"}, {},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::sphere);
            RoundText round;
            read_keywords(reader, of_sphere, &round);
            if (!round.centre || !round.outer)
                lacks_part(reader, "sphere", of_sphere, "the sphere needs center and radius",
                           "write: sphere center x y z radius r");
            fill(phrase.elements.back(), round);
        },
        "inside a sphere", of_sphere);
    table.special(
        {"cylinder"}, {},
        [=](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::cylinder);
            RoundText round;
            read_keywords(reader, of_cylinder, &round);
            if (!round.centre || !round.end || !round.outer)
                lacks_part(reader, "cylinder", of_cylinder, "the cylinder needs end1, end2 and radius",
                           "write: cylinder end1 x y z end2 x y z radius r");
            fill(phrase.elements.back(), round);
            phrase.elements.back().end2 = *round.end;
        },
        "inside a cylinder", of_cylinder);
}

/// Dip and dip direction with a tolerance while they are read.
struct OrientationText {
    std::optional<double> dip;
    double dip_direction = 0, tolerance = 1;
};

void orientation(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<OrientationText> list;
        list.keyword({"dip"}, real("dip").unit("degrees"), &OrientationText::dip, "angle below the horizontal");
        list.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &OrientationText::dip_direction,
                     "direction of dip, clockwise from +y seen from above");
        list.keyword({"tolerance"}, real("tolerance").unit("degrees").at_least(0).at_most(90),
                     &OrientationText::tolerance, "greatest angle between the normals, 1 if not given");
        return std::move(list).list();
    }();
    table.special(
        {Spelling{"orientation", 4}}, {},
        [](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::orientation);
            OrientationText text;
            read_keywords(reader, words, &text);
            if (!text.dip)
                lacks_part(reader, "orientation", words, "the orientation needs dip",
                           "write: orientation dip d dd a tolerance t");
            phrase.elements.back().normal = upward_normal(*text.dip, text.dip_direction);
            phrase.elements.back().radius1 = text.tolerance;
        },
        "faces and contacts of an orientation", words);
}

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
    const auto file = text("file");
    table.special(
        {"ground"}, {file.spec},
        [file](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::ground);
            RangeElement& element = phrase.elements.back();
            element.name = reader.text(file.spec);
            read_keywords(reader, words, &element);
            if (element.side == 0)
                lacks_part(reader, "ground", words, "the ground needs above or below", "write: ground 'file' above");
        },
        "above or below a ground surface; objects outside of its plan are neither", words);
}

/// More sets of surfaces than the first: `set 'name'`.
void add_set_word(Keywords<RangeElement>& list) {
    list.keyword(
        {"set"}, text("name"), [](RangeElement& e, const std::string& name) { e.sets.push_back(fold(name)); },
        "another set of surfaces");
}

/// Reads the name of the first set after the word of an element.
RangeElement& of_surfaces(Reader& reader, RangePhrase& phrase, Kind kind, const ArgumentSpec& name) {
    add(reader, phrase, kind);
    phrase.elements.back().sets.push_back(fold(reader.text(name)));
    return phrase.elements.back();
}

void geometry_space(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<RangeElement> list;
        add_set_word(list);
        list.action(
            {"inside"}, [](RangeElement& e) { e.side = 1; },
            "objects inside of closed surfaces: an odd number of crossings");
        list.action(
            {"outside"}, [](RangeElement& e) { e.side = -1; }, "objects outside of them: an even number");
        const auto count = integer("n").at_least(0);
        list.special(
            {"count"}, {count.spec},
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
            "objects from which a ray crosses the surfaces so many times; or `count odd`, `count even`");
        list.keyword({"direction"}, vector("x y z"), &RangeElement::normal, "of the ray, upward if not given");
        return std::move(list).list();
    }();
    const auto name = text("name").spec;
    table.special(
        {Spelling{"geometry-space", 10}}, {name},
        [name](Reader& reader, RangePhrase& phrase) {
            RangeElement& element = of_surfaces(reader, phrase, Kind::geometry_space, name);
            read_keywords(reader, words, &element);
            if (element.side == 0)
                lacks_part(reader, "geometry-space", words, "the element does not say which part is meant",
                           "write: geometry-space 'name' inside, outside, or count n");
            if (!reader.wildcards() && !(element.normal.norm() > 0))
                throw Diagnostic("the direction has no length").at(reader.previous().place);
        },
        "inside or outside of the surfaces of `geometry set`, by the number of them that a ray crosses", words);
}

void geometry_distance(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> words = [] {
        Keywords<RangeElement> list;
        add_set_word(list);
        list.keyword({"gap"}, real("distance").unit("length").at_least(0), &RangeElement::distance,
                     "greatest distance; only objects on the surfaces if not given");
        return std::move(list).list();
    }();
    const auto name = text("name").spec;
    table.special(
        {Spelling{"geometry-distance", 10}}, {name},
        [name](Reader& reader, RangePhrase& phrase) {
            read_keywords(reader, words, &of_surfaces(reader, phrase, Kind::geometry_distance, name));
        },
        "near the surfaces of `geometry set`", words);
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
        ArgumentSpec corner = vector("x y z").unit("length").spec;
        corner.repeated = true;
        list.special(
            {"vertices"}, {corner},
            [corner](Reader& reader, FigureText& figure) {
                do figure.vertices.push_back(reader.vector(corner));
                while (reader.at_number());
            },
            "the corners, in order");
    }
    list.keyword({"distance"}, real("distance").unit("length").at_least(0), &FigureText::distance,
                 "all within this distance of its plane; only objects in the plane if not given");
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

void figures(Keywords<RangePhrase>& table) {
    static const std::vector<KeywordSpec> of_corners = figure_words(false), of_ellipse = figure_words(true);
    table.special(
        {"polygon"}, {},
        [](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::polygon);
            FigureText figure;
            read_keywords(reader, of_corners, &figure);
            if (figure.vertices.size() < 3)
                lacks_part(reader, "polygon", of_corners, "the polygon needs three corners or more",
                           "write: polygon vertices x y z  x y z  x y z ... distance d");
            if (!reader.wildcards()) check_flat(reader, figure.vertices);
            phrase.elements.back().vertices = std::move(figure.vertices);
            phrase.elements.back().distance = figure.distance;
        },
        "inside a plane polygon", of_corners);
    table.special(
        {Spelling{"rectangle", 3}}, {},
        [](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::polygon);
            FigureText figure;
            read_keywords(reader, of_corners, &figure);
            auto& v = figure.vertices;
            if (v.size() != 3)
                lacks_part(reader, "rectangle", of_corners, "the rectangle needs three corners",
                           "write: rectangle vertices x y z  x y z  x y z distance d; the fourth follows");
            v.push_back(v[0] + v[2] - v[1]);
            if (!reader.wildcards()) {
                check_flat(reader, v);
                const Vec3 one = v[0] - v[1], two = v[2] - v[1];
                if (std::abs(one.dot(two)) > 1e-6 * one.norm() * two.norm())
                    throw Diagnostic("the sides of the rectangle are not at right angles",
                                     "give three corners in order, or use polygon")
                        .at(reader.previous().place);
            }
            phrase.elements.back().vertices = std::move(v);
            phrase.elements.back().distance = figure.distance;
        },
        "inside a rectangle, given by three corners", of_corners);
    table.special(
        {Spelling{"ellipse", 3}}, {},
        [](Reader& reader, RangePhrase& phrase) {
            add(reader, phrase, Kind::ellipse);
            FigureText figure;
            read_keywords(reader, of_ellipse, &figure);
            if (!figure.centre || !figure.axis1 || !figure.axis2)
                lacks_part(reader, "ellipse", of_ellipse, "the ellipse needs center, axis1 and axis2",
                           "write: ellipse center x y z axis1 x y z axis2 x y z distance d");
            const Vec3 &one = *figure.axis1, &two = *figure.axis2;
            if (!reader.wildcards() && !(one.cross(two).norm() > 1e-6 * one.norm() * two.norm()))
                throw Diagnostic("the two axes of the ellipse enclose no area").at(reader.previous().place);
            RangeElement& element = phrase.elements.back();
            element.centre = *figure.centre;
            element.end2 = one;
            element.normal = two;
            element.distance = figure.distance;
        },
        "inside an ellipse", of_ellipse);
}

} // namespace

void space_elements(Keywords<RangePhrase>& table) {
    box(table);
    plane(table);
    round_elements(table);
}

void figure_elements(Keywords<RangePhrase>& table) {
    orientation(table);
    ground(table);
    geometry_space(table);
    geometry_distance(table);
    figures(table);
}

} // namespace kaya::lang
