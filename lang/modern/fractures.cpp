// fracture: networks of discs, made one by one, drawn from laws, read from files, measured.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

namespace {

CommandSpec create_fracture() {
    Leaf<FractureCommand> leaf("fracture create", "fracture create");
    leaf.word("position", "position").word("dip", "dip").word("dip-direction", "dip-direction");
    leaf.word("size", "size").word("dfn", "dfn");
    leaf.not_yet({"group", "dominance", "dfn-dominance", "intersection-set"}, "groups and ranks of fractures");
    leaf.no_effect("skip-errors", "accepted, without effect");
    leaf.right("fracture create position 0.5 0.5 0.5 dip 30 dip-direction 90 size 4 dfn 'faults'",
               "fracture create position 0.5 0.5 0.5 dip 30 dd 90 size 4 dfn faults");
    leaf.wrong("fracture create szie 1", "'szie' is not a keyword of fracture create");
    return leaf;
}

CommandSpec delete_fractures() {
    Leaf<FractureCommand> leaf("fracture delete", "fracture delete");
    leaf.word("dfn", "dfn");
    leaf.not_yet({"range"}, "parts of a network");
    leaf.right("fracture delete dfn 'faults'", "fracture delete dfn faults");
    leaf.wrong("fracture delete dnf 'faults'", "'dnf' is not a keyword of fracture delete");
    return leaf;
}

CommandSpec make_template() {
    Leaf<FractureTemplate> leaf("fracture template create", "fracture template create");
    leaf.arguments_of_meaning().word("orientation", "orientation").word("size", "size").word("position", "position");
    leaf.word("dip-limits", "dip-limits").word("dip-direction-limits", "dip-direction-limits");
    leaf.word("size-limits", "size-limits").checks_of_meaning();
    leaf.right("fracture template create 'a' orientation fisher 30 120 50 size power-law 3 size-limits 2 40",
               "fracture template create a orientation fisher 30 120 50 size power-law 3 size-limits 2 40");
    leaf.wrong("fracture template create 'a'", "a template needs a law of sizes");
    return leaf;
}

CommandSpec delete_template() {
    Leaf<FractureTemplate> leaf("fracture template delete", "fracture template delete");
    leaf.arguments_of_meaning();
    leaf.right("fracture template delete 'a'", "fracture template delete a");
    leaf.wrong("fracture template delete", "a word is missing after 'delete'");
    return leaf;
}

CommandSpec generate_fractures() {
    Leaf<FractureGenerate> leaf("fracture generate", "fracture generate");
    leaf.word("template", "template").word("dfn", "dfn").word("fracture-count", "fracture-count");
    leaf.word("mass-density", "mass-density").word("p10", "p10").word("begin", "begin").word("end", "end");
    leaf.word("generation-box", "generation-box").word("seed", "seed").checks_of_meaning();
    leaf.not_yet({"percolation", "connectivity", "fish-stop", "modify", "tolerance-box"}, "other ends of a network");
    leaf.not_yet({"dfn-dominance"}, "ranks of networks");
    leaf.right("fracture generate template 'a' dfn 'faults' mass-density 0.5 generation-box 0 10 0 10 0 10",
               "fracture generate template a dfn faults mass-density 0.5 generation-box 0 10 0 10 0 10");
    leaf.wrong("fracture generate dfn 'faults'", "nothing says how many fractures are wanted");
    return leaf;
}

CommandSpec import_fractures() {
    Leaf<FractureImport> leaf("fracture import", "fracture import");
    leaf.word("from-file", "from-file").word("dfn", "dfn").checks_of_meaning();
    leaf.not_yet({"from-geometry", "format", "center", "clean", "offset", "make-disk", "make-planar", "truncate",
                  "dominance", "property-file", "template-file", "skip-errors"},
                 "other files of fractures");
    leaf.right("fracture import from-file 'faults.txt' dfn 'faults'",
               "fracture import from-file faults.txt dfn faults");
    leaf.wrong("fracture import", "a file is missing");
    return leaf;
}

CommandSpec measure_fractures() {
    Leaf<FractureMeasure> leaf("fracture compute", "fracture compute");
    leaf.word("p10", "p10").word("mass-density", "mass-density").word("center-density", "center-density");
    leaf.word("begin", "begin").word("end", "end").word("box", "box").word("dfn", "dfn").checks_of_meaning();
    leaf.not_yet({"average-trace-length", "percolation", "trace-center-density", "trace-mass-density"},
                 "measures of traces");
    leaf.right("fracture compute p10 begin 0 0 0 end 0 0 10", "fracture compute p10 begin 0 0 0 end 0 0 10");
    leaf.wrong("fracture compute", "nothing says what is measured");
    return leaf;
}

CommandSpec list_fractures() {
    Leaf<FractureMeasure> leaf("fracture list", "fracture list");
    leaf.word("dfn", "dfn");
    leaf.not_yet({"attribute", "extra", "group", "intersection", "position", "property"},
                 "columns of lists of fractures");
    leaf.right("fracture list", "fracture list");
    leaf.wrong("fracture list dnf 'a'", "'dnf' is not a keyword of fracture list");
    return leaf;
}

} // namespace

Family fracture_family() {
    return {"fracture",
            "networks of fractures",
            {create_fracture(), delete_fractures(), make_template(), delete_template(), generate_fractures(),
             import_fractures(), measure_fractures(), list_fractures()}};
}

} // namespace kaya::lang
