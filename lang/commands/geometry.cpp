// Commands that make blocks and zones, and those that pick blocks.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

void block_options(Entry<PolyBrick>& entry) {
    const auto options = [](std::int64_t BlockOptions::*member) {
        return [member](PolyBrick& brick) -> auto& { return brick.options.*member; };
    };
    entry.keyword({"region"}, integer("n").at_least(0), options(&BlockOptions::region),
                  "region number, 0 if not given");
    entry.keyword({"material", "mat"}, integer("n").at_least(1), options(&BlockOptions::material),
                  "material number, 1 if not given");
    entry.keyword({"constitutive", "cons"}, integer("n").at_least(1), options(&BlockOptions::constitutive),
                  "constitutive number, 1 if not given");
    entry.options_before_form();
}

CommandSpec poly_brick() {
    Entry<PolyBrick> entry({"poly"}, {"brick"});
    entry.help("makes a block with six faces along the axes");
    entry.place(&PolyBrick::place);
    entry.argument(pair("x1 x2").unit("length").help("limits in x"),
                   [](PolyBrick& brick, std::array<double, 2> x) { brick.x = brick.y = brick.z = x; });
    entry.argument(pair("y1 y2").unit("length").optional().help("limits in y; those of x if not given"),
                   &PolyBrick::y);
    entry.argument(pair("z1 z2").unit("length").optional().help("limits in z; those of x if not given"),
                   &PolyBrick::z);
    block_options(entry);
    entry.finish([](const Reader& reader, PolyBrick& brick) {
        if (reader.wildcards()) return;
        const auto check = [&](const char* axis, const std::array<double, 2>& limits) {
            if (limits[0] < limits[1]) return;
            Diagnostic d(
                fmt::format("the brick has no extent in {}: from {:g} to {:g}", axis, limits[0], limits[1]),
                "the lower limit comes first and must be less than the upper one");
            throw d.at(brick.place);
        };
        check("x", brick.x);
        check("y", brick.y);
        check("z", brick.z);
    });
    entry.right("poly brick 0,1 0,1 0,1").right("poly brick -0.15,0.15 -0.10,0.10 -0.10,0.0");
    entry.right("poly brick (0,2)")
        .right("poly region 3 brick 0 1 0 1 0 1")
        .right("poly brick 0 1 0 1 0 1 mat=2 cons 1 reg 5");
    entry.wrong("poly", "a word is missing after 'poly'");
    entry.wrong("poly brik 0,1 0,1 0,1", "'brik' is not a kind of poly");
    entry.wrong("poly brick", "a number is missing after 'brick'");
    entry.wrong("poly brick 0 1 0 1 0", "a number is missing after '0'");
    entry.wrong("poly brick 0 one", "'one' stands where a number must be");
    entry.wrong("poly brick 1 0", "the brick has no extent in x: from 1 to 0");
    entry.wrong("poly brick 0 1 0 1 0 1 0 1", "'0' stands where a keyword of poly brick must be");
    entry.wrong("poly brick 0 1 regoin 2", "'regoin' is not a keyword of poly brick");
    return entry;
}

} // namespace

Family geometry() {
    return {
        "geometry",
        "blocks, zones, and what is visible",
        {
            poly_brick(),
            Entry<Hide>({"hide"})
                .help("hides blocks; most commands act on visible blocks only")
                .range(&Hide::range)
                .right("hide range z 0 .1")
                .right("hide region 1")
                .right("hide")
                .wrong("hide range", "the range is empty")
                .wrong("hide rnge z 0 1", "'rnge' is not a keyword of hide")
                .wrong("hide range z 1 0", "the lower limit 1 is greater than the upper limit 0")
                .wrong("hide range z", "a number is missing after 'z'")
                .wrong("hide range grup a", "'grup' is not a range element"),
            Entry<Seek>({"seek", "show"})
                .help("makes hidden blocks visible again")
                .range(&Seek::range)
                .right("seek")
                .right("show range group wall")
                .right("seek range sphere center 0 0 0 radius 2")
                .wrong("seek range sphere center 0 0 0", "the sphere needs center and radius")
                .wrong("seek range sphere center 0 0", "a number is missing after '0'")
                .wrong("seek range sphere center 0 0 0 radius -1", "radius must be greater than 0, not -1")
                .wrong("seek range cyl end1 0 0 0 radius 1", "the cylinder needs end1, end2 and radius"),
            Entry<Delete>({"delete"})
                .help("takes blocks out of the model for good")
                .range(&Delete::range)
                .right("delete range plane dip 30 dd 90 origin 0 0 5 above")
                .right("delete region 2")
                .right("delete range mat 1 union region 3 not")
                .wrong("delete range plane dip 30", "the plane does not say which part is meant")
                .wrong("delete range not z 0 1", "'not' stands before the element that it turns round"),
            Entry<Group>({"group"}, {"block"})
                .help("gives blocks a name by which a range finds them")
                .argument(text("name").help("name of the group"),
                          [](Group& g, std::string name) {
                              g.kind = "block";
                              g.name = std::move(name);
                          })
                .range(&Group::range)
                .right("group block wall range z 0 3")
                .right("group block 'left wall' range x -1 0 y 0 1")
                .wrong("group", "a word is missing after 'group'")
                .wrong("group wall", "'wall' is not a kind of group")
                .wrong("group block", "a word is missing after 'block'"),
            Entry<NameRange>({"range"}, {"name"})
                .help("gives a range phrase a name, used as: range nrange NAME")
                .argument(text("name").help("name of the range"), &NameRange::name)
                .range(&NameRange::range)
                .finish([](const Reader& reader, NameRange& named) {
                    if (named.range.elements.empty())
                        incomplete_line(reader, "the named range has no element",
                                        "write for example: range name top z 1 2");
                })
                .right("range name top z 0.9 1.1")
                .right("range name both nrange top bottom union")
                .wrong("range name top", "the named range has no element")
                .wrong("range z 0 1", "'z' is not a kind of range"),
            Entry<GenerateEdge>({"generate"}, {"edge"})
                .help("fills blocks with tetrahedral zones; from then on they deform")
                .argument(real("edge").unit("length").above(0).help("average edge of a zone"),
                          &GenerateEdge::edge)
                .range(&GenerateEdge::range)
                .place(&GenerateEdge::place)
                .right("gen edge 1")
                .right("gen edge 0.2 range region 1")
                .wrong("gen", "a word is missing after 'gen'")
                .wrong("gen edge", "a number is missing after 'edge'")
                .wrong("gen edge 0", "edge must be greater than 0, not 0")
                .wrong("gen edge -0.5", "edge must be greater than 0, not -0.5")
                .wrong("gen edge big", "'big' stands where a number must be")
                .wrong("gen egde 1", "'egde' is not a kind of generate"),
        }};
}

} // namespace kaya::lang
