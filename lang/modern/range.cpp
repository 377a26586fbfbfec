// The modern range phrase: its words are a second spelling of the classic elements.
#include "lang/commands/range_parts.hpp"
#include "lang/modern/leaf.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

using Kind = RangeElement::Kind;

/// Modern words, and the classic element that they mean.
struct ElementWords {
    const char* words;
    const char* classic;
};

constexpr ElementWords elements[] = {
    {"sphere", "sphere"},
    {"annulus", "annulus"},
    {"cylinder", "cylinder"},
    {"plane", "plane"},
    {"group-intersection", "group-intersection"},
    {"id", "id"},
    {"id-list", "id-list"},
    {"region", "region"},
    {"joint-set", "joint-set"},
    {"jmodel", "jmodel"},
    {"bmaterial", "material"},
    {"jmaterial", "jmaterial"},
    {"mintersection", "mintersection"},
    {"rintersection", "rintersection"},
    {"volume", "volume"},
    {"edge-length", "edge-length"},
    {"face-area", "face-area"},
    {"aspect-ratio", "aspect-ratio"},
    {"deformable", "deformable"},
    {"excavated", "excavated"},
    {"surface", "surface"},
    {"concave", "concave"},
    {"leader-id", "leader-id"},
    {"dfn|dfn-3dec", "dfn"},
    {"fid|fidlist|fracture-id", "fid"},
    {"geometry-space", "geometry-space"},
    {"geometry-distance", "geometry-distance"},
    {"state", "state"},
    {"extent", "extent"},
    {"union", "union"},
    {"not", "not"},
};

struct Unsupported {
    const char* words;
    const char* about;
};

constexpr Unsupported unsupported[] = {
    {"by", "testing the parts of an object, or the object of a part"},
    {"component-id", "numbers of parts of structures"},
    {"component-id-list", "numbers of parts of structures"},
    {"contact", "objects at contacts"},
    {"deselected", "selection on the screen"},
    {"displacement", "displacements in a range"},
    {"ellipse", "prisms on an ellipse"},
    {"extra", "extra variables in a range"},
    {"extra-list", "extra variables in a range"},
    {"fish", "functions of FISH in a range"},
    {"index-list", "internal numbers"},
    {"project-range", "ranges of a project"},
    {"seed", "objects that are connected to a place"},
    {"selected", "selection on the screen"},
    {"set", "sets of surfaces"},
    {"sregion", "regions of surfaces"},
    {"structure-type", "kinds of structures"},
    {"use-hidden", "hidden objects in a range"},
    {"velocity", "velocities in a range"},
    {"wall", "blocks that are walls"},
};

const KeywordSpec& classic_element(std::string_view word) {
    for (const KeywordSpec& element : range_elements())
        for (const Spelling& s : element.words)
            if (s.word == word) return element;
    throw std::logic_error(fmt::format("there is no classic range element '{}'", word));
}

/// True after taking the word `tolerance`.
bool takes_tolerance(Reader& reader) {
    const Word* next = reader.peek();
    if (!next || next->kind != WordKind::word || !Spelling{"tolerance", 3}.matches(next->folded)) return false;
    reader.take();
    reader.spell("tolerance");
    return true;
}

const ArgumentSpec& tolerance() {
    static const ArgumentSpec spec = real("tolerance").unit("length").at_least(0).spec;
    return spec;
}

/// `position-x low high`, or a value and a tolerance; a value alone is a plane.
void coordinate(Keywords<RangePhrase>& table, const char* words, const char* classic, Kind kind) {
    const KeywordSpec& meaning = classic_element(classic);
    table.special(
        tree_words(words).front(), meaning.arguments,
        [&meaning, kind](Reader& reader, RangePhrase& phrase) {
            meaning.read(reader, &phrase);
            RangeElement& element = phrase.elements.back();
            if (element.low != element.high || !takes_tolerance(reader)) return;
            const double around = reader.real(tolerance());
            element.kind = kind;
            element.low -= around;
            element.high += around;
        },
        "a coordinate between two limits, or a value and `tolerance t`");
    table.said(classic).prints(meaning.write);
}

