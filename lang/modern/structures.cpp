// structure cable|beam|liner create ..., property: structures whose properties have the number of their kind.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

#include <span>

namespace kaya::lang {

namespace {

/// Elements that the words of this dialect make have properties of these numbers.
constexpr std::int64_t of_cables = 1, of_beams = 2, of_liners = 3;

constexpr const char* further = "names and groups of structures, and what they share";

template <class Command, std::int64_t number> void numbered(const Statement& statement, Command& command) {
    command.property = number;
    command.place = statement.words.front().place;
}

/// Cables and beams lie on a line.
template <class Command, std::int64_t number> Leaf<Command> by_line(std::string_view words, std::string_view meaning) {
    Leaf<Command> leaf(words, meaning);
    leaf.start(numbered<Command, number>);
    leaf.arguments_of_meaning().word("segments", "segments").checks_of_meaning();
    leaf.not_yet({"id", "group", "snap", "distinct", "maximum-length"}, further);
    return leaf;
}

CommandSpec create_cable() {
    auto leaf = by_line<StructureCable, of_cables>("structure cable create by-line", "structure cable");
    leaf.right("structure cable create by-line 0 0.5 0.5 1 0.5 0.5 segments 8",
               "structure cable 0 0.5 0.5 1 0.5 0.5 segments 8");
    leaf.wrong("structure cable create by-line 0 0 1 0 0 1", "both ends of the cable are at the same place");
    leaf.wrong("structure cable create by-line 0 0 1", "a number is missing after '1'");
    leaf.wrong("structure cable create by-line 0 0 1 1 0 1 segmnets 5",
               "'segmnets' is not a keyword of structure cable create by-line");
    return leaf;
}

CommandSpec create_beam() {
    auto leaf = by_line<StructureBeam, of_beams>("structure beam create by-line", "structure beam");
    leaf.right("structure beam create by-line 0 0.5 0.5 1 0.5 0.5 segments 8",
               "structure beam 0 0.5 0.5 1 0.5 0.5 segments 8 property 2");
    leaf.wrong("structure beam create by-line 0 0 1 0 0 1", "two neighbouring places of the beam are the same");
    leaf.wrong("structure beam create by-line 0 0 1 1 0 1 segmnets 5",
               "'segmnets' is not a keyword of structure beam create by-line");
    return leaf;
}

CommandSpec create_liner() {
    Leaf<StructureLiner> leaf("structure liner create by-face|by-block-face", "structure liner");
    leaf.start(numbered<StructureLiner, of_liners>);
    leaf.word("size|element-size", "edge").ranged(&StructureLiner::range).checks_of_meaning();
    leaf.not_yet({"id", "group", "distinct", "separate", "embedded", "element-type"}, further);
    leaf.right("structure liner create by-face size 0.5 range position-z 1",
               "structure liner edge 0.5 property 3 range z 1");
    leaf.wrong("structure liner create by-face sise 1", "'sise' is not a keyword of structure liner create by-face");
    return leaf;
}

struct PropertyName {
    const char *modern, *classic;
};

/// The words of the properties of one kind, under the number of that kind.
Leaf<StructureProperty> property(const char* words, std::int64_t number, std::span<const PropertyName> names) {
    Leaf<StructureProperty> leaf(words, "structure property");
    leaf.start([number](const Statement& statement, StructureProperty& command) {
        command.number = number;
        command.place = statement.words.front().place;
    });
    for (const PropertyName& name : names) leaf.word(name.modern, name.classic);
    leaf.not_yet({"range"}, "properties by range: write structure property with a number");
    leaf.not_yet({"thermal-expansion", "direction-y", "slide", "slide-tolerance"}, "other properties of structures");
    leaf.checks_of_meaning();
    return leaf;
}

CommandSpec cable_property() {
    static constexpr PropertyName names[] = {{"cross-sectional-area", "area"}, {"young", "young"},
                                             {"density", "density"},           {"grout-stiffness", "kbond"},
                                             {"grout-cohesion", "sbond"},      {"grout-friction", "fbond"},
                                             {"grout-perimeter", "perimeter"}, {"yield-tension", "yield"},
                                             {"yield-compression", "ycomp"},   {"tensile-failure-strain", "rupture"}};
    auto leaf = property("structure cable property", of_cables, names);
    leaf.right("structure cable property cross-sectional-area 181e-6 young 98.6e9 grout-stiffness 1.12e8 "
               "grout-cohesion 1.75e5 yield-tension 5e5",
               "structure property 1 area 181e-6 young 98.6e9 kbond 1.12e8 sbond 1.75e5 yield 5e5");
    leaf.wrong("structure cable property", "no property is given");
    leaf.wrong("structure cable property yuong 1", "'yuong' is not a keyword of structure cable property");
    return leaf;
}

CommandSpec beam_property() {
    static constexpr PropertyName names[] = {{"cross-sectional-area", "area"},
                                             {"young", "young"},
                                             {"poisson", "poisson"},
                                             {"density", "density"},
                                             {"moi-y", "moi-y"},
                                             {"moi-z", "moi-z"},
                                             {"torsion-constant|moi-polar", "torsion-constant"},
                                             {"plastic-moment", "plastic-moment"}};
    auto leaf = property("structure beam property", of_beams, names);
    leaf.right("structure beam property young 2e11 poisson 0.3 cross-sectional-area 6e-3 moi-y 2e-5 moi-z 7e-6",
               "structure property 2 young 2e11 poisson 0.3 area 6e-3 moi-y 2e-5 moi-z 7e-6");
    leaf.wrong("structure beam property young -1", "young must be at least 0, not -1");
    return leaf;
}

CommandSpec liner_property() {
    static constexpr PropertyName names[] = {{"young", "young"},
                                             {"poisson", "poisson"},
                                             {"thickness", "thickness"},
                                             {"density", "density"},
                                             {"coupling-stiffness-normal", "kn"},
                                             {"coupling-stiffness-shear", "ks"},
                                             {"coupling-cohesion-shear", "cohesion"},
                                             {"coupling-friction-shear", "friction"},
                                             {"coupling-yield-normal", "tension"}};
    auto leaf = property("structure liner property", of_liners, names);
    leaf.right("structure liner property young 2e10 poisson 0.2 thickness 0.15",
               "structure property 3 young 2e10 poisson 0.2 thickness 0.15");
    leaf.wrong("structure liner property thickness", "a number is missing after 'thickness'");
    return leaf;
}

CommandSpec structure_list() {
    Leaf<List> leaf("structure cable|beam|liner list");
    leaf.means("list structures").help("cables, beams and liners: size, largest forces, slip");
    leaf.start([](const Statement&, List& command) { command.what = List::What::structures; });
    for (const char* word : {"information", "force-axial", "force-node", "grout", "stress", "yield", "length"})
        leaf.no_effect(word, "one table has all");
    leaf.not_yet({"apply", "group", "property", "system-local", "range"}, "other lists of structures");
    leaf.right("structure cable list", "list structures").right("structure beam list force-node", "list structures");
    leaf.wrong("structure cable list froce-axial", "'froce-axial' is not a keyword of structure cable list");
    return leaf;
}

} // namespace

Family structure_family() {
    return {"structure",
            "cables, beams and liners",
            {create_cable(), create_beam(), create_liner(), cable_property(), beam_property(), liner_property(),
             structure_list()}};
}

} // namespace kaya::lang
