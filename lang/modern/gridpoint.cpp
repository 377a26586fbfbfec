// block gridpoint ...: velocities, forces and initial values of gridpoints, and of rigid blocks.
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

constexpr std::array<ComponentWords, 3> force_components{
    {{"force-x", "xload"}, {"force-y", "yload"}, {"force-z", "zload"}}};
constexpr std::array<ComponentWords, 3> displacement_components{
    {{"displacement-x", "xdis"}, {"displacement-y", "ydis"}, {"displacement-z", "zdis"}}};

template <class Values> bool any(const Values& values) {
    return std::ranges::any_of(values, [](const auto& value) { return static_cast<bool>(value); });
}

/// A word for all three of some flags, then the words of each.
void flags(Leaf<Boundary>& leaf, const char* word, std::array<ComponentWords, 3> components, std::string_view help,
           void (*all)(Boundary&)) {
    leaf.action(tree_words(word).front(), all, help);
    for (const auto& component : components) leaf.word(component.words, component.classic);
}

CommandSpec gridpoint_apply() {
    Leaf<Boundary> leaf("block gridpoint apply", "boundary");
    vector_words(
        leaf, "velocity", velocity_components, "velocity",
        [](Boundary & b, std::size_t k) -> auto& { return b.velocity[k]; }, "prescribed velocity");
    leaf.word("velocity-normal", "nvel");
    vector_words(
        leaf, "force", force_components, "force", [](Boundary & b, std::size_t k) -> auto& { return b.load[k]; },
        "force added at every vertex");
    flags(leaf, "viscous|quiet",
          {{{"viscous-x|quiet-x", "xviscous"}, {"viscous-y|quiet-y", "yviscous"}, {"viscous-z|quiet-z", "zviscous"}}},
          "viscous (absorbing) boundary", [](Boundary& b) { b.quiet[0] = b.quiet[1] = b.quiet[2] = true; });
    flags(leaf, "reaction", {{{"reaction-x", "xreaction"}, {"reaction-y", "yreaction"}, {"reaction-z", "zreaction"}}},
          "replaces the prescribed velocity by its reaction force", [](Boundary& b) { b.reaction.fill(true); });
    multiplier_words(leaf);
    leaf.not_yet({"reaction-normal", "source", "temperature", "verbose"}, "heat, and reactions along normals");
    leaf.ranged(&Boundary::range);
    leaf.finish([](const Reader& reader, Boundary& b) {
        const bool given = any(b.velocity) || any(b.load) || any(b.quiet) || any(b.reaction) || b.normal_velocity;
        if (!given)
            incomplete_line(reader, "block gridpoint apply has no boundary condition",
                            "expected: velocity, force, viscous or reaction, with -x, -y, -z");
        if (b.multiplier && !any(b.velocity) && !any(b.load))
            incomplete_line(reader, "there is nothing to multiply", "give velocity-x (or -y, -z) or force-x before");
        needs_range(reader, b);
    });
    leaf.right("block gridpoint apply velocity-x = 0 velocity-z=0 range position-z -1 0.01",
               "bound xvel 0 zvel 0 range z -1 0.01");
    leaf.right("bl gridp app vel-x 0 range position-z -1 0.01", "bound xvel 0 range z -1 0.01");
    leaf.right("block gridpoint apply force-x 10 force-y 0 force-z -1e4 range group 'roof'",
               "bound xload 10 yload 0 zload -1e4 range group roof");
    leaf.right("block gridpoint apply velocity 0 0 0 range position-z -1 0", "bound xvel 0 yvel 0 zvel 0 range z -1 0");
    leaf.right("block gridpoint apply velocity-z 1 table '1' range id 1", "bound zvel 1 hist table 1 range id 1");
    leaf.right("block gridpoint apply reaction-z range position-z -0.1 0.1", "bound zreaction range z -0.1 0.1");
    leaf.right("block gridpoint apply viscous range region 3", "bound xvisc yvisc zvisc range region 3");
    leaf.right("block gridpoint apply velocity-normal 0 range position-x -0.1 0.1", "bound nvel 0 range x -0.1 0.1");
    leaf.wrong("block gridpoint apply", "block gridpoint apply has no boundary condition");
    leaf.wrong("block gridpoint apply velocity-x 0", "a range must be given");
    leaf.wrong("block gridpoint apply velocity-x range id 1", "expected a number, found 'range'");
    leaf.wrong("block gridpoint apply velcity-x 0 range id 1", "'velcity-x' is not a keyword of block gridpoint apply");
    leaf.wrong("block gridpoint aply velocity-x 0", "'aply' is not a kind of block gridpoint");
    leaf.wrong("block gridpoint apply viscous table '1' range id 1", "there is nothing to multiply");
    return leaf;
}

