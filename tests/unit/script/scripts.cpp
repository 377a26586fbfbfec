#include "fake_world.hpp"

#include "lang/script/values/value_text.hpp"

#include <gmock/gmock.h>

namespace kaya::script::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The averaging function of the direct shear test, unchanged from its deck.
const char* const average_in_fish = R"(def av_str
whilestepping
sstav = 0.0
nstav = 0.0
njdisp = 0.0
sjdisp = 0.0
ncon = 0
jarea = 0.04
ic = contact_head
loop while ic # 0
icsub = c_cx(ic)
loop while icsub # 0
ncon = ncon + 1
sstav = sstav + cx_xsforce(icsub)
nstav = nstav + cx_nforce(icsub)
njdisp = njdisp + cx_ndis(icsub)
sjdisp = sjdisp + cx_xsdis(icsub)
icsub = cx_next(icsub)
endloop
if ncon # 0
sstav = sstav / jarea
nstav = nstav / jarea
njdisp = -1800 * njdisp / ncon
sjdisp = - sjdisp / ncon
endif
ic = c_next(ic)
endloop
end
)";

const char* const average_in_lua = R"(
function average()
    local shear, normal, closing, sliding, count = 0.0, 0.0, 0.0, 0.0, 0
    local area = 0.04
    for c in contacts() do
        for s in c:sub_contacts() do
            count = count + 1
            shear = shear + s.x_shear_force
            normal = normal + s.normal_force
            closing = closing + s.normal_displacement
            sliding = sliding + s.x_shear_displacement
        end
        if count ~= 0 then
            shear = shear / area
            normal = normal / area
            closing = -1800 * closing / count
            sliding = -sliding / count
        end
    end
    lua_shear, lua_normal, lua_closing, lua_sliding = shear, normal, closing, sliding
    return shear
end
hook.after_cycle(average)
)";

TEST(Scripts, AverageIsTheSameToTheLastBitInFishAndLua) {
    Stage s(2, 8);
    s.fish(average_in_fish);
    s.lua(average_in_lua);
    ASSERT_TRUE(s.scripts.has_hooks(Moment::after_cycle));
    EXPECT_FALSE(s.scripts.has_hooks(Moment::before_cycle));
    s.scripts.run_hooks(Moment::after_cycle, 1);
    s.lua("fish.a, fish.b, fish.c, fish.d = lua_shear, lua_normal, lua_closing, lua_sliding");
    EXPECT_NE(s.number("sstav"), 0);
    EXPECT_EQ(s.number("sstav"), s.number("a"));
    EXPECT_EQ(s.number("nstav"), s.number("b"));
    EXPECT_EQ(s.number("njdisp"), s.number("c"));
    EXPECT_EQ(s.number("sjdisp"), s.number("d"));
}

TEST(Scripts, ANameOfAFunctionRunsItWhereverItStands) {
    Stage s;
    s.fish("def outer\n outer = inner + 1\nend\n"); // inner is not defined yet
    s.fish("def inner\n inner = 41\n calls = calls + 1\nend\n");
    EXPECT_EQ(s.value("@outer"), Value(std::int64_t{42}));
    EXPECT_EQ(s.value("[inner + inner]"), Value(std::int64_t{82}));
    EXPECT_EQ(s.value("calls"), Value(std::int64_t{3}));
}

TEST(Scripts, PrintGoesToTheSink) {
    Stage s;
    s.fish("def say\n out('x = ' + string(1.0/3))\n out(vector(1,2.5,1e-7))\nend\n");
    s.scripts.call("@say");
    s.lua("print('a', 1, vector(1,2,3))\nio.write('b', 2)\nio.write('\\n')");
    EXPECT_THAT(s.printed, ElementsAre("x = 0.333333", "(1,2.5,1e-07)", "a\t1\t(1,2,3)", "b2"));
}

} // namespace
} // namespace kaya::script::test
