// block zone ...: deformable blocks.
#include "lang/commands/property_items.hpp"
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

#include <algorithm>
#include <array>

namespace kaya::lang {

namespace {

CommandSpec zone_edges() {
    Leaf<GenerateEdge> leaf("block zone generate edgelength", "generate edge");
    leaf.argument(real("edge").unit("length").above(0).help("average edge of a zone"), &GenerateEdge::edge);
    leaf.no_effect("alternate", "blocks are always meshed alone");
    leaf.ranged(&GenerateEdge::range);
    leaf.right("block zone generate edgelength 1", "gen edge 1");
    leaf.right("block zone gen edgelength 0.5 range region 1", "gen edge 0.5 range region 1");
    leaf.wrong("block zone generate edgelength", "a number is missing after 'edgelength'");
    leaf.wrong("block zone generate edgelength 0", "edge must be greater than 0, not 0");
    leaf.wrong("block zone generate egdelength 1", "'egdelength' is not a kind of block zone generate");
    return leaf;
}

CommandSpec edges_around() {
    Leaf<GenerateEdge> leaf("block zone generate center", "generate edge");
    leaf.help("fills blocks with zones whose edges grow with the distance from a place");
    leaf.argument(vector("x y z").unit("length").help("the place"), &GenerateEdge::center);
    leaf.word("edgelength-center", "edgelength-center").word("edgelength-distance", "edgelength-distance");
    leaf.word("distance", "distance").checks_of_meaning().ranged(&GenerateEdge::range);
    leaf.right("block zone generate center 0 0 0 edgelength-center 0.4 edgelength-distance 1 distance 5 "
               "range region 1",
               "gen edge center 0 0 0 edgelength-center 0.4 edgelength-distance 1 distance 5 range region 1");
    leaf.wrong("block zone generate center 0 0 0",
               "edges that vary with the distance from a place lack edgelength-center, edgelength-distance, distance");
    return leaf;
}

CommandSpec zone_cells() {
    Leaf<GenerateQuad> leaf("block zone generate hexahedra", "generate quad");
    leaf.word("divisions", "ndivisions", "cells along the edges of the block that are nearest to x, y and z");
    leaf.no_effect("single-quad", "a cell is always of six zones");
    leaf.not_yet({"ratio-multiply"}, "cells that grow along an edge: write gen quad ndiv n n n ratio r r r");
    leaf.ranged(&GenerateQuad::range);
    leaf.finish([](const Reader& reader, GenerateQuad& command) {
        if (!command.given)
            incomplete_line(reader, "block zone generate hexahedra does not say how many cells",
                            "write for example: block zone generate hexahedra divisions 4 4 8");
    });
    leaf.right("block zone generate hexahedra divisions 2 2 2", "gen quad ndiv 2 2 2");
    leaf.wrong("block zone generate hexahedra", "block zone generate hexahedra does not say how many cells");
    leaf.wrong("block zone generate hexahedra divisions 4 4", "a number is missing after '4'");
    return leaf;
}

CommandSpec model_line(std::string_view words, std::string_view example) {
    Leaf<ZoneModelCommand> leaf(words);
    leaf.means("zone model").help("assigns a zone model to the zones of blocks");
    const std::size_t name_at = tree_words(words).size();
    leaf.start([name_at](const Statement& statement, ZoneModelCommand& command) {
        command.action = ZoneModelCommand::Action::assign;
        if (statement.words.size() > name_at) command.model_place = statement.words[name_at].place;
    });
    leaf.argument(text("name").help("name of the zone model"), &ZoneModelCommand::model);
    leaf.ranged(&ZoneModelCommand::range);
    leaf.right(example, "zone model mohr-coulomb range region 3");
    return leaf;
}

CommandSpec zone_assign_word() {
    CommandSpec spec = model_line("block zone cmodel assign", "block zone cmodel assign mohr-coulomb range region 3");
    spec.wrong = {{"block zone cmodel assign", "a word is missing after 'assign'"}};
    return spec;
}

CommandSpec zone_assign_name() {
    CommandSpec spec = model_line("block zone cmodel", "block zone cmodel mohr-coulomb range region 3");
    spec.wrong = {{"block zone cmodel", "a word is missing after 'cmodel'"}};
    return spec;
}

CommandSpec zone_load() {
    Leaf<ZoneModelCommand> leaf("block zone cmodel load", "zone load");
    leaf.arguments_of_meaning().checks_of_meaning();
    leaf.right("block zone cmodel load 'hoek-brown'", "zone load hoek-brown");
    leaf.wrong("block zone cmodel load", "a word is missing after 'load'");
    return leaf;
}

CommandSpec zone_property() {
    Leaf<ZoneModelCommand> leaf("block zone property");
    leaf.means("zone property");
    leaf.help("sets the density of blocks, and properties of the zone model that they have");
    leaf.keyword({"density"}, real("density").unit("mass/length^3").above(0), &ZoneModelCommand::density,
                 "density of the blocks");
    property_values(leaf);
    leaf.ranged(&ZoneModelCommand::range);
    leaf.finish([](const Reader& reader, ZoneModelCommand& command) {
        if (command.items.empty() && !command.density)
            incomplete_line(reader, "no property is given", "write for example: block zone property density 2600");
    });
    leaf.right("block zone property density 2600 bulk 5e9 shear 3e9 range region 3");
    leaf.right("block zone prop bulk 5e9 shear 3e9 range region 3", "zone property bulk 5e9 shear 3e9 range region 3");
    leaf.wrong("block zone property", "no property is given");
    leaf.wrong("block zone property density -1", "density must be greater than 0, not -1");
    leaf.wrong("block zone property bulk", "a number is missing after 'bulk'");
    return leaf;
}

CommandSpec zone_initialize() {
    Leaf<Initialize> leaf("block zone initialize", "initialize");
    constexpr std::array words{"stress-xx", "stress-yy", "stress-zz", "stress-xy", "stress-xz", "stress-yz"};
    const ArgumentSpec six = tensor("sxx syy szz sxy sxz syz").unit("stress").spec;
    leaf.keyword({"stress"},
                 Parts<Initialize>().argument(six).by(
                     [six](Reader& reader, Initialize& command) {
                         for (auto& component : command.stress) component.emplace().at_origin = reader.real(six);
                     },
                     [](Parts<Initialize>::Form form, const Initialize& wanted) {
                         for (std::size_t k = 0; k < 6; ++k) {
                             const auto& component = wanted.stress[k];
                             if (!component || !print_value(form.words, component->at_origin))
                                 return Parts<Initialize>::Forms{};
                             form.after.stress[k].emplace().at_origin = component->at_origin;
                         }
                         return Parts<Initialize>::Forms{std::move(form)};
                     }),
                 "total stress of the zones, compression negative");
    const auto component =
        Parts<LinearNumber>()
            .then(real("s").unit("stress"), &LinearNumber::at_origin)
            .perhaps({{"gradient",
                       Parts<LinearNumber>().then(vector("gx gy gz").unit("stress/length"), &LinearNumber::gradient)}});
    for (std::size_t k = 0; k < words.size(); ++k)
        leaf.keyword({words[k]},
                     Parts<Initialize>().in(made_at<Initialize, LinearNumber>([k](Initialize & command) -> auto& {
                                                return command.stress[k];
                                            }),
                                            component),
                     "one component of the stress; `gradient gx gy gz` may follow");
    leaf.not_yet({"stress-principal", "state", "extra"}, "other values of zones");
    leaf.not_yet({"add", "multiply", "vary", "local"}, "changes of the values that are there");
    leaf.ranged(&Initialize::range);
    leaf.finish([](const Reader& reader, Initialize& command) {
        if (std::ranges::none_of(command.stress, [](const auto& s) { return s.has_value(); }))
            incomplete_line(reader, "block zone initialize does not say what to set",
                            "expected: stress, stress-xx, ...");
    });
    leaf.right("block zone initialize stress -1e3 -2e3 -3e3 0 0 0",
               "initialize sxx -1e3 syy -2e3 szz -3e3 sxy 0 sxz 0 syz 0");
    leaf.right("block zone initialize stress-zz -1e6 gradient 0 0 2.6e4 range position-z -100 2",
               "initialize szz -1e6 zgrad 2.6e4 range z -100 2");
    leaf.wrong("block zone initialize", "block zone initialize does not say what to set");
    leaf.wrong("block zone initialize stress-zz", "a number is missing after 'stress-zz'");
    return leaf;
}

CommandSpec zone_group() {
    auto leaf = group_leaf("block zone group", "group zone");
    leaf.right("block zone group 'core' range cylinder end-1 0 0 0 end-2 0 0 9 radius 1",
               "group zone core range cyl end1 0 0 0 end2 0 0 9 radius 1");
    leaf.wrong("block zone group", "a word is missing after 'group'");
    return leaf;
}

CommandSpec mixed_discretization() {
    Leaf<ZoneAveraging> leaf("block zone nodal-mixed-discretization", "zone nmd");
    leaf.arguments_of_meaning();
    leaf.right("block zone nodal-mixed-discretization off", "zone nmd off");
    leaf.wrong("block zone nodal-mixed-discretization maybe", "expected on or off, found 'maybe'");
    return leaf;
}

} // namespace

Family zone_family() {
    return {"block zone",
            "deformable blocks",
            {
                zone_edges(),
                edges_around(),
                zone_cells(),
                zone_assign_word(),
                zone_assign_name(),
                zone_load(),
                zone_property(),
                zone_initialize(),
                zone_group(),
                mixed_discretization(),
                list_line("block zone list", List::What::zones, "zones: stresses, volume", "block zone list",
                          "list zones", {"block zone list strss", "'strss' is not a keyword of block zone list"}),
                list_line("block zone list stress-principal", List::What::stresses, "principal stresses of zones",
                          "block zone list stress-principal", "list stress"),
            }};
}

} // namespace kaya::lang
