// Errors at run time of a command point at the word of the line that they name.
#include "running.hpp"

namespace kaya {
namespace {

class NamedWords : public Running {
protected:
    /// Column and length of the error of the text.
    std::pair<int, int> place_of(const std::string& text) {
        const Diagnostic problem = mistake(text);
        EXPECT_NE(problem.message, "") << text;
        return {problem.place.column, problem.place.length};
    }
};

TEST_F(NamedWords, a_missing_file_is_underlined) {
    run("poly brick 0 1 0 1 0 1");
    EXPECT_EQ(place_of("cut ground nowhere.xyz shift 0 0 1"), std::pair(12, 11));
    EXPECT_EQ(place_of("cut ground 'no where'"), std::pair(12, 10));
    EXPECT_EQ(place_of("restore nowhere"), std::pair(9, 7)); // the message adds the suffix
    EXPECT_EQ(place_of("call nowhere.3dd"), std::pair(6, 11));
    EXPECT_EQ(place_of("water ground &\n 'nowhere'"), std::pair(2, 9));
}

TEST_F(NamedWords, an_error_that_names_no_word_points_at_the_command) {
    EXPECT_EQ(place_of("limit equilibrium"), std::pair(1, 5));
}

} // namespace
} // namespace kaya
