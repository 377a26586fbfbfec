// structure ...: cables, beams and liners.
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
    const auto first = Parts<StructureCable>().set(&StructureCable::anchor_first, true);
    const auto last = Parts<StructureCable>().set(&StructureCable::anchor_last, true);
    entry.keyword({"anchor"},
                  Parts<StructureCable>().one_of(
                      text("first|last|both").spec, "an end of a cable",
                      {{"first", first}, {"last", last}, {"both", Parts<StructureCable>(first).then(last)}}),
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

using Grip = StructureBeam::Grip;

/// anchor first, clamp both: ends of a beam that are held.
void add_grip(Entry<StructureBeam>& entry, const char* word, Grip grip, const char* help) {
    const auto first = Parts<StructureBeam>().set(&StructureBeam::first, grip);
    const auto last = Parts<StructureBeam>().set(&StructureBeam::last, grip);
    entry.keyword({word},
                  Parts<StructureBeam>().one_of(text("first|last|both|all").spec, "a part of a beam",
                                                {{"first", first},
                                                 {"last", last},
                                                 {"both", Parts<StructureBeam>(first).then(last)},
                                                 {"all", Parts<StructureBeam>().set(&StructureBeam::all, grip)}}),
                  help);
}

CommandSpec beam() {
    Entry<StructureBeam> entry(structure_word(), {"beam"});
    entry.help("puts a beam on the rock: elements that stretch, bend and twist, on a line of straight parts");
    entry.place(&StructureBeam::place);
    const auto place = [](const Argument<Vec3>& argument) {
        return Parts<StructureBeam>().next(argument, &StructureBeam::places);
    };
    entry.argument(place(vector("x1 y1 z1").unit("length").help("first end")));
    entry.argument(
        place(vector("x2 y2 z2").unit("length").help("last end, or the next corner; as many may follow as it has")));
    entry.keyword({"segments"}, integer("n").at_least(1).at_most(100000), &StructureBeam::segments,
                  "number of elements of each straight part; 10 if not given");
    entry.keyword({"property"}, integer("n").at_least(1), &StructureBeam::property,
                  "number of its properties; 1 if not given");
    entry.keyword(
        {"axis-y", "direction-y"}, vector("x y z"), &StructureBeam::axis,
        "where its axis y points, without its part along the beam; global y if not given, x where the beam goes along y");
    add_grip(entry, "anchor", Grip::anchor, "nodes that move with the rock and rotate freely");
    add_grip(entry, "clamp", Grip::clamp, "nodes that move and rotate with a rigid block");
    entry.keyword({"tolerance"}, real("t").unit("length").at_least(0), &StructureBeam::tolerance,
                  "how far outside of the rock a node still lies on it; a millionth of the block if not given");
    entry.values(place(vector("x y z").optional()), [](Reader& reader, StructureBeam&) {
        const WordKind kind = reader.peek()->kind;
        return kind == WordKind::number || kind == WordKind::symbol;
    });
    entry.finish([](const Reader& reader, StructureBeam& beam) {
        if (reader.wildcards()) return;
        for (std::size_t k = 1; k < beam.places.size(); ++k)
            if (beam.places[k] == beam.places[k - 1])
                incomplete_line(reader, "two neighbouring places of the beam are the same", "give places that differ");
        if (beam.axis && beam.axis->isZero(0))
            incomplete_line(reader, "axis-y has no direction", "give one that is not 0");
    });
    entry.right("structure beam 0 0 1 5 0 1 segments 20 property 2 clamp both")
        .right("struct beam (0,0,0) (1,0,1) (2,0,1) (3,0,0) seg 4 prop 1 axis-y 0 1 0 anchor first");
    entry.right("structure beam 0 0.5 0.5 1 0.5 0.5 anchor all tolerance 0.01");
    entry.wrong("structure beam 0 0 1 5 0", "a number is missing after '0'");
    entry.wrong("structure beam 0 0 1 5 0 1 6", "a number is missing after '6'");
    entry.wrong("structure beam 0 0 1 0 0 1", "two neighbouring places of the beam are the same");
    entry.wrong("structure beam 0 0 1 5 0 1 segments 0", "segments must be at least 1, not 0");
    entry.wrong("structure beam 0 0 1 5 0 1 clamp middle", "'middle' is not a part of a beam");
    entry.wrong("structure beam 0 0 1 5 0 1 axis-y 0 0 0", "axis-y has no direction");
    entry.wrong("structure beam 0 0 1 5 0 1 segmnets 5", "'segmnets' is not a keyword of structure beam");
    return entry;
}

CommandSpec liner() {
    Entry<StructureLiner> entry(structure_word(), {"liner"});
    entry.help(
        "puts a liner on faces of blocks, as shotcrete: plates that stretch and bend, on all that nothing covers");
    entry.place(&StructureLiner::place);
    entry.keyword({"property"}, integer("n").at_least(1), &StructureLiner::property,
                  "number of its properties; 1 if not given");
    entry.keyword({"edge"}, real("e").unit("length").above(0), &StructureLiner::edge,
                  "no side of an element is longer; the triangles of the faces if not given");
    entry.keyword(
        {"axis"}, vector("x y z"), &StructureLiner::axis,
        "axis x of its forces, without its part along the normal; global x if not given, y where that is the normal");
    entry.action(
        {"anchor"}, [](StructureLiner& c) { c.grip = Grip::anchor; },
        "all its nodes move with the rock, even if its properties have springs");
    entry.action(
        {"clamp"}, [](StructureLiner& c) { c.grip = Grip::clamp; }, "all its nodes move and rotate with rigid blocks");
    entry.keyword(
        {"tolerance"}, real("t").unit("length").at_least(0), &StructureLiner::tolerance,
        "corners of faces that are nearer to each other are one; a ten thousandth of the extent of the faces if not given");
    entry.range(&StructureLiner::range, true);
    entry.finish([](const Reader& reader, StructureLiner& c) {
        if (!reader.wildcards() && c.axis && c.axis->isZero(0))
            incomplete_line(reader, "axis has no direction", "give one that is not 0");
    });
    entry.right("structure liner property 2 edge 0.5 axis 0 1 0 range cylinder end1 0 0 0 end2 0 10 0 radius 3.1")
        .right("struct liner prop 1 range z 0 1")
        .right("structure liner clamp tolerance 0.001");
    entry.wrong("structure liner edge 0", "edge must be greater than 0, not 0");
    entry.wrong("structure liner property", "a number is missing after 'property'");
    entry.wrong("structure liner axis 0 0 0", "axis has no direction");
    entry.wrong("structure liner proprety 1", "'proprety' is not a keyword of structure liner");
    return entry;
}

struct PropertyWord {
    std::vector<Spelling> words; ///< the first is the name in src/model/tables/structure_properties.cpp
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
         "density; that of a cable changes nothing, since it has no weight and no inertia"},
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
        {{"yield", "cb_yield", "yield-tension"},
         "force",
         "tensile strength of a cable or beam; without limit if not given"},
        {{"ycomp", "cb_ycomp", "yield-compression"},
         "force",
         "compressive strength of a cable or beam; without limit if not given"},
        {{"rupture", "tensile-failure-strain"},
         "",
         "plastic strain at which a bar of a cable breaks; never if not given"},
        {{"poisson", "pratio", "prat"}, "", "Poisson's ratio of beams and liners; 0 if not given", 0.499},
        {{"moi-y", "xciy"}, "length^4", "second moment of area of a beam about its axis y"},
        {{"moi-z", "xciz"}, "length^4", "the same about its axis z"},
        {{"torsion-constant", "moi-polar", "xcj"},
         "length^4",
         "torsion constant of a beam; the sum of the two if not given"},
        {{"plastic-moment-y"},
         "moment",
         "bending moment about y at which a beam gets a plastic hinge; without limit if not given"},
        {{"plastic-moment-z"}, "moment", "the same about z"},
        {{"thickness", "thick"}, "length", "thickness of a liner"},
        {{"kn", "coupling-stiffness-normal", "cs_nk"},
         "stress/length",
         "normal stiffness of links to the rock: of a liner per area, of a beam per length; rigid if neither it nor ks is given"},
        {{"ks", "coupling-stiffness-shear", "cs_sk"},
         "stress/length",
         "shear stiffness of links to the rock, likewise"},
        {{"cohesion", "coupling-cohesion-shear", "cs_scoh"},
         "stress",
         "shear strength of the bond of links, per area or length; without limit if neither it nor friction is given"},
        {{"friction", "coupling-friction-shear", "cs_sfric"}, "degrees", "friction angle of links", 89},
        {{"tension", "coupling-yield-normal", "cs_ncut"},
         "stress",
         "tensile strength of the bond of links, per area or length; it breaks there for good; without limit if not given"},
    };
    return words;
}

