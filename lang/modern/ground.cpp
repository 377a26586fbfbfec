// block mechanical, insitu, water, face: how the rock is damped, stressed and wetted.
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"

#include <array>

namespace kaya::lang {

namespace {

/// `local 0` and `global 0`, the words of users for no damping: each stands on a line before the damping that is wanted.
CommandSpec damping() {
    Leaf<Damp> leaf("block mechanical damping", "damp");
    using enum Damp::Kind;
    const Through value{[](Damp& damp, double ratio) {
                            damp.kind = ratio > 0 ? global : none;
                            if (ratio > 0) damp.value = ratio;
                        },
                        [](const Damp& damp) { return damp.kind == none ? std::optional(0.0) : damp.value; }};
    const auto begin = [](Damp& damp) {
        damp.kind = global;
        damp.value.reset();
        damp.fraction = damp.frequency = 0;
    };
    leaf.keyword({"global"}, Parts<Damp>().set(begin).maybe(real("ratio").at_least(0).below(1).optional(), value),
                 "viscous damping that follows the kinetic energy; 0.5 if not given, 0: no damping");
    leaf.word("local", "local").word("combined", "combined").word("rayleigh", "rayleigh");
    leaf.word("mass", "mass").word("stiffness", "stiffness").checks_of_meaning();
    leaf.not_yet({"maxwell"}, "Maxwell damping");
    leaf.not_yet({"contact"}, "damping of contacts by groups: write damp contact f");
    leaf.right("block mechanical damping global", "damp global").right("bl mech damp local 0.8", "damp local 0.8");
    leaf.right("block mechanical damping local 0.0", "damp local 0");
    leaf.right("block mechanical damping global 0.0", "damp none")
        .right("block mech damp global 0.7", "damp global 0.7");
    leaf.right("block mechanical damping rayleigh 0.05 1.5 mass", "damp 0.05 1.5 mass");
    leaf.right("block mechanical damping combined", "damp combined");
    leaf.wrong("block mechanical damping locla", "'locla' is not a keyword of block mechanical damping");
    leaf.wrong("block mechanical damping local 2", "factor must be at most 1, not 2");
    leaf.wrong("block mechanical damping rayleigh 0.05", "a number is missing after '0.05'");
    return leaf;
}

CommandSpec mass_scale() {
    Leaf<MassScale> leaf("block mechanical mass-scale", "mscale");
    leaf.word("on|true|yes", "on").word("off|false|no", "off").word("timestep", "partial");
    leaf.not_yet({"maximum-ratio"}, "a limit of the mass that is added");
    leaf.finish([](const Reader& reader, MassScale& scale) {
        if (scale.step && scale.on) scale.on = false; // `on timestep dt`: the bodies that need it only
        if (scale.on + scale.off + scale.step.has_value() != 1)
            incomplete_line(reader, "mass-scale has no mode", "expected: on, off, or timestep dt");
    });
    leaf.right("block mechanical mass-scale on", "mscale on").right("block mechanical mass-scale off", "mscale off");
    leaf.right("block mechanical mass-scale on timestep 1e-4", "mscale partial 1e-4");
    leaf.wrong("block mechanical mass-scale", "mass-scale has no mode");
    leaf.wrong("block mechanical mass-scale maybe", "'maybe' is not a keyword of block mechanical mass-scale");
    return leaf;
}

CommandSpec insitu_stress() {
    Leaf<InSitu> leaf("block insitu", "insitu");
    leaf.word("stress", "stress");
    leaf.word("gradient", "gradient", "change of the pore pressure with x, y and z");
    leaf.word("gradient-x", "xgradient").word("gradient-y", "ygradient").word("gradient-z", "zgradient");
    leaf.word("nodisplacements", "nodisplacements").word("pore-pressure", "pp");
    leaf.word("topography", "topography");
    leaf.not_yet({"principal"}, "principal stresses: give the six components");
    leaf.not_yet({"fluid-temperature"}, "heat");
    leaf.not_yet({"overburden", "overburden-xx", "overburden-yy", "overburden-zz", "total", "ratio-z"},
                 "loads above the topography");
    leaf.word("ratio-x", "kx").word("ratio-y", "ky");
    leaf.ranged(&InSitu::range);
    leaf.finish([](const Reader& reader, InSitu& command) {
        const std::array<double, 6> none{};
        const bool slopes = command.x_gradient != none || command.y_gradient != none || command.z_gradient != none;
        if (!command.stress && (slopes || (!command.topography && !command.pore_pressure)))
            incomplete_line(reader, "block insitu does not say which stress",
                            "write: block insitu stress sxx syy szz sxy sxz syz [gradient-z ...]");
        if (command.stress && command.topography)
            incomplete_line(reader, "stress and topography exclude each other", "keep one of them");
    });
    leaf.right("block insitu stress -1e6 -1e6 -2e6 0 0 0", "insitu stress -1e6 -1e6 -2e6 0 0 0");
    leaf.right("block insitu stress 0 0 0 0 0 0 gradient-z 1.3e4 1.3e4 2.6e4 0 0 0 nodisplacements "
               "range position-z -100 0",
               "insitu stress 0 0 0 0 0 0 zgrad 1.3e4 1.3e4 2.6e4 0 0 0 nodis range z -100 0");
    leaf.right("block insitu pore-pressure 1e5 gradient 0 0 -1e4", "insitu pp 1e5 gradient 0 0 -1e4");
    leaf.right("block insitu topography ratio-x 0.5 ratio-y 0.8", "insitu topo kx 0.5 ky 0.8");
    leaf.wrong("block insitu", "block insitu does not say which stress");
    leaf.wrong("block insitu stress -1e6", "a number is missing after '-1e6'");
    leaf.wrong("block insitu sterss 0 0 0 0 0 0", "'sterss' is not a keyword of block insitu");
    return leaf;
}

CommandSpec water_plane() {
    Leaf<WaterCommand> leaf("block water", "water");
    leaf.action(
        {"plane"}, [](WaterCommand& water) { water.kind = WaterCommand::Kind::table; },
        "hydrostatic pressure below a plane; it follows gravity");
    leaf.action(
        {"clear"}, [](WaterCommand& water) { water.kind = WaterCommand::Kind::off; }, "removes the water");
    leaf.keyword({"origin"}, vector("x y z").unit("length"), &WaterCommand::origin, "a point of the plane");
    const Through downward{
        [](WaterCommand& water, const Vec3& normal) { water.normal = Vec3::Zero() - normal; },
        [](const WaterCommand& water) -> std::optional<Vec3> { return Vec3::Zero() - water.normal; }};
    leaf.keyword({"normal"}, vector("nx ny nz"), downward, "normal of the plane, towards rising pressure: downward");
    leaf.word("density", "density");
    leaf.not_yet({"set", "skip", "effective", "list"}, "water between surfaces");
    leaf.finish([](const Reader& reader, WaterCommand& water) {
        if (!water.kind)
            incomplete_line(reader, "block water has no plane",
                            "write: block water plane normal 0 0 -1 origin 0 0 10 density 1000");
    });
    leaf.right("block water plane normal 0 0 -1 origin 0 0 10 density 1025",
               "water table 0 0 10 normal 0 0 1 density 1025");
    leaf.right("block water clear", "water off");
    leaf.wrong("block water", "block water has no plane");
    leaf.wrong("block water density 1000", "block water has no plane");
    return leaf;
}

CommandSpec triangulate(std::string_view form, std::string_view classic, std::string_view example,
                        std::string_view classic_example) {
    Leaf<FaceTriangulation> leaf(form, classic);
    leaf.arguments_of_meaning().ranged(&FaceTriangulation::range);
    leaf.right(example, classic_example);
    return leaf;
}

CommandSpec triangulate_edge() {
    Leaf<FaceTriangulation> leaf("block face triangulate edge-max", "facetri edge");
    leaf.arguments_of_meaning().ranged(&FaceTriangulation::range);
    leaf.right("block face triangulate edge-max 0.1", "facetri edge 0.1");
    leaf.wrong("block face triangulate edge-max 0", "edge must be greater than 0, not 0");
    return leaf;
}

CommandSpec face_group() {
    auto leaf = group_leaf("block face group", "group face");
    leaf.right("block face group 'top' range position-z 2", "group face top range z 2");
    leaf.wrong("block face group", "a word is missing after 'group'");
    return leaf;
}

/// The six words of single stresses and the one of all.
CommandSpec face_apply() {
    Leaf<Boundary> leaf("block face apply", "boundary");
    leaf.word("stress", "stress");
    constexpr std::array words{"stress-xx", "stress-yy", "stress-zz", "stress-xy", "stress-xz", "stress-yz"};
    const auto value = real("s").unit("stress");
    const auto slope = vector("gx gy gz").unit("stress/length");
    for (std::size_t k = 0; k < words.size(); ++k) {
        const Through component{
            [k](Boundary& b, double stress) {
                if (!b.stress) b.stress.emplace();
                (*b.stress)[k] = stress;
            },
            [k](const Boundary& b) { return b.stress ? std::optional((*b.stress)[k]) : std::nullopt; }};
        const Through gradient{[k](Boundary& b, const Vec3& g) {
                                   b.x_gradient[k] = g.x();
                                   b.y_gradient[k] = g.y();
                                   b.z_gradient[k] = g.z();
                               },
                               [k](const Boundary& b) -> std::optional<Vec3> {
                                   return Vec3(b.x_gradient[k], b.y_gradient[k], b.z_gradient[k]);
                               }};
        leaf.keyword(
            {words[k]},
            Parts<Boundary>().then(value, component).perhaps({{"gradient", Parts<Boundary>().then(slope, gradient)}}),
            "one component of the stress; `gradient gx gy gz` may follow");
    }
    const Through normal{[](Boundary& b, double stress) { b.stress = {stress, stress, stress, 0, 0, 0}; },
                         [](const Boundary& b) { return b.stress ? std::optional((*b.stress)[0]) : std::nullopt; }};
    leaf.keyword({"stress-normal"}, value, normal, "stress along the normal of each face, compression negative");
    leaf.word("gradient-x", "xgradient").word("gradient-y", "ygradient").word("gradient-z", "zgradient");
    leaf.word("velocity-normal", "nvel");
    multiplier_words(leaf);
    leaf.not_yet({"stress-principal", "point-load", "point-load-x", "point-load-y", "point-load-z"},
                 "other loads on faces: give the components of the stress");
    leaf.not_yet({"convection", "flux", "westergaard"}, "heat and added mass of water");
    leaf.ranged(&Boundary::range);
    leaf.finish([](const Reader& reader, Boundary& b) {
        if (!b.stress && !b.normal_velocity)
            incomplete_line(reader, "block face apply has no load",
                            "expected: stress, stress-xx, ... or velocity-normal");
        needs_range(reader, b);
    });
    leaf.right("block face apply stress 0 0 -5 0 0 0 range position-z 2", "bound stress 0 0 -5 0 0 0 range z 2");
    leaf.right("block face apply stress-zz -5 range position-z 2", "bound stress 0 0 -5 0 0 0 range z 2");
    leaf.right("block face apply stress-normal -5 range position-z 2", "bound stress -5 -5 -5 0 0 0 range z 2");
    leaf.right("block face apply stress 0 0 -1e6 0 0 0 table '1' range position-z 2",
               "bound stress 0 0 -1e6 0 0 0 hist table 1 range z 2");
    leaf.wrong("block face apply", "block face apply has no load");
    leaf.wrong("block face apply stress 0 0 -5", "a number is missing after '-5'");
    leaf.wrong("block face apply stress 0 0 -5 0 0 0", "a range must be given");
    return leaf;
}

} // namespace

std::vector<CommandSpec> ground_commands() {
    return {
        damping(),
        mass_scale(),
        insitu_stress(),
        water_plane(),
        triangulate("block face triangulate", "facetri off", "block face triangulate", "facetri off"),
        triangulate("block face triangulate radial", "facetri radial", "block face triangulate radial",
                    "facetri radial"),
        triangulate("block face triangulate radial-8", "facetri rad8", "block face tri radial-8 range region 1",
                    "facetri rad8 range region 1"),
        triangulate_edge(),
        face_group(),
        face_apply(),
        ignored_line("block mechanical energy", "the energy account", "kaya always keeps it",
                     "block mechanical energy on"),
        ignored_line("block mechanical timestep-update", "cycles between two time steps",
                     "kaya computes the step when it changes", "block mechanical timestep-update 100"),
    };
}

} // namespace kaya::lang
