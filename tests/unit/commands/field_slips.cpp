// Fields of Lua with one wrong letter: the right one is proposed in nine of ten cases.
#include "one_letter_slips.hpp"
#include "running.hpp"

#include "lang/script/values/field_index.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace kaya {
namespace {

std::string proposal(const std::vector<script::FieldInfo>& fields, const std::string& slip) {
    try {
        script::fail_unknown_field("a block", fields, slip);
    } catch (const Diagnostic& mistake) {
        const auto from = mistake.hint.find('\''), to = mistake.hint.rfind('\'');
        return from == to ? "" : mistake.hint.substr(from + 1, to - from - 1);
    }
}

class FieldSlips : public Running {};

TEST_F(FieldSlips, NineOfTenGetTheRightProposal) {
    std::mt19937_64 random(17);
    int right = 0, asked = 0;
    std::size_t names = 0;
    std::string missed;
    const auto measure = [&](const std::vector<script::FieldInfo>& fields) {
        std::set<std::string, std::less<>> known;
        for (const auto& field : fields) known.insert({std::string(field.name), std::string(field.classic)});
        for (const auto& field : fields) {
            ++names;
            for (const auto& slip : one_letter_slips(field.name, random)) {
                if (known.contains(slip)) continue; // another field: no proposal
                ++asked;
                const std::string near = proposal(fields, slip);
                if (near == field.name) ++right;
                else missed += fmt::format("{} -> {} for {}\n", slip, near, field.name);
            }
        }
    };
    for (const auto& table : session().engine.world.tables()) measure(table.fields);
    measure(session().engine.world.globals());
    fmt::print("{} of {} slips in {} fields of Lua get the right proposal: {:.1f} %\n", right, asked, names,
               100.0 * right / asked);
    EXPECT_GT(asked, 5000);
    EXPECT_GE(right, 0.9 * asked) << missed;
}

} // namespace
} // namespace kaya