/// Two corners, or one with a tolerance.
void position(Keywords<RangePhrase>& table) {
    const ArgumentSpec corner = vector("x y z").unit("length").spec;
    const auto read = [corner](Reader& reader, RangeElement& element) {
        const Vec3 one = reader.vector(corner);
        const bool near = takes_tolerance(reader);
        const double around = near ? reader.real(tolerance()) : 0;
        const Vec3 other = near ? one : reader.vector(corner);
        element.centre = one.cwiseMin(other).array() - around;
        element.end2 = one.cwiseMax(other).array() + around;
    };
    const KeywordSpec& classic = classic_element("position");
    table.keyword({"position"}, element(Kind::box, Parts<RangeElement>().argument(corner).check(read)),
                  "inside a box, given by two corners, or near a place: x y z tolerance t");
    table.said(classic.words.front().word).prints(classic.write);
}

/// A prism on a plane figure: there is no limit along its normal, which a classic element needs.
void figure(Keywords<RangePhrase>& table, const char* word, std::size_t corners) {
    const KeywordSpec& meaning = classic_element("polygon");
    table.special(
        {word}, meaning.arguments,
        [&meaning, word, corners](Reader& reader, RangePhrase& phrase) {
            meaning.read(reader, &phrase);
            RangeElement& element = phrase.elements.back();
            if (corners > 0 && element.vertices.size() != corners)
                throw Diagnostic(fmt::format("the {} needs {} corners, not {}", word, corners, element.vertices.size()),
                                 fmt::format("write: {} vertices x y z  x y z  x y z  x y z", word))
                    .at(element.place);
            constexpr double unlimited = 1e300;
            if (element.distance == 0) element.distance = unlimited;
        },
        "inside the prism on a plane figure, of any length along its normal", meaning.keywords);
    table.said(corners > 0 ? "" : word);
    if (corners == 0) table.prints(meaning.write);
}

/// The tolerance of an orientation is 2 degrees in this dialect, 1 in the classic one.
void orientation(Keywords<RangePhrase>& table) {
    table.keyword({"orientation"}, orientation_element(2),
                  "faces and contacts of an orientation: dip d dip-direction a [tolerance t], 2 degrees if not given");
    table.said("orientation");
}

/// The words after the name are those of the classic element.
void group(Keywords<RangePhrase>& table) {
    const auto parts =
        Parts<RangeElement>().then(text("name"), &RangeElement::name).words(classic_element("group").keywords);
    table.keyword({"group"}, element(Kind::group, parts),
                  "members of a group; a contact belongs to the groups of its two blocks");
    table.said("group");
}

void named_range(Keywords<RangePhrase>& table) {
    table.keyword({"named-range", "name"},
                  element(Kind::named, Parts<RangeElement>().then(text("name"), &RangeElement::name)),
                  "a range that `model range create` has made");
    table.said("nrange");
}

std::vector<KeywordSpec> all_elements() {
    Keywords<RangePhrase> table;
    position(table);
    coordinate(table, "position-x", "x", Kind::x);
    coordinate(table, "position-y", "y", Kind::y);
    coordinate(table, "position-z", "z", Kind::z);
    group(table);
    for (const ElementWords& row : elements) {
        KeywordSpec element = classic_element(row.classic);
        element.classic = element.words.front().word;
        element.words = tree_words(row.words).front();
        table.add(std::move(element));
    }
    orientation(table);
    figure(table, "polygon", 0);
    figure(table, "rectangle", 4);
    named_range(table);
    for (const Unsupported& row : unsupported) table.not_yet(tree_words(row.words).front(), row.about);
    return std::move(table).list();
}

} // namespace

const RangeGrammar& modern_ranges() {
    static const std::vector<KeywordSpec> list = all_elements();
    static const RangeGrammar grammar{list, "range position-z 0 1"};
    return grammar;
}

} // namespace kaya::lang
