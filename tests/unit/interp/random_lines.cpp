// Random lines of words of the tables, numbers and odd characters: any input is either bound or refused with a message and its position.
#include "bound.hpp"

#include "lang/interp/help.hpp"

#include <random>

namespace kaya::lang {
namespace {

std::vector<std::string> dictionary() {
    std::vector<std::string> words = {"1",      "-0.5",  "1e-6",     "3.",   "1e999", "@x",   "@f(1,2)", "[a+b]",
                                      "'text'", "'open", "\"",       "[",    "@f(",   "@",    "&",       "...",
                                      ";",      "?",     "\n",       "=",    ",",     "(",    ")",       "end",
                                      "endlua", "\t",    "\xC3\xA9", "\xFF", "''",    "range"};
    const auto add_keywords = [&](const auto& self, const std::vector<KeywordSpec>& keywords) -> void {
        for (const auto& keyword : keywords) {
            for (const Spelling& s : keyword.words) words.emplace_back(s.word);
            self(self, keyword.keywords);
        }
    };
    for (const Language* dialect : {&classic(), &modern()}) {
        for_each_command(*dialect, [&](const CommandSpec& command) {
            for (const Spelling& s : command.words) words.emplace_back(s.word);
            for (const auto& spellings : command.form)
                for (const Spelling& s : spellings) words.emplace_back(s.word);
            add_keywords(add_keywords, command.keywords);
        });
        add_keywords(add_keywords, dialect->range_elements);
    }
    return words;
}

/// Only the engine itself is used: distributions differ from one standard library to the next.
std::size_t pick(std::mt19937& random, std::size_t count) { return random() % count; }

class RandomLines : public testing::Test {
protected:
    std::string line() {
        std::string text;
        const std::size_t count = 1 + pick(random, 12);
        for (std::size_t i = 0; i < count; ++i) {
            text += words[pick(random, words.size())];
            if (pick(random, 8) == 0) text.erase(pick(random, text.size()), 1);
            if (pick(random, 6) != 0) text += ' ';
        }
        return text;
    }

    std::mt19937 random{20260101};
    std::vector<std::string> words = dictionary();
};

TEST_F(RandomLines, AreBoundOrRefused) {
    int accepted = 0, refused = 0;
    const auto values = [](const std::string&, const Place&) { return Value(2.5); };
    const ValueSource source = values;
    for (int i = 0; i < 75000; ++i) {
        const std::string text = line();
        Lexer lexer(source_from_text("random", text));
        Statement statement;
        try {
            while (next_statement(language(), lexer, statement)) {
                const BoundCommand command = bind_statement(language(), statement);
                (void)command.text();
                ++accepted;
                if (command.late) (void)bind_statement(language(), statement, &source);
            }
        } catch (const Diagnostic& d) {
            ++refused;
            ASSERT_TRUE(d.place) << text << "\n" << d.message;
            ASSERT_FALSE(d.message.empty());
            ASSERT_FALSE(render(d).empty());
        }
    }
    EXPECT_GT(accepted, 500);
    EXPECT_GT(refused, 5000);
}

TEST_F(RandomLines, CanBeCompletedAndAskedAbout) {
    for (int i = 0; i < 3000; ++i) {
        const std::string text = line();
        if (text.find('\n') == std::string::npos) (void)completions(language(), text);
        (void)needs_more(language(), text);
        try {
            (void)help_on(language(), text);
        } catch (const Diagnostic&) {}
    }
}

} // namespace
} // namespace kaya::lang
