// Triangulated surfaces of GOCAD (.ts): objects of VRTX, PVRTX, ATOM and TRGL lines.
#include "geometry/read/surface_files.hpp"
#include "geometry/read/words.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace kaya {
namespace {

class GocadReader {
public:
    GocadReader(std::string_view text, const std::string& file) : words_(text, file, "", "#") {}

    std::vector<FaceSoup> read() {
        while (!words_.peek().empty()) object();
        return std::move(soups_);
    }

private:
    void object() {
        words_.expect("GOCAD");
        if (const std::string_view kind = words_.next_in_line(); !same_word(kind, "TSurf"))
            words_.fail(fmt::format("the object is a '{}'", kind.substr(0, 30)),
                        "triangulated surfaces, TSurf, are read");
        words_.skip_line();
        soup_ = {};
        corners_.clear();
        double up = 1;
        for (std::string_view word = words_.next();; word = words_.next()) {
            if (word.empty()) words_.fail("the file ends before 'END'");
            if (word == "END") break;
            if (word == "VRTX" || word == "PVRTX") corner(up);
            else if (word == "ATOM" || word == "PATOM") alias();
            else if (word == "TRGL") triangle();
            else if (word == "name" || word.starts_with("name:")) name(word);
            else if (word == "ZPOSITIVE") up = same_word(words_.next_in_line(), "Depth") ? -1 : 1;
            words_.skip_line(); // properties and other records are ignored
        }
        soups_.push_back(std::move(soup_));
    }

    void name(std::string_view word) {
        const std::string_view joined = word.substr(std::min(word.size(), std::string_view("name:").size()));
        std::string_view next = joined.empty() ? words_.next_in_line() : joined;
        if (next == ":") next = words_.next_in_line();
        for (; !next.empty(); next = words_.next_in_line())
            soup_.name += (soup_.name.empty() ? "" : " ") + std::string(next);
    }

    void corner(double up) {
        const long long number = words_.integer_in_line("the number of a vertex");
        Vec3 place;
        for (int k = 0; k < 3; ++k) place[k] = words_.number_in_line("a coordinate");
        place.z() *= up;
        add(number, place);
    }

    /// Another number for a vertex.
    void alias() {
        const long long number = words_.integer_in_line("the number of a vertex");
        add(number, find(words_.integer_in_line("the number of the vertex that it repeats")));
    }

    void triangle() {
        std::vector<Vec3> loop;
        for (int k = 0; k < 3; ++k) loop.push_back(find(words_.integer_in_line("the number of a vertex")));
        soup_.loops.push_back(std::move(loop));
    }

    void add(long long number, const Vec3& place) {
        if (!corners_.emplace(number, place).second) words_.fail(fmt::format("vertex {} is defined twice", number));
    }

    const Vec3& find(long long number) const {
        const auto found = corners_.find(number);
        if (found == corners_.end()) words_.fail(fmt::format("vertex {} has not been defined above", number));
        return found->second;
    }

    Words words_;
    FaceSoup soup_;
    std::map<long long, Vec3> corners_;
    std::vector<FaceSoup> soups_;
};

} // namespace

std::vector<FaceSoup> read_gocad(std::string_view text, const std::string& file) {
    return GocadReader(text, file).read();
}

} // namespace kaya