CommandSpec property() {
    Entry<StructureProperty> entry(structure_word(), {"property"});
    entry.help("defines the properties of cables, beams or liners under a number");
    entry.place(&StructureProperty::place);
    entry.argument(integer("n").at_least(1).help("number of the properties"), &StructureProperty::number);
    for (const auto& known : property_words()) {
        auto value = real(known.words.front().word).unit(known.unit).at_least(0);
        if (known.most > 0) value.spec.limits.high = known.most;
        entry.keyword(
            known.words,
            Parts<StructureProperty>().in(next_of(&StructureProperty::items),
                                          Parts<StructureProperty::Item>()
                                              .set(&StructureProperty::Item::name, std::string(value.spec.name))
                                              .then(value, &StructureProperty::Item::value)),
            known.help);
    }
    using Items = Parts<StructureProperty>;
    const auto moment = real("plastic-moment").unit("moment").at_least(0);
    const auto both = [](StructureProperty& p, double value) {
        p.items.push_back({"plastic-moment-y", value});
        p.items.push_back({"plastic-moment-z", value});
    };
    entry.keyword({"plastic-moment"},
                  Items()
                      .argument(moment.spec)
                      .by([=](Reader& reader, StructureProperty& p) { both(p, reader.real(moment.spec)); },
                          [=](Items::Form form, const StructureProperty& wanted) {
                              const std::size_t at = form.after.items.size();
                              if (at >= wanted.items.size() || !print_value(form.words, wanted.items[at].value))
                                  return Items::Forms{};
                              both(form.after, wanted.items[at].value);
                              return Items::Forms{std::move(form)};
                          }),
                  "plastic-moment-y and plastic-moment-z at once");
    entry.finish([](const Reader& reader, StructureProperty& p) {
        if (p.items.empty())
            incomplete_line(reader, "no property is given",
                            "write for example: structure property 1 area 5e-4 young 2e11 yield 2.5e5");
    });
    entry.right("structure property 1 area 181e-6 young 98.6e9 kbond 1.12e8 sbond 1.75e5 yield 5e5");
    entry.right(
        "structure property 3 area 6e-3 young 2e11 poisson 0.3 density 7800 moi-y 2e-5 moi-z 7e-6 plastic-moment 5e4");
    entry.right(
        "structure property 4 thickness 0.15 young 2e10 poisson 0.2 density 2400 kn 1e10 ks 1e9 cohesion 5e5 friction 35 tension 5e5");
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
    entry.help(
        "deletes cables, beams and liners: one by its number, or those with a node in the range; all if neither is given");
    entry.values(
        Parts<StructureDelete>().then(integer("n").at_least(1).optional(), &StructureDelete::number),
        [](Reader& reader, StructureDelete& c) { return !c.number && reader.peek()->kind == WordKind::number; });
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

Family structures() {
    return {
        "structures", "cables in the rock, beams and liners on it", {cable(), beam(), liner(), property(), remove()}};
}

} // namespace kaya::lang
