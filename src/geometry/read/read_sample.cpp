#include "geometry/read/read_sample.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/fractures/fracture.hpp"
#include "geometry/read/text_lines.hpp"

#include <fmt/format.h>
#include <span>

namespace kaya {
namespace {

/// What a sample consists of.
struct SampleForm {
    std::size_t values; ///< numbers of one value
    const char *one, *many, *hint;
};
constexpr SampleForm planes_form{2, "plane", "planes",
                                 "write lines of: dip dip-direction, or number dip dip-direction weight"};
constexpr SampleForm sizes_form{1, "size", "sizes", "write lines of: diameter, or number diameter weight"};

/// Rows of a sample, with the line in every message.
class SampleLines {
public:
    SampleLines(const std::string& file, const SampleForm& form) : file_(file), form_(form) {}

    /// Calls add(numbers of the value, weight) for each line.
    template <class Add> void read(std::string_view text, Add add) {
        each_line(text, [&](int line, std::string_view content) {
            stop_point();
            line_ = line;
            const auto words = words_of(content.substr(0, content.find('#')));
            if (words.empty() || content[content.find_first_not_of(" \t")] == ';') return;
            const bool heading = rows_++ == 0 && !number(words.front());
            if (!heading) row(words, add);
        });
        if (taken_ == 0) throw Diagnostic(fmt::format("{} has no {}", file_, form_.many), form_.hint);
        if (weighty_ == 0)
            throw Diagnostic(fmt::format("all weights in {} are 0", file_),
                             fmt::format("give a {} a weight above 0", form_.one));
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw Diagnostic(fmt::format("{}, line {}: {}", file_, line_, message), form_.hint);
    }

private:
    template <class Add> void row(const std::vector<std::string_view>& words, Add add) {
        constexpr std::size_t most_values = 1'000'000;
        const std::size_t least = form_.values, most = form_.values + 2;
        if (words.size() < least || words.size() > most)
            fail(fmt::format("{} words where a {} has {} to {} numbers", words.size(), form_.one, least, most));
        if (columns_ != 0 && words.size() != columns_)
            fail(fmt::format("{} words, and {} in the lines above", words.size(), columns_));
        columns_ = words.size();
        std::vector<double> numbers;
        for (const auto& word : words) {
            const auto value = number(word);
            if (!value) fail(fmt::format("'{}' is not a number", word));
            numbers.push_back(*value);
        }
        const double weight = columns_ == most ? numbers.back() : 1;
        if (!(weight >= 0 && weight <= 1e12)) fail(fmt::format("a weight must be from 0 to 1e12, not {:g}", weight));
        if (++taken_ > most_values) fail(fmt::format("there are more than {} {}", most_values, form_.many));
        weighty_ += weight > 0;
        const std::size_t first = columns_ == least ? 0 : 1; // behind the number of the plane or size
        add(std::span(numbers).subspan(first, form_.values), weight);
    }

    const std::string& file_;
    const SampleForm& form_;
    int line_ = 0;
    std::size_t rows_ = 0, taken_ = 0, weighty_ = 0, columns_ = 0;
};

} // namespace

Sample<MeasuredPlane> read_planes(std::string_view text, const std::string& file) {
    Sample<MeasuredPlane> sample;
    SampleLines lines(file, planes_form);
    lines.read(text, [&](std::span<const double> v, double weight) {
        if (!(v[0] >= 0 && v[0] <= 90)) lines.fail(fmt::format("a dip must be from 0 to 90 degrees, not {:g}", v[0]));
        if (!(v[1] >= -360 && v[1] <= 360))
            lines.fail(fmt::format("a dip direction must be from -360 to 360 degrees, not {:g}", v[1]));
        const double turned = v[1] < 0 ? v[1] + 360 : v[1];
        if (weight > 0) sample.add({v[0], turned < 360 ? turned : 0}, weight);
    });
    return sample;
}

Sample<double> read_diameters(std::string_view text, const std::string& file) {
    Sample<double> sample;
    SampleLines lines(file, sizes_form);
    lines.read(text, [&](std::span<const double> v, double weight) {
        if (!(v[0] > 0)) lines.fail(fmt::format("a diameter must be greater than 0, not {:g}", v[0]));
        if (v[0] > largest_fracture)
            lines.fail(fmt::format("a diameter must be at most {:g}, not {:g}", largest_fracture, v[0]));
        if (weight > 0) sample.add(v[0], weight);
    });
    return sample;
}

} // namespace kaya
