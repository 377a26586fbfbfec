// Designs of pits from files.
#include "geometry/ground/pit.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"
#include "geometry/read/text_lines.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

class PitReader {
public:
    explicit PitReader(const std::string& file) : file_(file) {}

    void line(int number, std::string_view content) {
        line_ = number;
        const auto words = words_of(content.substr(0, content.find('#')));
        if (words.empty()) return;
        if (kaya::number(words.front())) add_point(words);
        else if (const std::string word = lower_case(words.front()); word == "crest" || word == "toe") {
            expect(words, 0, "x y z of its corners on the lines after it");
            design_.toe = word == "toe";
            outline_begun_ = true;
        } else if (word == "ramp") add_ramp(words);
        else add_number(word, words);
    }

    Ground surface() {
        line_ = 0;
        if (design_.bench == 0) fail("a pit needs the height of its benches", "write: bench 15");
        if (design_.angle == 0) fail("a pit needs the angle of its faces", "write: angle 65");
        if (outline_.size() > 1 && outline_.front() == outline_.back()) outline_.pop_back();
        return pit_surface(outline_, design_);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
        throw Diagnostic(line_ > 0 ? fmt::format("{}:{}: {}", file_, line_, what) : fmt::format("{}: {}", file_, what),
                         hint);
    }
    void expect(const std::vector<std::string_view>& words, std::size_t numbers, std::string_view what) const {
        if (words.size() != numbers + 1)
            fail(fmt::format("{} words after '{}', and there must be {}", words.size() - 1, words.front(), numbers),
                 std::string(what));
    }
    double above_zero(std::string_view word, std::string_view name) const {
        const auto value = kaya::number(word);
        if (!value) fail(fmt::format("'{}' is not a number", word), fmt::format("{} is one", name));
        if (!(*value > 0)) fail(fmt::format("{} must be greater than 0, not {:g}", name, *value), "");
        return *value;
    }

    void add_number(const std::string& word, const std::vector<std::string_view>& words) {
        const bool known = word == "bench" || word == "benches" || word == "angle" || word == "berm";
        if (!known)
            fail(fmt::format("'{}' is not a word of a pit", words.front()),
                 "known: bench, benches, angle, berm, ramp, crest, toe");
        expect(words, 1, "one number");
        const bool may_be_zero = word == "berm" && kaya::number(words[1]) == 0.0;
        const double value = may_be_zero ? 0 : above_zero(words[1], word);
        constexpr double most_benches = 200;
        if (word == "benches" && (value != std::floor(value) || value > most_benches))
            fail(fmt::format("benches must be a whole number up to {:g}, not {:g}", most_benches, value), "");
        if (word == "angle" && value >= 90)
            fail(fmt::format("angle must be less than 90, not {:g}", value),
                 "a wall has one height at each place of the plan");
        if (word == "bench") design_.bench = value;
        else if (word == "benches") design_.benches = static_cast<int>(value);
        else if (word == "angle") design_.angle = value;
        else design_.berm = value;
    }

    /// ramp WIDTH GRADIENT from X Y [clockwise]
    void add_ramp(const std::vector<std::string_view>& words) {
        const bool turns = words.size() == 7 && lower_case(words[6]) == "clockwise";
        if ((words.size() != 6 && !turns) || lower_case(words[3]) != "from" || !kaya::number(words[4]) ||
            !kaya::number(words[5]))
            fail("a ramp needs its width, its gradient and where it begins",
                 "write: ramp 20 0.1 from 0 150, and clockwise behind it where it goes down that way");
        design_.ramp = PitRamp{above_zero(words[1], "the width of a ramp"),
                               above_zero(words[2], "the gradient of a ramp"),
                               {*kaya::number(words[4]), *kaya::number(words[5])},
                               turns};
    }

    void add_point(const std::vector<std::string_view>& words) {
        if (!outline_begun_)
            fail("a point stands before the word crest or toe", "write crest, or toe, on the line above the outline");
        if (words.size() != 3 || !kaya::number(words[1]) || !kaya::number(words[2]))
            fail("a corner of the outline is three numbers: x y z", "");
        outline_.emplace_back(*kaya::number(words[0]), *kaya::number(words[1]), *kaya::number(words[2]));
    }

    const std::string& file_;
    int line_ = 0;
    PitDesign design_;
    bool outline_begun_ = false;
    std::vector<Vec3> outline_;
};

} // namespace

Ground ground_from_pit(std::string_view text, const std::string& file) {
    PitReader reader(file);
    each_line(text, [&](int line, std::string_view content) { reader.line(line, content); });
    try {
        return reader.surface();
    } catch (Diagnostic& wrong) {
        if (!wrong.message.starts_with(file)) wrong.message = fmt::format("{}: {}", file, wrong.message);
        throw;
    }
}

} // namespace kaya
