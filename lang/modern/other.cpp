// history, table, plot, fish and block history: what is recorded and shown.
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"

namespace kaya::lang {

namespace {

/// `table s import f`, `table s add v ..`: a table by its name.
CommandSpec named_table() {
    Leaf<TableCommand> leaf("table");
    leaf.help("a table by its name: pairs (x, y), with linear interpolation");
    leaf.argument(text("name").help("name of the table, or its number as a text"),
                  Through{[](TableCommand& table, std::string name) {
                              TableValue named = table_named(std::move(name));
                              table.number = named.table;
                              table.name = std::move(named.name);
                          },
                          [](const TableCommand& table) {
                              return name_of_table.get({.table = table.number, .name = table.name});
                          }});
    leaf.keyword({"import"}, text("file"), &TableCommand::file,
                 "replaces the table by that of a file: a line of title, a line `count step`, then the values");
    leaf.action(
        {"clear", "delete"}, [](TableCommand& t) { t.clear = true; }, "removes all pairs");
    using Point = std::array<double, 2>;
    const auto point = Parts<Point>()
                           .then(
                               real("x"), [](Point & p) -> auto& { return p[0]; })
                           .then(
                               real("y"), [](Point & p) -> auto& { return p[1]; });
    for (const char* word : {"add", "insert"})
        leaf.keyword({word}, Parts<TableCommand>().each_of(&TableCommand::points, point), "pairs, in their place by x");
    leaf.no_effect("sort", "tables are always sorted");
    leaf.not_yet({"position", "label", "list", "export"}, "other commands of tables");
    leaf.finish([](const Reader& reader, TableCommand& t) {
        if (t.points.empty() && t.file.empty() && !t.clear && reader.statement().words.size() < 3)
            incomplete_line(reader, "table does not say what to do", "expected: add, insert, import or clear");
    });
    leaf.right("table '1' add (0,1) (1,2)", "table 1 0 1 1 2").right("table 'run01' import 'quake.tab'");
    leaf.right("table '1' delete", "table 1 clear");
    leaf.wrong("table 'a'", "table does not say what to do");
    leaf.wrong("table 'a' add 1", "a number is missing after '1'");
    leaf.wrong("table 'a' impotr 'f'", "'impotr' is not a keyword of table");
    return leaf;
}

/// `fish history [name s] f`
CommandSpec fish_history() {
    Leaf<HistoryAdd> leaf("fish history");
    leaf.help("records a FISH function or variable from now on");
    const ArgumentSpec name = text("name").spec;
    const auto only = only_of(&HistoryAdd::items);
    leaf.keyword({"name"}, Parts<HistoryAdd>().in(only, Parts<HistoryItem>().then(text("name"), &HistoryItem::name)),
                 "name of the history in files");
    leaf.otherwise({name}, [name](Reader& reader, HistoryAdd& history) {
        if (!history.items.empty() && history.items.front().text) return false;
        if (history.items.empty()) history.items.emplace_back();
        HistoryItem& item = history.items.front();
        item.text = reader.peek()->place;
        const bool symbol = reader.peek()->kind == WordKind::symbol;
        item.what = HistoryItem::Script{symbol ? reader.symbol(name) : reader.text(name)};
        return true;
    });
    leaf.prints(Parts<HistoryAdd>().in(only, Parts<HistoryItem>().in(as<HistoryItem::Script>(&HistoryItem::what),
                                                                     Parts<HistoryItem::Script>().then(
                                                                         text("name"), &HistoryItem::Script::symbol))),
                true);
    leaf.finish([](const Reader& reader, HistoryAdd& history) {
        if (history.items.empty() || !history.items.front().text)
            incomplete_line(reader, "the history has no function to record", "write for example: fish history thrust");
    });
    leaf.right("fish history wave", "hist @wave").right("fish history name 'thrust' @wave");
    leaf.wrong("fish history", "the history has no function to record");
    return leaf;
}

/// `block dynamic eigen modes n`: as 3DEC, of the joints as they are; the modes are shown at once.
CommandSpec eigen_modes() {
    Leaf<List> leaf("block dynamic eigen");
    leaf.means("list frequencies");
    leaf.help("lowest frequencies of rigid blocks on their joints, and the mass that each moves");
    leaf.start([](const Statement&, List& command) { command.what = List::What::frequencies; });
    leaf.keyword({"modes"}, integer("n").at_least(1), &List::number, "number of modes, 6 if not given");
    leaf.no_effect("list", "they are always shown");
    leaf.not_yet({"setmode"}, "the shape of a mode in extra variables of gridpoints");
    leaf.right("block dynamic eigen modes 4", "list frequencies 4").right("block dynamic eigen", "list frequencies");
    leaf.right("block dynamic eigen list", "list frequencies");
    leaf.wrong("block dynamic eigen modes 0", "modes must be at least 1, not 0");
    leaf.wrong("block dynamic eigen moeds 4", "'moeds' is not a keyword of block dynamic eigen");
    return leaf;
}

/// `block vtk filename f`: one file has all fields.
CommandSpec block_vtk() {
    Leaf<VtkWrite> leaf("block vtk");
    leaf.means("vtk write").help("writes blocks and joints for ParaView");
    leaf.keyword({"filename"}, text("file"), &VtkWrite::file, "name of the files, without suffix");
    for (const char* word : {"displacements", "velocities", "stresses", "groups", "forces", "pore-pressure", "binary"})
        leaf.no_effect_switch(word, "the files have all fields");
    leaf.not_yet({"range", "zone-extra", "gridpoint-extra", "temperature"}, "parts of the files");
    leaf.finish([](const Reader& reader, VtkWrite& command) {
        if (command.file.empty()) incomplete_line(reader, "the name of the file is missing", "write: filename 'name'");
    });
    leaf.right("block vtk filename 'settled' velocities on", "vtk write settled");
    leaf.wrong("block vtk velocities on", "the name of the file is missing");
    leaf.wrong("block vtk fielname 'a'", "'fielname' is not a keyword of block vtk");
    return leaf;
}

} // namespace

Family block_family() {
    Family family{"block", "selecting, holding, moving and loading blocks", block_commands()};
    for (auto commands : {ground_commands(), block_history_commands()})
        family.commands.insert(family.commands.end(), commands.begin(), commands.end());
    using enum List::What;
    family.commands.push_back(list_line("block list", blocks, "blocks: place, mass, material, region",
                                        "block list velocity moment range position-z 0 1",
                                        "list blocks show velocity show moment range z 0 1",
                                        {"block list velocty", "'velocty' is not a keyword of block list"}));
    family.commands.push_back(ignored_line("block tolerance", "lengths that cuts and blocks use",
                                           "cuts are exact; `jset tolerance` leaves out cuts near corners",
                                           "block tolerance 0.001"));
    family.commands.push_back(
        ignored_line("block dynamic eigen delete", "forgets modes", "kaya stores none", "block dynamic eigen delete"));
    family.commands.push_back(eigen_modes());
    family.commands.push_back(block_vtk());
    family.commands.push_back(list_line("block list memory", memory, "memory of the tables of the model",
                                        "block list memory", "list memory"));
    family.commands.push_back(list_line(
        "block list contacts", contacts, "contacts: blocks, normal, area", "block list contacts", "list contacts",
        {"block list contacts psition", "'psition' is not a keyword of block list contacts"}));
    family.commands.push_back(
        list_line("block list group", groups, "names of groups", "block list group", "list groups"));
    family.commands.push_back(
        list_line("block list energy", energy, "energies and their balance", "block list energy", "list energy"));
    family.commands.push_back(list_line("block list maxima|maximum", extremes, "greatest values of the model",
                                        "block list maxima", "list max"));
    family.commands.push_back(list_line("block face list", faces, "faces: place, normal, area",
                                        "block face list range position-z 2", "list faces range z 2",
                                        {"block face list vertces", "'vertces' is not a keyword of block face list"}));
    return family;
}

Family other_family() {
    Family family{"history", "histories, tables and functions", history_commands()};
    family.commands.push_back(named_table());
    family.commands.push_back(fish_history());
    family.commands.push_back(list_line("table list", List::What::tables, "tables: number of pairs and their limits",
                                        "table list", "list tables"));
    family.commands.push_back(ignored_line("fish boolean-convert", "truths that are numbers", "kaya needs no switch",
                                           "fish boolean-convert on"));
    return family;
}

} // namespace kaya::lang
