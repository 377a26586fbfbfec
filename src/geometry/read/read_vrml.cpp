// VRML files, version 1 and 2: every IndexedFaceSet is read, with its own or the last given points.
#include "geometry/read/surface_files.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace kaya {
namespace {

/// The values of a field "[ ... ]".
template <class Read> void read_brackets(Words& words, Read&& read) {
    words.expect("[");
    while (words.peek() != "]") {
        if (words.peek().empty()) words.fail("the file ends within brackets");
        read();
    }
    words.next();
}

/// Refuses a placement that would move or turn the blocks; one that changes nothing is harmless.
void need_unplaced(Words& words, const std::string& field) {
    static const std::map<std::string, std::pair<int, double>, std::less<>> fields{
        {"translation", {3, 0}}, {"scale", {3, 1}}, {"rotation", {4, 0}}};
    const auto [count, neutral] = fields.at(field);
    for (int i = 0; i < count; ++i) {
        const double value = words.number("a number");
        // A rotation is nothing when its angle, the last number, is.
        const bool counts = field != "rotation" || i == 3;
        if (counts && value != neutral)
            words.fail(fmt::format("the {} of a transform is not applied by this reader", field),
                       "export with the transforms applied to the points");
    }
}

} // namespace

std::vector<FaceSoup> read_vrml(std::string_view text, const std::string& file) {
    if (text.substr(0, 5) != "#VRML") Words(text, file, "", "").fail("a VRML file begins with '#VRML'");
    Words words(text, file, ",", "#");
    std::vector<Vec3> points;
    std::vector<FaceSoup> soups;
    std::string name;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (word == "DEF") {
            name = words.next();
        } else if (word == "USE") {
            const std::string_view what = words.next();
            words.fail(fmt::format("the repeated use of '{}' is not read", what.substr(0, 30)),
                       "export without DEF and USE of shapes");
        } else if (word == "point") {
            points.clear();
            read_brackets(words, [&] { points.push_back(words.point("a coordinate")); });
        } else if (word == "coordIndex") {
            FaceSoup soup{name, {}};
            std::vector<Vec3> loop;
            const auto finish = [&] {
                if (!loop.empty()) soup.loops.push_back(std::move(loop));
                loop.clear();
            };
            read_brackets(words, [&] {
                const long long index = words.integer("the number of a point");
                if (index == -1) return finish();
                if (index < 0 || index >= static_cast<long long>(points.size()))
                    words.fail(fmt::format("point {} is used, and the points are 0 to {}", index,
                                           static_cast<long long>(points.size()) - 1));
                loop.push_back(points[static_cast<std::size_t>(index)]);
            });
            finish();
            soups.push_back(std::move(soup));
        } else if (word == "translation" || word == "scale" || word == "rotation") {
            need_unplaced(words, std::string(word));
        }
    }
    return soups;
}

} // namespace kaya
