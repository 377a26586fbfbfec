// structure ...: cables.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

/// No abbreviation of it is a word of another command.
std::vector<Spelling> structure_word() { return {Spelling{"structure", 4}}; }

CommandSpec cable() {
    Entry<StructureCable> entry(structure_word(), {"cable"});
    entry.help("puts a cable or bolt into the rock: a straight line of bars between nodes that grout holds");
    entry.place(&StructureCable::place);
    entry.argument(vector("x1 y1 z1").unit("length").help("first end"), &StructureCable::first);
    entry.argument(vector("x2 y2 z2").unit("length").help("last end"), &StructureCable::last);
    entry.keyword({"segments"}, integer("n").at_least(1).at_most(100000), &StructureCable::segments,
                  "number of bars; 10 if not given");
    entry.keyword({"property"}, integer("n").at_least(1), &StructureCable::property,
                  "number of its properties; 1 if not given");
    entry.keyword({"tension"}, real("t").unit("force").at_least(0), &StructureCable::tension,
                  "force in the bars when it is made");
    entry.special(
        {"anchor"}, {text("first|last|both").spec},
        [](Reader& reader, StructureCable& c) {
            static constexpr std::array<std::string_view, 3> ends{"first", "last", "both"};
            const std::string end = reader.text(text("first|last|both").spec);
            const auto found =
                std::ranges::find_if(ends, [&](std::string_view word) { return word.starts_with(fold(end)); });
            if (end.empty() || found == ends.end())
                throw Diagnostic("'" + end + "' is not an end of a cable", "expected: first, last or both")
                    .at(reader.previous().place);
            c.anchor_first = c.anchor_first || *found != "last";
            c.anchor_last = c.anchor_last || *found != "first";
        },
        "ends that cannot slip in the rock, as behind a plate or in an anchor");
    entry.finish([](const Reader& reader, StructureCable& c) {
        if (!reader.wildcards() && c.first == c.last)
            incomplete_line(reader, "both ends of the cable are at the same place", "give two places");
    });
    entry.right("structure cable 0 0 1 5 0 1 segments 20 property 2")
        .right("struct cable (0,0,1) (5,0,1) seg 10 prop 1 tension 1e5 anchor both");
    entry.right("structure cable 0 0.5 0.5 1 0.5 0.5");
    entry.wrong("structure cable 0 0 1 5 0", "a number is missing after '0'");
    entry.wrong("structure cable 0 0 1 0 0 1", "both ends of the cable are at the same place");
    entry.wrong("structure cable 0 0 1 5 0 1 segments 0", "segments must be at least 1, not 0");
    entry.wrong("structure cable 0 0 1 5 0 1 anchor middle", "'middle' is not an end of a cable");
    entry.wrong("structure cable 0 0 1 5 0 1 tensoin 5", "'tensoin' is not a keyword of structure cable");
    return entry;
}

struct PropertyWord {
    std::vector<Spelling> words; ///< the first is the name in src/model/cables.cpp
    const char* unit;
    const char* help;
    double most = 0; ///< 0: any
};

const std::vector<PropertyWord>& property_words() {
    static const std::vector<PropertyWord> words{
        {{"area", "cb_area", "cross-sectional-area"}, "area", "area of the cross section"},
        {{"young", "ymod", "emod", Spelling{"e", 1}, "cb_ymod"}, "stress", "Young's modulus"},
        {{"density", "cb_dens"},
         "mass/length^3",
         "density; a cable has no weight and no inertia here, so this changes nothing"},
        {{"kbond", "cb_kbond", "grout-stiffness"},
         "force/length/length",
         "shear stiffness of the grout: force per length of cable and length of slip"},
        {{"sbond", "cb_sbond", "grout-cohesion"},
         "force/length",
         "shear strength of the grout per length of cable; without limit if neither this nor fbond is given"},
        {{"fbond", "cb_fbond", "grout-friction"},
         "degrees",
         "friction angle of the grout under the stress of the zones around it",
         89},
        {{"perimeter", "cb_perimeter", "grout-perimeter"}, "length", "perimeter on which that friction acts"},
        {{"yield", "cb_yield", "yield-tension"}, "force", "tensile strength of the cable; without limit if not given"},
        {{"ycomp", "cb_ycomp", "yield-compression"},
         "force",
         "compressive strength of the cable; without limit if not given"},
        {{"rupture", "tensile-failure-strain"}, "", "plastic strain at which a bar breaks; never if not given"},
    };
    return words;
}

CommandSpec property() {
    Entry<StructureProperty> entry(structure_word(), {"property"});
    entry.help("gives a number the properties of cables");
    entry.place(&StructureProperty::place);
    entry.argument(integer("n").at_least(1).help("number of the properties"), &StructureProperty::number);
    for (const auto& known : property_words()) {
        auto value = real(known.words.front().word).unit(known.unit).at_least(0);
        if (known.most > 0) value.spec.limits.high = known.most;
        entry.special(
            known.words, {value.spec},
            [value](Reader& reader, StructureProperty& p) {
                p.items.push_back({std::string(value.spec.name), reader.real(value.spec)});
            },
            known.help);
    }
    entry.finish([](const Reader& reader, StructureProperty& p) {
        if (p.items.empty())
            incomplete_line(reader, "no property is given",
                            "write for example: structure property 1 area 5e-4 young 2e11 yield 2.5e5");
    });
    entry.right("structure property 1 area 181e-6 young 98.6e9 kbond 1.12e8 sbond 1.75e5 yield 5e5");
    entry.right("struct prop 2 area 5e-4 e 2e11 kbond 1e7 fbond 30 perimeter 0.1 ycomp 1e4 rupture 0.05");
    entry.wrong("structure property 1", "no property is given");
    entry.wrong("structure property 1 area", "a number is missing after 'area'");
    entry.wrong("structure property 1 area -1", "area must be at least 0, not -1");
    entry.wrong("structure property 1 yeild 5", "'yeild' is not a keyword of structure property");
    entry.wrong("structure property 1 fbond 95", "fbond must be at most 89, not 95");
    return entry;
}

CommandSpec remove() {
    Entry<StructureDelete> entry(structure_word(), {"delete"});
    entry.help("takes cables out: one by its number, or those with a node in the range; all if neither is given");
    entry.otherwise({integer("n").at_least(1).optional().spec}, [](Reader& reader, StructureDelete& c) {
        if (c.number || reader.peek()->kind != WordKind::number) return false;
        c.number = reader.integer(integer("n").at_least(1).spec);
        return true;
    });
    entry.range(&StructureDelete::range);
    entry.right("structure delete 1").right("structure delete range z 0 1").right("struct delete");
    entry.wrong("structure delete 1.5", "delete takes a whole number, not 1.5");
    entry.wrong("structure delete rnge z 0 1", "'rnge' is not a keyword of structure delete");
    return entry;
}

} // namespace

std::vector<std::string_view> structure_property_words() {
    std::vector<std::string_view> words;
    for (const auto& known : property_words()) words.push_back(known.words.front().word);
    return words;
}

Family structures() { return {"structures", "cables and bolts in the rock", {cable(), property(), remove()}}; }

} // namespace kaya::lang
