// What a user sees of a model: lists, pictures, files for other programs.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

struct Listed {
    std::vector<Spelling> words;
    const char* help;
};

const std::vector<Listed>& listed() {
    static const std::vector<Listed> words = {
        {{"blocks"}, "blocks: place, mass, material, region"},
        {{"quality"}, "blocks that will make trouble, and what helps; also `list blocks quality`"},
        {{"contacts"}, "contacts: blocks, normal, area"},
        {{"subcontacts"}, "sub-contacts: displacements, forces, state"},
        {{"gridpoints", "gp"}, "gridpoints: place, velocity, displacement, force"},
        {{"zones"}, "zones: stresses, volume"},
        {{"prop", "property"}, "properties of materials"},
        {{"hist", "histories"}, "histories: number, name, least and greatest value"},
        {{"max", "maximum"}, "greatest values of the model"},
        {{"time"}, "time and cycle"},
        {{"timestep"}, "time step and what limits it"},
        {{"timing"}, "seconds spent in each phase of the cycle"},
        {{"energy"}, "energies and their balance"},
        {{"hash"}, "one number that tells two states of a model apart"},
        {{"jmodel", "jmodels"}, "joint models that are loaded, with their properties"},
        {{"boundary"}, "loads and held velocities"},
        {{"groups"}, "names of groups and how many blocks, faces, zones and joints each has"},
        {{"excavated"}, "blocks that fill can put back"},
        {{"state"}, "joints by joint model and state: sub-contacts and their area"},
        {{"stress"}, "zones: principal, mean and greatest shear stress"},
        {{"jset"}, "joint sets: mean orientation, faces, contacts"},
        {{"memory"}, "what the tables of the model take"},
        {{"version"}, "version of the program"},
        {{"settings"}, "settings of the model"},
        {{"tables"}, "tables: number of pairs and their limits"},
        {{Spelling{"ranges", 6}}, "named ranges"},
        {{"fish"}, "variables and functions of FISH"},
    };
    return words;
}

CommandSpec list() {
    Entry<List> entry({"list", "print"});
    entry.help("shows what is in the model, or the value of a variable");
    for (const auto& item : listed()) {
        const std::string what(item.words.front().word);
        entry.special(item.words, {},
                      [what](Reader& reader, List& command) {
                          if (what == "quality" && command.what == "blocks") command.what.clear();
                          if (!command.what.empty() || !command.symbols.empty())
                              throw Diagnostic("one list command shows one thing",
                                               "write a second list command")
                                  .at(reader.previous().place);
                          command.what = what;
                      },
                      item.help);
    }
    for (const auto& [word, about] : std::initializer_list<std::pair<const char*, const char*>>{
             {"structure", "cables, beams and liners"}})
        entry.not_yet({Spelling{word, 3}}, about);
    entry.otherwise({text("@name").optional().spec}, [](Reader& reader, List& command) {
        if (reader.peek()->kind != WordKind::symbol || !command.what.empty()) return false;
        command.symbols.push_back(reader.symbol(text("@name").spec));
        return true;
    });
    entry.range(&List::range, true); // print x is more likely meant as print @x
    entry.finish([](const Reader& reader, List& command) {
        if (command.what.empty() && command.symbols.empty())
            incomplete_line(reader, "list does not say what to show", "write for example: list blocks");
    });
    entry.right("list blocks")
        .right("print @x")
        .right("print @a @b")
        .right("pri max")
        .right("list contacts range z 0 1")
        .right("list blocks quality");
    entry.wrong("list", "list does not say what to show");
    entry.wrong("print blokcs", "'blokcs' is not a keyword of list");
    entry.wrong("list blocks zones", "one list command shows one thing");
    entry.wrong("print x", "'x' is not a keyword of list");
    entry.wrong("list 5", "'5' stands where a keyword of list must be");
    return entry;
}

CommandSpec find() {
    return Entry<List>({"find"})
        .help("lists the blocks of a range")
        .start([](const Statement&, List& command) { command.what = "blocks"; })
        .range(&List::range)
        .right("find range sphere center 0 0 0 radius 1")
        .right("find region 2")
        .wrong("find reigon 2", "'reigon' is not a keyword of find");
}

CommandSpec ignored(const char* word, const char* help) {
    Entry<Ignored> entry({word});
    entry.help(help);
    entry.raw(&Ignored::word).support(Support::ignored);
    entry.start([name = std::string(word)](const Statement&, Ignored& command) { command.word = name; });
    return entry;
}

} // namespace

Family output() {
    CommandSpec plot =
        ignored("plot", "read to its end; pictures are made from the files that vtk write leaves");
    plot.right = {{"pl block", {}}, {"plot hist 1 vs 2 &\n  hold", {}}, {"plot set dip 10 dd 'open", {}}};
    CommandSpec movie = ignored("movie", "read to its end, without effect");
    movie.right = {{"movie on file a.avi", {}}};
    CommandSpec update = ignored("update", "read to its end, without effect: the cycle looks after itself");
    update.right = {{"update", {}}};
    CommandSpec label = ignored("label", "read to its end, without effect");
    label.right = {{"label arrow 1 2 3", {}}};
    return {"output",
            "lists, pictures, files for other programs",
            {
                list(),
                find(),
                std::move(plot),
                Entry<VtkWrite>({"vtk"}, {"write"})
                    .help("writes the model as it stands for ParaView; files of one name make a series")
                    .argument(text("file").help("name without suffix"), &VtkWrite::file)
                    .right("vtk write shear")
                    .wrong("vtk", "a word is missing after 'vtk'")
                    .wrong("vtk write", "a word is missing after 'write'")
                    .wrong("vtk wirte a", "'wirte' is not a kind of vtk"),
                std::move(movie),
                std::move(label),
                std::move(update),
            }};
}

} // namespace kaya::lang
