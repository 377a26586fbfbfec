// Commands of 3DEC that kaya knows by name only: a deck that uses one gets a message with its line.
#include "lang/commands/builder.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

struct Known {
    std::vector<Spelling> words, form;
    const char* about;
};

/// Of `generate` the missing forms; of the other commands the whole command.
const std::vector<Known>& known() {
    static const std::vector<Known> commands = {
        {{"generate"}, {"center"}, "zones whose size varies: write generate edge center"},
        {{"generate"}, {"grade"}, "zones whose size varies: see generate edge center"},
        {{"generate"}, {"fix"}, "zones whose size varies: see generate edge center"},
        {{"pfix"}, {}, "a prescribed pore pressure"},
        {{"pfree"}, {}, "a prescribed pore pressure"},
        {{"ffield"}, {}, "free fields at the sides of a model"},
        {{"feblock", Spelling{"feb", 3}}, {}, "blocks of finite elements"},
        {{"structure", Spelling{"struct", 4}}, {"pile"}, "piles: of structures there are cables, beams and liners"},
        {{"structure", Spelling{"struct", 4}},
         {"axial"},
         "reinforcement of single joints: of structures there are cables, beams and liners"},
        {{"structure", Spelling{"struct", 4}}, {"node"}, "nodes of structures as separate objects"},
        {{"thermal"}, {}, "heat"},
        {{"gwater", Spelling{"gw", 2}}, {}, "flow of water"},
        {{"flow", "fluid"}, {}, "flow in joints"},
        {{"fknot", "knot", "flowknot"}, {}, "flow in joints"},
        {{"flowplane", "fplane"}, {}, "flow in joints"},
        {{"creep"}, {}, "creep"},
        {{"dfn"}, {}, "networks of fractures: write fracture create, cut dfn"},
        {{"topography"}, {}, "stresses below a hilly surface: see insitu topography"},
        {{"factor", "fos"}, {}, "factors of safety: see solve fos"},
        {{"pstress", "prestress"}, {}, "prestress"},
    };
    return commands;
}

} // namespace

Family not_supported_yet() {
    Family family{"not supported yet", "known by name; a deck that uses them gets an error", {}};
    for (const auto& command : known()) {
        Entry<NotSupportedYet> entry(command.words, command.form);
        entry.help(command.about).support(Support::not_yet);
        family.commands.push_back(entry);
    }
    return family;
}

} // namespace kaya::lang
