#include "geometry/read/read_fractures.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/read/text_lines.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

constexpr const char* what_to_write[] = {"write lines of: x y z dip dip-direction diameter",
                                         "write lines of: x y z, and an empty line after each polygon",
                                         "write lines of: x1 y1 z1 x2 y2 z2, or x1 y1 z1 x2 y2 z2 dip dip-direction"};

/// Adds what a file says, with the line in every message.
class FractureLines {
public:
    FractureLines(std::string file, FractureFormat format) : file_(std::move(file)), format_(format) {}

    void read(int line, std::string_view content) {
        stop_point();
        const auto words = words_of(content.substr(0, content.find('#')));
        const bool remark = words.empty() || (!begun_ && !number(words.front()));
        if (words.empty() ? content.find('#') == content.npos : remark) end_polygon();
        begun_ = begun_ || !words.empty();
        if (remark) return;
        line_ = line;
        std::vector<double> values;
        for (const auto& word : words) {
            const auto value = number(word);
            if (!value && format_ == FractureFormat::polygons && values.empty()) return end_polygon();
            if (!value) fail(fmt::format("'{}' is not a number", word));
            values.push_back(*value);
        }
        switch (format_) {
        case FractureFormat::discs: return disc(values);
        case FractureFormat::polygons: return corner(values);
        case FractureFormat::traces: return trace(values);
        case FractureFormat::fracman: break; // has its own reader
        }
    }
    std::vector<Fracture> finish() {
        end_polygon();
        if (fractures_.empty()) throw Diagnostic(fmt::format("{} has no fractures", file_), hint());
        return std::move(fractures_);
    }

private:
    const char* hint() const { return what_to_write[static_cast<int>(format_)]; }
    [[noreturn]] void fail(const std::string& message) const {
        throw Diagnostic(fmt::format("{}, line {}: {}", file_, line_, message), hint());
    }

    void disc(const std::vector<double>& v) {
        if (v.size() != 6) fail(fmt::format("{} words where a fracture has six numbers", v.size()));
        if (v[5] > largest_fracture)
            fail(fmt::format("the diameter of a fracture must be at most {:g}, not {:g}", largest_fracture, v[5]));
        if (!(v[5] > 0)) fail(fmt::format("the diameter of a fracture must be greater than 0, not {:g}", v[5]));
        fractures_.push_back({{{v[0], v[1], v[2]}, v[3], v[4], v[5]}});
    }
    void corner(const std::vector<double>& v) {
        if (v.size() != 3) fail(fmt::format("{} words where a corner has three numbers", v.size()));
        corners_.emplace_back(v[0], v[1], v[2]);
    }
    void end_polygon() {
        if (corners_.empty()) return;
        try {
            fractures_.push_back(polygon_fracture(corners_));
        } catch (const Diagnostic& mistake) {
            throw Diagnostic(fmt::format("{}, the polygon that ends in line {}: {}", file_, line_, mistake.message),
                             mistake.hint);
        }
        corners_.clear();
    }
    void trace(const std::vector<double>& v) {
        if (v.size() != 6 && v.size() != 8)
            fail(fmt::format("{} words where a trace has six numbers or eight", v.size()));
        const Vec3 from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
        const double length = (to - from).norm();
        if (!(length > 0)) fail("the trace has no length");
        const Vec3 along = (to - from) / length;
        // Upright: the steepest plane through the trace. A trace that is upright itself has none.
        Vec3 normal = along.cross(Vec3::UnitZ());
        if (v.size() == 8) {
            constexpr double sine_of_off = 0.5; // 30 degrees
            const Vec3 given = normal_from_dip(v[6], v[7]);
            if (std::abs(given.dot(along)) > sine_of_off)
                fail(fmt::format(
                    "a fracture of dip {:g} and dip direction {:g} does not pass along the trace: it is {:.0f} "
                    "degrees off",
                    v[6], v[7], std::asin(std::min(std::abs(given.dot(along)), 1.0)) * 57.29577951308232));
            normal = given - given.dot(along) * along;
        }
        constexpr double least = 1e-9;
        if (!(normal.norm() > least)) fail("an upright trace needs the dip and the dip direction of its fracture");
        Disc made{0.5 * (from + to), 0, 0, length};
        set_normal(made, normal.normalized());
        fractures_.push_back({made});
    }

    std::string file_;
    FractureFormat format_;
    bool begun_ = false;
    int line_ = 0;
    std::vector<Vec3> corners_;
    std::vector<Fracture> fractures_;
};

} // namespace

std::vector<Fracture> read_fractures(std::string_view text, const std::string& file, FractureFormat format) {
    if (format == FractureFormat::fracman) return read_fracman(text, file);
    FractureLines lines(file, format);
    each_line(text, [&](int line, std::string_view content) { lines.read(line, content); });
    return lines.finish();
}

} // namespace kaya
