// Fractures from a text of the fracture modeller FracMan (.fab).
#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "base/stop_point.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/read/read_fractures.hpp"
#include "geometry/read/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace kaya {
namespace {

/// Rounding of corners leaves them off their plane by less, in parts of the size of the polygon.
constexpr double most_rounding = 1e-3;

/// The corners in their mean plane, if they are off by rounding only.
std::vector<Vec3> flattened(std::vector<Vec3> corners) {
    const Vec3 area = area_vector(corners);
    if (!(area.norm() > 0)) return corners;
    const Vec3 normal = area.normalized();
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : corners) middle += (corner - corners.front()) / static_cast<double>(corners.size());
    middle += corners.front();
    double size = 0, off = 0;
    for (const Vec3& corner : corners) {
        size = std::max(size, (corner - middle).norm());
        off = std::max(off, std::abs(normal.dot(corner - middle)));
    }
    if (off > most_rounding * size) return corners;
    for (Vec3& corner : corners) corner -= normal.dot(corner - middle) * normal;
    return corners;
}

/// Takes the lines one by one, with the line in every message.
class FracmanLines {
public:
    explicit FracmanLines(const std::string& file) : file_(file) {}

    void read(int line, std::string_view content) {
        stop_point();
        line_ = line;
        const auto words = words_of(content);
        if (words.empty()) return;
        const std::string first = lower_case(std::string(words[0]));
        const std::string second = words.size() > 1 ? lower_case(std::string(words[1])) : std::string();
        if (first == "begin" || first == "end") return border(first == "begin", second);
        if (section_ == "format") return format(content);
        if (section_ == "sets") return set_name(content);
        if (section_ == "fracture") return fracture_line(words);
        if (section_.empty()) fail("this line stands outside of all sections", "a text begins with BEGIN FORMAT");
        if (section_ != "properties")
            fail(fmt::format("the section {} is not read", section_), "export plane fractures only");
    }
    std::vector<Fracture> finish() {
        if (!section_.empty())
            fail(fmt::format("the section {} does not end", section_), "look whether the file is truncated");
        if (fractures_.empty())
            throw Diagnostic(fmt::format("{} has no fractures", file_), "a text has a section FRACTURE with polygons");
        if (announced_ && *announced_ != static_cast<double>(fractures_.size()))
            throw Diagnostic(
                fmt::format("{} announces {:g} fractures and has {}", file_, *announced_, fractures_.size()),
                "look whether the file is truncated");
        return std::move(fractures_);
    }

private:
    [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
        throw Diagnostic(fmt::format("{}, line {}: {}", file_, line_, message), hint);
    }

    void border(bool begins, const std::string& name) {
        if (begins && !section_.empty())
            fail(fmt::format("a section begins in the section {}", section_), "end it before");
        if (!begins && name != section_)
            fail(fmt::format("the end of '{}' is not that of a section that is open", name), "look at the lines above");
        if (!begins && left_ > 0)
            fail(fmt::format("the fracture that begins in line {} is not complete", begun_),
                 "look whether the file is truncated");
        section_ = begins ? name : std::string();
    }

    /// name = value, the value without quotes.
    std::pair<std::string, std::string> entry(std::string_view content) const {
        const std::size_t equals = content.find('=');
        if (equals == content.npos) fail("an '=' is missing", "write: name = value");
        const auto bare = [](std::string_view part) {
            constexpr std::string_view around = " \t\r\"";
            const std::size_t first = part.find_first_not_of(around);
            if (first == part.npos) return std::string();
            return std::string(part.substr(first, part.find_last_not_of(around) - first + 1));
        };
        return {lower_case(bare(content.substr(0, equals))), bare(content.substr(equals + 1))};
    }
    void format(std::string_view content) {
        const auto [name, value] = entry(content);
        if (name == "format" && lower_case(value) != "ascii")
            fail(fmt::format("the format {} is not read", value), "export the file as text: Format = Ascii");
        if (name == "xaxis" && lower_case(value) != "east")
            fail(fmt::format("the x axis points {}, not East", value), "export the file with XAxis = East");
        if (name == "no_fractures") {
            announced_ = number(value);
            if (!announced_) fail(fmt::format("'{}' is not a number", value), "write: No_Fractures = n");
        }
    }
    void set_name(std::string_view content) {
        const auto [name, value] = entry(content);
        if (name.starts_with("set")) sets_[name.substr(3)] = value;
    }

    double number_in(std::string_view word) const {
        const auto value = number(word);
        if (!value) fail(fmt::format("'{}' is not a number", word), hint);
        return *value;
    }
    void fracture_line(const std::vector<std::string_view>& words) {
        if (left_ == 0) return begin_fracture(words);
        if (words.size() != 4)
            fail(fmt::format("{} words where a corner has a number and x, y, z", words.size()), hint);
        const bool is_normal = number_in(words[0]) == 0 && left_ == 1;
        const Vec3 place(number_in(words[1]), number_in(words[2]), number_in(words[3]));
        if (--left_ > 0) corners_.push_back(place);
        else if (is_normal) end_fracture();
        else fail("the last line of a fracture, 0 and the normal, is missing", hint);
    }
    void begin_fracture(const std::vector<std::string_view>& words) {
        constexpr double most_corners = 10'000;
        if (words.size() < 3) fail("a fracture has a number, a number of corners and a set", hint);
        number_in(words[0]);
        const double corners = number_in(words[1]);
        if (!(corners >= 3 && corners <= most_corners && corners == std::floor(corners)))
            fail(fmt::format("a fracture has from 3 to {:g} corners, not {}", most_corners, words[1]), hint);
        begun_ = line_;
        left_ = static_cast<int>(corners) + 1; // and the normal
        corners_.clear();
        const auto name = sets_.find(std::string(words[2]));
        set_ = name == sets_.end() || name->second.empty() ? std::string(words[2]) : name->second;
    }
    void end_fracture() {
        try {
            fractures_.push_back(polygon_fracture(flattened(corners_)));
        } catch (const Diagnostic& mistake) {
            throw Diagnostic(fmt::format("{}, the fracture that begins in line {}: {}", file_, begun_, mistake.message),
                             mistake.hint);
        }
        set_group(fractures_.back(), "set=" + set_);
    }

    static constexpr const char* hint =
        "write: number corners set, then lines of number x y z for each corner, then 0 and the normal";

    const std::string& file_;
    int line_ = 0, begun_ = 0, left_ = 0; ///< lines that the fracture still has
    std::string section_, set_;
    std::optional<double> announced_;
    std::map<std::string, std::string> sets_; ///< names by number
    std::vector<Vec3> corners_;
    std::vector<Fracture> fractures_;
};

} // namespace

std::vector<Fracture> read_fracman(std::string_view text, const std::string& file) {
    FracmanLines lines(file);
    each_line(text, [&](int line, std::string_view content) { lines.read(line, content); });
    return lines.finish();
}

} // namespace kaya