CommandSpec gridpoint_initialize() {
    Leaf<Initialize> leaf("block gridpoint initialize", "initialize");
    vector_words(
        leaf, "displacement", displacement_components, "length",
        [](Initialize & command, std::size_t k) -> auto& { return command.displacement[k]; },
        "displacement so far; no position changes");
    vector_words(
        leaf, "velocity", velocity_components, "velocity",
        [](Initialize & command, std::size_t k) -> auto& { return command.velocity[k]; }, "velocity");
    const auto after_the_pressure = [](Reader& reader, Initialize& command) {
        if (!command.pore_pressure)
            throw Diagnostic("gradient belongs to pore-pressure", "write it after the pressure")
                .at(reader.previous().place);
    };
    leaf.keyword({"pore-pressure"},
                 Parts<Initialize>().in(made(&Initialize::pore_pressure),
                                        Parts<LinearNumber>().then(real("p").unit("stress"), &LinearNumber::at_origin)),
                 "pore pressure at the origin of coordinates");
    leaf.keyword({"gradient"},
                 Parts<Initialize>()
                     .check(after_the_pressure)
                     .in(there(&Initialize::pore_pressure),
                         Parts<LinearNumber>().then(vector("gx gy gz").unit("stress/length"), &LinearNumber::gradient)),
                 "change of the pore pressure with x, y and z");
    leaf.not_yet({"extra", "ratio-target", "temperature", "temperature-analytical"}, "other values of gridpoints");
    leaf.not_yet({"add", "multiply", "vary", "local", "origin"}, "changes of the values that are there");
    leaf.ranged(&Initialize::range);
    leaf.finish([](const Reader& reader, Initialize& command) {
        if (!any(command.velocity) && !any(command.displacement) && !command.pore_pressure)
            incomplete_line(reader, "block gridpoint initialize does not say what to set",
                            "expected: displacement, velocity or pore-pressure");
    });
    leaf.right("block gridpoint initialize displacement 0 0 0", "initialize xdis 0 ydis 0 zdis 0");
    leaf.right("block gridpoint ini velocity-z -2 range group 'ball'", "initialize zvel -2 range group ball");
    leaf.right("block gridpoint initialize pore-pressure 1e5 gradient 0 0 -1e4", "initialize pp 1e5 zgrad -1e4");
    leaf.wrong("block gridpoint initialize", "block gridpoint initialize does not say what to set");
    leaf.wrong("block gridpoint initialize displacement 0 0", "a number is missing after '0'");
    leaf.wrong("block gridpoint initialize gradient 0 0 1", "gradient belongs to pore-pressure");
    return leaf;
}

} // namespace

Family gridpoint_family() {
    return {
        "block gridpoint",
        "velocities, forces and initial values of gridpoints",
        {gridpoint_apply(),
         apply_remove("block gridpoint apply-remove", "block gridpoint apply-remove velocity-z range group 'wall'",
                      "bound zfree range group wall"),
         gridpoint_initialize(),
         list_line("block gridpoint list", List::What::gridpoints, "gridpoints: place, velocity, displacement, force",
                   "block gridpoint list displacement range position-z 0 1",
                   "list gridpoints show displacement range z 0 1",
                   {"block gridpoint list dsplacement", "'dsplacement' is not a keyword of block gridpoint list"})}};
}

} // namespace kaya::lang
