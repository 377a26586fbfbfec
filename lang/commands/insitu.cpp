// insitu: initial stresses.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/directions.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

CommandSpec insitu() {
    Entry<InSitu> entry({"insitu"});
    entry.help("sets the initial stress of zones and joints, and the pore pressure of joints");
    entry.place(&InSitu::place);
    const auto gradient = tensor("sxx syy szz sxy sxz syz").unit("stress/length");
    entry.keyword({"stress"}, tensor("sxx syy szz sxy sxz syz").unit("stress"), &InSitu::stress,
                  "stress at the origin of coordinates, compression negative");
    entry.keyword({"xgradient"}, gradient, &InSitu::x_gradient, "change of the stress with x");
    entry.keyword({"ygradient"}, gradient, &InSitu::y_gradient, "change of the stress with y");
    entry.keyword({"zgradient"}, gradient, &InSitu::z_gradient, "change of the stress with z");
    add_local_axes(entry);
    entry
        .action(
            {"nodisplacements"}, [](InSitu&) {}, "joints keep their displacements, the default")
        .ignored();
    const auto pressure = kept(&InSitu::pore_pressure);
    entry.keyword(
        {"pp", "pressure"},
        Parts<InSitu>().in(pressure, Parts<LinearNumber>().then(real("p").unit("stress"), &LinearNumber::at_origin)),
        "pore pressure at the origin of coordinates");
    entry.keyword({"gradient"},
                  Parts<InSitu>().in(pressure, Parts<LinearNumber>().then(vector("gx gy gz").unit("stress/length"),
                                                                          &LinearNumber::gradient)),
                  "change of the pore pressure with x, y and z");
    const auto topography = kept(&InSitu::topography);
    entry.keyword({"topography"}, Parts<InSitu>().in(topography, Parts<Topography>()),
                  "vertical stress of the weight of the blocks above, and horizontal stress as a part of it");
    const auto ratio = real("k").at_least(0);
    entry.keyword({"kx"}, Parts<InSitu>().in(topography, Parts<Topography>().then(ratio, &Topography::kx)),
                  "ratio of sxx to szz below the topography; 1 if not given");
    entry.keyword({"ky"}, Parts<InSitu>().in(topography, Parts<Topography>().then(ratio, &Topography::ky)),
                  "ratio of syy to szz below the topography; 1 if not given");
    entry.range(&InSitu::range);
    entry.finish([](const Reader& reader, InSitu& c) {
        const std::array<double, 6> none{};
        const bool slopes = c.x_gradient != none || c.y_gradient != none || c.z_gradient != none;
        if (!c.stress && (slopes || (!c.topography && !c.pore_pressure)))
            incomplete_line(reader, "insitu does not say which stress",
                            "write: insitu stress sxx syy szz sxy sxz syz [zgrad ...]");
        if (c.stress && c.topography)
            incomplete_line(reader, "stress and topography exclude each other", "keep one of them");
    });
    entry.right("insitu stress -1e6 -1e6 -2e6 0 0 0");
    entry.right("insitu str 0 0 0 0 0 0 zgrad 1.3e4 1.3e4 2.6e4 0 0 0 nodis range z -100 0");
    entry.right("insitu topo kx 0.5 ky 0.8 range z -100 0").right("insitu pp 1e5 gradient 0 0 -1e4");
    entry.right("insitu stress -5e6 -3e6 -2e6 0 0 0 local 1 1 0 0 0 1");
    entry.wrong("insitu stress -1 -1 -1 0 0 0 local 0 0 0 1 0 0", "(0, 0, 0) is not a direction");
    entry.wrong("insitu stress -1 -1 -1 0 0 0 local 1 0 0 0 1 0 zgrad 1 1 1 0 0 0",
                "'zgrad' stands after local, which rotates only what is before it");
    entry.wrong("insitu", "insitu does not say which stress");
    entry.wrong("insitu stress -1e6 -1e6", "a number is missing after '-1e6'");
    entry.wrong("insitu zgrad 0 0 1 0 0 0", "insitu does not say which stress");
    entry.wrong("insitu sterss 0 0 0 0 0 0", "'sterss' is not a keyword of insitu");
    entry.wrong("insitu topo kx", "a number is missing after 'kx'");
    entry.wrong("insitu topo kx -1", "kx must be at least 0, not -1");
    entry.wrong("insitu stress -1 -1 -1 0 0 0 topo", "stress and topography exclude each other");
    entry.wrong("insitu pp", "a number is missing after 'pp'");
    return entry;
}

} // namespace kaya::lang
