// fracture: networks of discs, made one by one, drawn from laws, read from files, measured.
#include "lang/modern/language.hpp"
#include "lang/modern/leaf.hpp"

namespace kaya::lang {

namespace {

template <class Command> void add_choice(Leaf<Command>& leaf) {
    leaf.word("dfn", "dfn").word("ids", "ids").word("sizes", "sizes").word("of-group", "of-group");
}
template <class Command> void refuse_range(Leaf<Command>& leaf) {
    leaf.not_yet({"range"}, "ranges of fractures: write ids, sizes or of-group");
}
template <class Command> void add_group(Leaf<Command>& leaf) {
    leaf.word("group", "group").word("dominance|dfn-dominance", "dominance");
}

CommandSpec create_fracture() {
    Leaf<FractureCommand> leaf("fracture create", "fracture create");
    leaf.word("position", "position").word("dip", "dip").word("dip-direction", "dip-direction");
    leaf.word("size", "size").word("dfn", "dfn");
    add_group(leaf);
    leaf.not_yet({"intersection-set"}, "sets of intersections");
    leaf.no_effect("skip-errors", "accepted, without effect");
    leaf.right("fracture create position 0.5 0.5 0.5 dip 30 dip-direction 90 size 4 dfn 'faults'",
               "fracture create position 0.5 0.5 0.5 dip 30 dd 90 size 4 dfn faults");
    leaf.wrong("fracture create szie 1", "'szie' is not a keyword of fracture create");
    return leaf;
}

CommandSpec delete_fractures() {
    Leaf<FractureChange> leaf("fracture delete", "fracture delete");
    add_choice(leaf);
    leaf.word("outside", "outside").word("share", "share").word("seed", "seed");
    refuse_range(leaf);
    leaf.right("fracture delete dfn 'faults'", "fracture delete dfn faults");
    leaf.wrong("fracture delete dnf 'faults'", "'dnf' is not a keyword of fracture delete");
    return leaf;
}

CommandSpec copy_fractures() {
    Leaf<FractureChange> leaf("fracture copy", "fracture copy");
    add_choice(leaf);
    leaf.word("from-dfn", "from-dfn").word("to-dfn", "to-dfn").checks_of_meaning();
    refuse_range(leaf);
    leaf.right("fracture copy from-dfn 'faults' to-dfn 'all'", "fracture copy from-dfn faults to-dfn all");
    leaf.wrong("fracture copy", "the network of the copies is missing");
    return leaf;
}

CommandSpec truncate_fractures() {
    Leaf<FractureChange> leaf("fracture truncate", "fracture truncate");
    add_choice(leaf);
    leaf.word("box", "box").word("sides", "sides");
    leaf.right("fracture truncate box 0 10 0 10 0 10", "fracture truncate box 0 10 0 10 0 10");
    leaf.wrong("fracture truncate bxo 0", "'bxo' is not a keyword of fracture truncate");
    return leaf;
}

CommandSpec combine_fractures() {
    Leaf<FractureChange> leaf("fracture combine", "fracture combine");
    leaf.word("angle", "angle").word("distance", "distance").word("collapse", "collapse").word("merge", "merge");
    leaf.word("merge-convex", "merge-convex").word("sides", "sides");
    add_choice(leaf);
    leaf.checks_of_meaning();
    refuse_range(leaf);
    leaf.right("fracture combine angle 10 distance 0.5 merge", "fracture combine angle 10 distance 0.5 merge");
    leaf.right("fracture combine angle 10 distance 0.5 merge-convex sides 24",
               "fracture combine angle 10 distance 0.5 merge-convex sides 24");
    leaf.wrong("fracture combine angle 10", "combine needs an angle and a distance");
    return leaf;
}

CommandSpec group_fractures() {
    Leaf<FractureChange> leaf("fracture group", "fracture group");
    leaf.arguments_of_meaning().word("slot", "slot").word("remove", "remove");
    add_choice(leaf);
    refuse_range(leaf);
    leaf.right("fracture group 'large' slot 'size' sizes 5 100", "fracture group large slot size sizes 5 100");
    leaf.wrong("fracture group", "a word is missing after 'group'");
    return leaf;
}

CommandSpec cluster_fractures() {
    Leaf<FractureChange> leaf("fracture cluster", "fracture cluster");
    leaf.word("group-slot", "group-slot");
    add_choice(leaf);
    leaf.not_yet({"intersection-set"}, "sets of intersections");
    leaf.right("fracture cluster group-slot 'net'", "fracture cluster group-slot net");
    leaf.wrong("fracture cluster gruop-slot 'net'", "'gruop-slot' is not a keyword of fracture cluster");
    return leaf;
}

CommandSpec intersect_fractures() {
    Leaf<FractureMeasure> leaf("fracture intersections compute", "fracture intersections compute");
    add_choice(leaf);
    leaf.not_yet({"with-geometry", "intersection-set", "group-slot"}, "sets of intersections");
    leaf.right("fracture intersections compute", "fracture intersections compute");
    leaf.wrong("fracture intersections compute dnf 'a'", "'dnf' is not a keyword of fracture intersections compute");
    return leaf;
}

CommandSpec make_template() {
    Leaf<FractureTemplate> leaf("fracture template create", "fracture template create");
    leaf.arguments_of_meaning().word("orientation", "orientation").word("size", "size").word("position", "position");
    leaf.word("dip-limits", "dip-limits").word("dip-direction-limits", "dip-direction-limits");
    leaf.word("size-limits", "size-limits").checks_of_meaning();
    leaf.right("fracture template create 'a' orientation fisher 30 120 50 size power-law 3 size-limits 2 40",
               "fracture template create a orientation fisher 30 120 50 size power-law 3 size-limits 2 40");
    leaf.right("fracture template create 'a' orientation bootstrapped 'planes.txt' size bootstrapped 'sizes.txt'",
               "fracture template create a orientation bootstrapped planes.txt size bootstrapped sizes.txt");
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
    leaf.word("percolation", "percolation");
    leaf.word("generation-box", "generation-box").word("seed", "seed").checks_of_meaning();
    add_group(leaf);
    leaf.not_yet({"connectivity", "fish-stop", "modify", "tolerance-box"}, "other ends of a network");
    leaf.right("fracture generate template 'a' dfn 'faults' mass-density 0.5 generation-box 0 10 0 10 0 10",
               "fracture generate template a dfn faults mass-density 0.5 generation-box 0 10 0 10 0 10");
    leaf.wrong("fracture generate dfn 'faults'", "nothing says how many fractures are wanted");
    return leaf;
}

CommandSpec import_fractures() {
    Leaf<FractureImport> leaf("fracture import", "fracture import");
    leaf.word("from-file", "from-file").word("format", "format").word("dfn", "dfn").checks_of_meaning();
    add_group(leaf);
    leaf.not_yet({"from-geometry", "center", "clean", "offset", "make-disk", "make-planar", "truncate", "property-file",
                  "template-file", "skip-errors"},
                 "changes of fractures that are read");
    leaf.right("fracture import from-file 'faults.txt' dfn 'faults'",
               "fracture import from-file faults.txt dfn faults");
    leaf.wrong("fracture import", "a file is missing");
    return leaf;
}

CommandSpec export_fractures() {
    Leaf<FractureExport> leaf("fracture export", "fracture export");
    leaf.word("file", "file").word("format", "format").word("sides", "sides").checks_of_meaning();
    add_choice(leaf);
    leaf.not_yet({"property-file", "template-file", "intersect-with-plane"}, "other files of networks");
    refuse_range(leaf);
    leaf.right("fracture export file 'new.fab' format fracman", "fracture export file new.fab format fracman");
    leaf.wrong("fracture export", "a file is missing");
    return leaf;
}

CommandSpec measure_fractures() {
    Leaf<FractureMeasure> leaf("fracture compute", "fracture compute");
    leaf.word("p10", "p10").word("mass-density", "mass-density").word("center-density", "center-density");
    leaf.word("trace-mass-density", "trace-mass-density").word("trace-center-density", "trace-center-density");
    leaf.word("average-trace-length", "average-trace-length");
    leaf.word("begin", "begin").word("end", "end").word("box", "box").checks_of_meaning();
    add_choice(leaf);
    leaf.word("percolation", "percolation").word("option", "option");
    leaf.right("fracture compute trace-mass-density 'wall'", "fracture compute trace-mass-density wall");
    leaf.right("fracture compute percolation option 1", "fracture compute percolation option 1");
    leaf.right("fracture compute p10 begin 0 0 0 end 0 0 10", "fracture compute p10 begin 0 0 0 end 0 0 10");
    leaf.wrong("fracture compute", "nothing says what is measured");
    return leaf;
}

CommandSpec list_fractures() {
    Leaf<FractureMeasure> leaf("fracture list", "fracture list");
    leaf.word("intersection", "intersection");
    add_choice(leaf);
    leaf.not_yet({"attribute", "extra", "group", "position", "property"}, "columns of lists of fractures");
    leaf.right("fracture list", "fracture list");
    leaf.wrong("fracture list dnf 'a'", "'dnf' is not a keyword of fracture list");
    return leaf;
}

} // namespace

Family fracture_family() {
    return {"fracture",
            "networks of fractures",
            {create_fracture(), delete_fractures(), copy_fractures(), truncate_fractures(), combine_fractures(),
             group_fractures(), cluster_fractures(), make_template(), delete_template(), generate_fractures(),
             import_fractures(), export_fractures(), measure_fractures(), intersect_fractures(), list_fractures()}};
}

} // namespace kaya::lang
