#include "geometry/read/read_discs.hpp"

#include "base/diagnostic.hpp"
#include "geometry/read/text_lines.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya {

std::vector<Disc> read_discs(std::string_view text, const std::string& file) {
    std::vector<Disc> discs;
    bool begun = false;
    each_line(text, [&](int line, std::string_view content) {
        const auto words = words_of(content.substr(0, content.find('#')));
        if (words.empty()) return;
        const bool heads = !begun && !number(words.front());
        begun = true;
        if (heads) return;
        std::array<double, 6> values{};
        if (words.size() != values.size())
            throw Diagnostic(
                fmt::format("{}, line {}: {} words where a fracture has six numbers", file, line, words.size()),
                "write: x y z dip dip-direction diameter");
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto value = number(words[i]);
            if (!value)
                throw Diagnostic(fmt::format("{}, line {}: '{}' is not a number", file, line, words[i]),
                                 "write: x y z dip dip-direction diameter");
            values[i] = *value;
        }
        if (!(values[5] > 0))
            throw Diagnostic(fmt::format("{}, line {}: the diameter of a fracture must be greater than 0, not {:g}",
                                         file, line, values[5]));
        discs.push_back({{values[0], values[1], values[2]}, values[3], values[4], values[5]});
    });
    if (discs.empty())
        throw Diagnostic(fmt::format("{} has no fractures", file), "write lines of: x y z dip dip-direction diameter");
    return discs;
}

} // namespace kaya
