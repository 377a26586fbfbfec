// Every command of the direct shear test binds, in the spelling of its author.
#include "bound.hpp"

namespace kaya::lang {
namespace {

constexpr const char* deck = R"(; direct shear test
config cppudm
;bottom block
poly brick -0.15,0.15 -0.10,0.10 -0.10,0.0
gen edge 1
poly brick -0.10,0.10 -0.1,0.10 0.0,0.10
gen edge 0.2
set jcondf 1
set jmatdf 1
prop mat 1 jkn 1e2 jks 1e4 jfric 10 jcoh 5e3
jmodel model barton-bandis
prop mat=1 density = 0.0026 k=4e3 g=3e3
jmodel jkn=1e5 jks=1e4 resfriction=20.0 jcso=100 jrco=15 sigmac=150 nj = 0.8 lo = 0.1 ln=0.2
hide range z 0 .1
bound xvel = 0 zvel=0 range zr -1 0.01
seek
bound str 0 0 -5 0 0 0 range z .09 .11
step 1000
pl block
pl reset
def av_str
whilestepping
ic = contact_head
loop while ic # 0
if ncon # 0
njdisp = -1800 * njdisp / ncon
endif
endloop
end
reset disp
reset jdisp
hide range z -.1 0
bound xvel=0.8 range z -.1 1.1
bound yvel=0.0 range z -.1 1.1
seek
hist unbal ncyc 5
hist @sstav @nstav @njdisp @sjdisp
hist sdis -1 -1 0 ndis -1 -1 0
hist sstr 0 0 0 nstr 0 0 0
hist sfor -1 -1 0 nfor -1 -1 0
hist szz 0 0 0.1
hist zdisp 0 0 0.1
hist label 2 'Shear Stress'
cyc 20000
;
return
)";

TEST(DirectShear, BindsWhole) {
    const auto bound = bind_text(classic(), source_from_text("shear.3dd", deck), {"."});
    ASSERT_EQ(bound->steps.size(), 35u);
    EXPECT_EQ(bound->steps.back().command.spec->name(), "return");
    for (const auto& step : bound->steps) EXPECT_FALSE(step.command.late) << step.command.text();
}

TEST(DirectShear, BindsInCapitalsWithOtherLineEnds) {
    std::string shouted;
    for (const char* c = deck; *c; ++c) {
        if (*c == '\n') shouted += "\t\r\n";
        else shouted += *c >= 'a' && *c <= 'z' ? static_cast<char>(*c - 'a' + 'A') : *c;
    }
    EXPECT_EQ(bind_text(classic(), source_from_text("SHEAR.3DD", shouted), {"."})->steps.size(), 35u);
}

} // namespace
} // namespace kaya::lang
