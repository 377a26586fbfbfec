// Commands that cut blocks.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// A value and how far single joints may scatter from it.
void with_deviation(Entry<JointSetCommand>& entry, std::vector<Spelling> words, ArgumentSpec value,
                    ArgumentSpec deviation, std::array<double, 2> JointSetCommand::*member,
                    std::string_view help) {
    entry.special(std::move(words), {value, deviation},
                  [=](Reader& reader, JointSetCommand& set) {
                      (set.*member)[0] = reader.real(value);
                      if (reader.at_number()) (set.*member)[1] = reader.real(deviation);
                  },
                  help);
}

CommandSpec joint_set() {
    Entry<JointSetCommand> entry({"jset"});
    entry.help("cuts visible blocks by a set of parallel joints");
    const ArgumentSpec deviation =
        real("deviation").unit("degrees").at_least(0).optional().spec;
    with_deviation(entry, {"dip"}, real("dip").unit("degrees").spec, deviation, &JointSetCommand::dip,
                   "angle below the horizontal and half width of its scatter, 0 if not given");
    with_deviation(entry, {"dd", "dip-direction"}, real("dd").unit("degrees").spec, deviation,
                   &JointSetCommand::dip_direction,
                   "direction of dip, clockwise from +y seen from above, and its scatter");
    with_deviation(entry, {"spacing"}, real("spacing").unit("length").at_least(0).spec,
                   real("deviation").unit("length").at_least(0).optional().spec, &JointSetCommand::spacing,
                   "distance between joints and its scatter");
    entry.keyword({"number"}, integer("n").at_least(1).at_most(1e6), &JointSetCommand::number,
                  "of joints, 1 if not given; the first passes through the origin, the others lie on both sides");
    entry.keyword({"origin", "org"}, vector("x y z").unit("length"), &JointSetCommand::origin,
                  "a point of the first joint");
    entry.keyword({"persistence"}, real("p").at_least(0).at_most(1), &JointSetCommand::persistence,
                  "chance that a block in the way of a joint is cut, 1 if not given");
    entry.keyword({"id"}, integer("n").at_least(1).at_most(2000000000), &JointSetCommand::id,
                  "number of the set, which its faces keep; counts up if not given");
    entry.keyword({"seed"}, integer("n").at_least(0), &JointSetCommand::seed,
                  "chooses another scatter; the same seed gives the same joints");
    entry.range(&JointSetCommand::range);
    entry.place(&JointSetCommand::place);
    entry.finish([](const Reader& reader, JointSetCommand& set) {
        if (!reader.wildcards() && set.number > 1 && set.spacing[0] == 0)
            throw Diagnostic(fmt::format("{} joints need a spacing, and it is 0", set.number),
                             "give a spacing above 0, or number 1")
                .at(set.place);
    });
    entry.right("jset dip 45 dd 90").right("jset dip 60,5 dd 270,10 spacing 2,0.3 num 20 org 0,0,10 id 2");
    entry.right("jset dip 80 spacing 1 number 5 persistence 0.7 seed 3 range region 1");
    entry.wrong("jset dip", "a number is missing after 'dip'");
    entry.wrong("jset dip 45 num 0", "num must be at least 1, not 0");
    entry.wrong("jset dip 45 num 1000000000", "num must be at most 1e+06, not 1e+09");
    entry.wrong("jset spacing 0 num 5", "5 joints need a spacing, and it is 0");
    entry.wrong("jset persistence 2", "persistence must be at most 1, not 2");
    entry.wrong("jset pid 45", "'pid' is not a keyword of jset");
    return entry;
}

CommandSpec join() {
    Entry<Join> entry({"join"});
    entry.help("makes one body of rigid blocks that lie face on face, or takes bodies apart");
    entry.action({"on"}, [](Join& join) { join.on = true; }, "joins; so without a word");
    entry.action({"off"}, [](Join& join) { join.on = false; }, "takes the bodies of these blocks apart");
    entry.range(&Join::range);
    entry.place(&Join::place);
    entry.right("join").right("join on range group arch").right("join off range x 0 1");
    entry.wrong("join of", "'of' is not a keyword of join");
    return entry;
}

CommandSpec join_contact() {
    Entry<JoinContact> entry({"join_contact", "join-contact"});
    entry.help("joins the two blocks of each contact in the range");
    entry.range(&JoinContact::range);
    entry.place(&JoinContact::place);
    entry.right("join_contact range jset 2").right("join_contact range plane dip 0 dd 0 org 0 0 1 distance 0.01");
    entry.wrong("join_contact on", "'on' is not a keyword of join_contact");
    return entry;
}

} // namespace

std::vector<CommandSpec> cut_commands() { return {joint_set(), join(), join_contact()}; }

} // namespace kaya::lang
