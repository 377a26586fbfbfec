// insitu: the stress that is there before anything happens.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

CommandSpec insitu() {
    Entry<InSitu> entry({"insitu"});
    entry.help("gives zones and joints the stress that is in the ground");
    entry.place(&InSitu::place);
    const auto gradient = tensor("sxx syy szz sxy sxz syz").unit("stress/length");
    entry.keyword({"stress"}, tensor("sxx syy szz sxy sxz syz").unit("stress"), &InSitu::stress,
                  "stress at the origin of coordinates, compression negative");
    entry.keyword({"xgradient"}, gradient, &InSitu::x_gradient, "change of the stress with x");
    entry.keyword({"ygradient"}, gradient, &InSitu::y_gradient, "change of the stress with y");
    entry.keyword({"zgradient"}, gradient, &InSitu::z_gradient, "change of the stress with z");
    entry.action({"nodisplacements"}, [](InSitu&) {}, "joints keep their displacements, as they always do").ignored();
    entry.not_yet({"pp"}, "pore pressure: see water");
    entry.not_yet({"topography"}, "stresses below a hilly surface");
    entry.range(&InSitu::range);
    entry.finish([](const Reader& reader, InSitu& c) {
        if (!c.stress)
            incomplete_line(reader, "insitu does not say which stress",
                            "write: insitu stress sxx syy szz sxy sxz syz [zgrad ...]");
    });
    entry.right("insitu stress -1e6 -1e6 -2e6 0 0 0");
    entry.right("insitu str 0 0 0 0 0 0 zgrad 1.3e4 1.3e4 2.6e4 0 0 0 nodis range z -100 0");
    entry.wrong("insitu", "insitu does not say which stress");
    entry.wrong("insitu stress -1e6 -1e6", "a number is missing after '-1e6'");
    entry.wrong("insitu zgrad 0 0 1 0 0 0", "insitu does not say which stress");
    entry.wrong("insitu sterss 0 0 0 0 0 0", "'sterss' is not a keyword of insitu");
    entry.wrong("insitu topo", "'insitu topography' is known, but kaya does not support it yet");
    return entry;
}

} // namespace kaya::lang
