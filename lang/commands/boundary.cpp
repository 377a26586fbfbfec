// Loads, velocities and initial values.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

constexpr const char* velocity_words[3][2] = {
    {"xvel", "xvelocity"}, {"yvel", "yvelocity"}, {"zvel", "zvelocity"}};

CommandSpec bound() {
    Entry<Boundary> entry({"boundary"});
    entry.help("drives or loads gridpoints and vertices at the boundary of visible blocks");
    entry.place(&Boundary::place);
    static constexpr const char* load[] = {"xload", "yload", "zload"};
    static constexpr const char* free[] = {"xfree", "yfree", "zfree"};
    for (std::size_t i = 0; i < 3; ++i) {
        entry.keyword({velocity_words[i][0], velocity_words[i][1]}, real("v").unit("velocity"),
                      [i](Boundary& b) -> auto& { return b.velocity[i]; }, "velocity held constant");
        entry.keyword({load[i]}, real("f").unit("force"), [i](Boundary& b) -> auto& { return b.load[i]; },
                      "force added at every vertex");
        entry.action({free[i]}, [i](Boundary& b) { b.free[i] = true; }, "no longer held in this direction");
    }
    entry.keyword({"stress"}, tensor("sxx syy szz sxy sxz syz").unit("stress"), &Boundary::stress,
                  "stress on the boundary faces, compression negative");
    entry.keyword({"xgradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"),
                  &Boundary::x_gradient, "change of the stress with x");
    entry.keyword({"ygradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"),
                  &Boundary::y_gradient, "change of the stress with y");
    entry.keyword({"zgradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"),
                  &Boundary::z_gradient, "change of the stress with z");
    entry.range(&Boundary::range);
    entry.finish([](const Reader& reader, Boundary& b) {
        bool given = b.stress.has_value();
        for (std::size_t i = 0; i < 3; ++i) given = given || b.velocity[i] || b.load[i] || b.free[i];
        const std::array<double, 6> none{};
        const bool gradient = b.x_gradient != none || b.y_gradient != none || b.z_gradient != none;
        if (gradient && !b.stress)
            incomplete_line(reader, "a gradient of stress needs the stress at the origin",
                            "write: bound stress sxx syy szz sxy sxz syz xgrad ...");
        if (!given)
            incomplete_line(reader, "bound does not say what acts on the boundary",
                            "expected: xvel, xload, xfree (or y, z) or stress");
    });
    entry.right("bound xvel = 0 zvel=0 range zr -1 0.01").right("bound str 0 0 -5 0 0 0 range z .09 .11");
    entry.right("bound zload -1e4 range group roof").right("bound xfree yfree zfree");
    entry.right("bound stress -1 -1 -2 0 0 0 zgrad 0.1 0.1 0.2 0 0 0 range x 0");
    entry.right("bound xvel @v y 0 1");
    entry.wrong("bound", "bound does not say what acts on the boundary");
    entry.wrong("bound xvel range x 0", "'range' stands where a number must be");
    entry.wrong("bound xvle 0", "'xvle' is not a keyword of boundary");
    entry.wrong("bound stress 0 0 -5", "a number is missing after '-5'");
    entry.wrong("bound stress 0 0 -5 0 0 0 0", "'0' stands where a keyword of boundary must be");
    entry.wrong("bound xgrad 1 0 0 0 0 0", "a gradient of stress needs the stress at the origin");
    return entry;
}

CommandSpec initialize() {
    Entry<Initialize> entry({"initialize"});
    entry.help("gives gridpoints and rigid blocks a velocity to start with");
    for (std::size_t i = 0; i < 3; ++i)
        entry.keyword({velocity_words[i][0], velocity_words[i][1]}, real("v").unit("velocity"),
                      [i](Initialize& c) -> auto& { return c.velocity[i]; }, "velocity");
    entry.range(&Initialize::range);
    entry.finish([](const Reader& reader, Initialize& c) {
        if (!c.velocity[0] && !c.velocity[1] && !c.velocity[2])
            incomplete_line(reader, "initialize does not say what to set",
                            "expected: xvel, yvel or zvel and a number");
    });
    entry.right("ini xvel 1").right("initialize xvel 0 yvel 0 zvel -2 range group ball");
    entry.wrong("ini", "initialize does not say what to set");
    entry.wrong("ini xvel", "a number is missing after 'xvel'");
    entry.wrong("ini zval 1", "'zval' is not a keyword of initialize");
    return entry;
}

} // namespace

Family boundary() {
    return {"boundary",
            "loads, velocities and initial values",
            {
                bound(),
                Entry<Fix>({"fix"})
                    .help("holds blocks where they are")
                    .range(&Fix::range)
                    .right("fix")
                    .right("fix range z -0.1 0")
                    .right("fix region 1")
                    .wrong("fix range z a", "'a' stands where a number must be")
                    .wrong("fix reigon 1", "'reigon' is not a keyword of fix"),
                Entry<Free>({"free"})
                    .help("lets fixed blocks move again")
                    .range(&Free::range)
                    .right("free")
                    .right("free range id 3 5")
                    .wrong("free range id 1.5", "id takes a whole number, not 1.5"),
                Entry<Gravity>({"gravity"})
                    .help("acceleration of gravity, the same everywhere")
                    .argument(vector("gx gy gz").unit("acceleration"), &Gravity::value)
                    .right("gravity 0 0 -9.81")
                    .right("grav (0,0,-10)")
                    .right("grav @g")
                    .wrong("gravity", "a number is missing after 'gravity'")
                    .wrong("gravity 0 0", "a number is missing after '0'")
                    .wrong("gravity 0 0 -9.81 1", "'1' is left over at the end of the line"),
                initialize(),
            }};
}

} // namespace kaya::lang
