// The list of names in docs/fish.md is that of the program. KAYA_BLESS=1 in the environment writes it again.
#include "one_letter_slips.hpp"
#include "running.hpp"

#include "lang/fish/nearest.hpp"
#include "lang/fish/reserved.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace kaya {
namespace {

constexpr std::string_view heading = "## Every name\n";

/// Words in lines of at most 110 letters.
std::string filled(const std::vector<std::string>& words) {
    std::string text, line;
    for (const auto& word : words) {
        if (!line.empty() && line.size() + word.size() + 1 > 110) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return text + line + "\n";
}

std::string name_list(Session& session) {
    std::vector<std::string> classic, modern;
    for (const auto& [name, writable] : session.engine.scripts->built_in_names())
        (name.find('.') == std::string::npos ? classic : modern).push_back(writable ? name + "*" : name);
    std::string text = fmt::format("{}\nSupported; those with `*` can also be set:\n\n{}", heading, filled(classic));
    text += fmt::format("\nNames of newer versions, with the meaning of the classic ones:\n\n{}", filled(modern));
    for (const bool planned : {true, false}) {
        text += planned ? "\nNot supported yet; to mention one is an error:\n\n"
                        : "\nNot planned; to mention one is an error (of a family like `cable_*`, to call one):\n\n";
        text += "| names | |\n|---|---|\n";
        std::vector<std::pair<std::string_view, std::string>> rows; // in the order of the table
        for (const auto& reserved : fish::reserved_names()) {
            if (reserved.planned != planned) continue;
            if (rows.empty() || rows.back().first != reserved.instead) rows.emplace_back(reserved.instead, "");
            rows.back().second += fmt::format("{}`{}`", rows.back().second.empty() ? "" : " ", reserved.name);
        }
        for (const auto& [instead, names] : rows) text += fmt::format("| {} | {} |\n", names, instead);
    }
    return text;
}

std::string contents(const char* file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

class FishNames : public Running {};

TEST_F(FishNames, ThePageListsEveryName) {
    const std::string page = contents(KAYA_FISH_PAGE);
    const auto from = page.find(heading);
    ASSERT_NE(from, std::string::npos) << "the page has no list of names";
    const auto next = page.find("\n## ", from);
    const std::string rest = next == std::string::npos ? "" : page.substr(next);
    const std::string wanted = name_list(session());
    if (std::getenv("KAYA_BLESS") != nullptr) std::ofstream(KAYA_FISH_PAGE) << page.substr(0, from) << wanted << rest;
    const std::string listed = page.substr(from, next == std::string::npos ? next : next - from);
    EXPECT_EQ(listed, wanted) << "run this test with KAYA_BLESS=1";
}

TEST_F(FishNames, NoNameIsBothKnownAndRefused) {
    for (const auto& [name, writable] : session().engine.scripts->built_in_names())
        EXPECT_EQ(fish::find_reserved(name), nullptr) << name;
}

TEST_F(FishNames, EveryRefusedNameIsAnErrorAtItsPosition) {
    for (const auto& reserved : fish::reserved_names()) {
        if (reserved.name.back() == '*') continue;
        const Diagnostic problem = mistake(fmt::format("def f\n  x = {}\nend\n", reserved.name));
        EXPECT_THAT(problem.message, testing::HasSubstr("of 3DEC is not supported")) << reserved.name;
        EXPECT_EQ(problem.code, "unsupported-fish-name");
        EXPECT_EQ(problem.place.line, 2) << reserved.name;
        EXPECT_EQ(problem.place.column, 7) << reserved.name;
    }
}

TEST_F(FishNames, ASlipOfOneLetterGetsTheRightProposal) {
    std::vector<std::string> names;
    for (const auto& [name, writable] : session().engine.scripts->built_in_names()) names.push_back(name);
    std::ranges::sort(names);
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    std::mt19937_64 random(17);
    int asked = 0, right = 0;
    std::string missed;
    for (const auto& name : names)
        for (const auto& typed : one_letter_slips(name, random)) {
            if (std::ranges::binary_search(names, typed)) continue; // another name: no proposal
            const auto near = fish::nearest_name(typed, candidates);
            ++asked;
            if (near == name) ++right;
            else missed += fmt::format("{} -> {} for {}\n", typed, near, name);
        }
    fmt::print("{} of {} slips in {} names of FISH get the right proposal: {:.1f} %\n", right, asked, names.size(),
               100.0 * right / asked);
    EXPECT_GT(asked, 20'000);
    EXPECT_GE(right, 0.9 * asked) << missed;
}

} // namespace
} // namespace kaya
