// Fields of Lua with one letter wrong: the right one is proposed in nine of ten cases.
#include "running.hpp"

#include "lang/script/field_index.hpp"

#include <gtest/gtest.h>
#include <set>

namespace kaya {
namespace {

/// A letter missing, doubled, exchanged with its neighbour, or another one.
std::set<std::string> slips_of(std::string_view name) {
    std::set<std::string> slips;
    for (std::size_t i = 0; i < name.size(); ++i) {
        std::string slip(name);
        slips.insert(std::string(slip).erase(i, 1));
        slips.insert(std::string(slip).insert(i, 1, name[i]));
        for (const char other : {'e', 'k', 's'}) {
            slip = name;
            slip[i] = other;
            slips.insert(slip);
        }
        if (i + 1 == name.size()) continue;
        slip = name;
        std::swap(slip[i], slip[i + 1]);
        slips.insert(slip);
    }
    return slips;
}

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
    int right = 0, all = 0;
    for (const auto& table : session().world.tables()) {
        std::set<std::string, std::less<>> known;
        for (const auto& field : table.fields) known.insert({std::string(field.name), std::string(field.classic)});
        for (const auto& field : table.fields) {
            if (field.name.size() < 2) continue; // x with a letter wrong is another name
            for (const auto& slip : slips_of(field.name)) {
                if (known.contains(slip)) continue;
                ++all;
                right += proposal(table.fields, slip) == field.name;
            }
        }
    }
    EXPECT_GT(all, 5000);
    EXPECT_GE(right, 0.9 * all);
    RecordProperty("percent", 100 * right / all);
}

} // namespace
} // namespace kaya
