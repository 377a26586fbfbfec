// Wavefront files: numbered vertices and faces; each object and group is a block.
#include "geometry/read/surface_files.hpp"
#include "geometry/read/words.hpp"

#include <fmt/format.h>

namespace kaya {
namespace {

/// "7", "7/1", "7//3" or "-1": the number of a vertex, counted from 1 or from the end.
std::size_t vertex_number(const Words& words, std::string_view word, std::size_t count) {
    const std::string_view digits = word.substr(0, word.find('/'));
    Words one(digits, "", "", "");
    long long number = 0;
    try {
        number = one.integer("a vertex number");
    } catch (const std::exception&) {
        words.fail(fmt::format("'{}' is not the number of a vertex", digits.substr(0, 30)));
    }
    if (number < 0) number += static_cast<long long>(count) + 1;
    if (number < 1 || number > static_cast<long long>(count))
        words.fail(fmt::format("vertex {} is used, and {} have been defined so far", digits, count));
    return static_cast<std::size_t>(number - 1);
}

} // namespace

std::vector<FaceSoup> read_obj(std::string_view text, const std::string& file) {
    Words words(text, file, "", "#");
    std::vector<Vec3> vertices;
    std::vector<FaceSoup> soups;
    FaceSoup soup;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (word == "v") {
            const double x = words.number_in_line("x"), y = words.number_in_line("y");
            vertices.emplace_back(x, y, words.number_in_line("z"));
        } else if (word == "f") {
            std::vector<Vec3> loop;
            for (std::string_view w = words.next_in_line(); !w.empty(); w = words.next_in_line())
                loop.push_back(vertices[vertex_number(words, w, vertices.size())]);
            soup.loops.push_back(std::move(loop));
        } else if (word == "o" || word == "g") {
            soups.push_back(std::move(soup));
            soup = {std::string(words.next_in_line()), {}};
        }
        words.skip_line(); // normals, textures and other records are ignored
    }
    soups.push_back(std::move(soup));
    return soups;
}

} // namespace kaya
