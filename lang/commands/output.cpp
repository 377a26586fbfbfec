// Output of a model: lists, pictures, files for other programs.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/list_subjects.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

/// What may follow the name of a list.
enum class Follows {
    range,   ///< a range, with or without its word
    objects, ///< the number of an object, or a range
    number,  ///< a number
    parts    ///< mat or jmat, and a number
};

struct Listed {
    List::What what;
    std::vector<Spelling> words;
    const char* help;
    Follows follows = Follows::range;
};

const std::vector<Listed>& listed() {
    using enum List::What;
    static const std::vector<Listed> words = {
        {blocks, {"blocks"}, "blocks: place, mass, material, region", Follows::objects},
        {quality, {"quality"}, "poorly shaped blocks and their remedies; also `list blocks quality`"},
        {contacts, {"contacts"}, "contacts: blocks, normal, area", Follows::objects},
        {sub_contacts, {"subcontacts"}, "sub-contacts: displacements, forces, state", Follows::objects},
        {interfaces,
         {Spelling{"interfaces", 4}},
         "pairs of bodies: area, resultant force, where it acts, share of the friction that it uses"},
        {reactions,
         {Spelling{"reactions", 3}},
         "forces that hold supports, by group, and their balance with weights and loads"},
        {gridpoints, {"gridpoints", "gp"}, "gridpoints: place, velocity, displacement, force", Follows::objects},
        {zones, {"zones"}, "zones: stresses, volume", Follows::objects},
        {faces, {Spelling{"faces", 3}}, "faces: place, normal, area", Follows::objects},
        {properties,
         {"prop", "property"},
         "properties of materials; of blocks only after mat, of joints after jmat",
         Follows::parts},
        {histories,
         {"hist", "histories", "history"},
         "histories: number, name, least and greatest value",
         Follows::number},
        {extremes, {"max", "maximum"}, "greatest values of the model"},
        {time, {"time", "cycle", Spelling{"step", 3}}, "time and cycle"},
        {unbalanced, {Spelling{"unbalanced", 3}}, "largest unbalanced force, and its ratios to the forces that act"},
        {damping, {"damping"}, "kind of damping and its numbers"},
        {information, {Spelling{"information", 3}}, "overview: time, cycle, numbers of blocks, contacts, zones"},
        {time_step, {"timestep"}, "time step, its limit, and the mass that longer steps need"},
        {timing, {"timing"}, "seconds spent in each phase of the cycle"},
        {energy, {"energy"}, "energies and their balance"},
        {hash, {"hash"}, "hash of the state of the model"},
        {joint_models, {"jmodel", "jmodels"}, "joint models that are loaded, with their properties"},
        {boundary, {"boundary"}, "loads and held velocities"},
        {groups, {"groups"}, "names of groups and how many blocks, faces, zones and joints each has"},
        {excavated, {"excavated"}, "blocks that fill can put back"},
        {states, {"state"}, "joints by joint model and state: sub-contacts and their area"},
        {stresses, {"stress"}, "zones: principal, mean and greatest shear stress"},
        {stability, {Spelling{"stability", 4}}, "removable blocks: mode and factor of safety", Follows::objects},
        {structures,
         {"structures", "cables", Spelling{"struct", 3}},
         "cables, beams and liners: size, largest forces, slip; the nodes or elements of one after its number",
         Follows::number},
        {joint_sets, {"jset"}, "joint sets: mean orientation, faces, contacts"},
        {memory, {"memory"}, "memory of the tables of the model"},
        {version, {"version"}, "version of the program"},
        {modes, {"modes"}, "what works on rigid blocks and zones, in small and large strain, static and dynamic"},
        {settings, {"settings"}, "settings of the model"},
        {tables, {"tables"}, "tables: number of pairs and their limits"},
        {ranges, {Spelling{"ranges", 6}}, "named ranges"},
        {frequencies,
         {Spelling{"frequencies", 4}},
         "lowest frequencies of rigid blocks on their joints, 6 if no number follows; nothing moves",
         Follows::number},
        {symbols, {"fish"}, "variables and functions of FISH"},
    };
    return words;
}

std::vector<ArgumentSpec> arguments_after(Follows follows) {
    switch (follows) {
    case Follows::range: return {};
    case Follows::objects:
    case Follows::number: return {integer("n").at_least(1).optional().spec};
    case Follows::parts: return {text("mat|jmat").optional().spec, integer("n").at_least(1).optional().spec};
    }
    return {};
}

/// A range without the word `range`. Its first element, the word just taken, may have the name of a list: list block group stone.
bool read_element(Reader& reader, List& command) {
    const Word& word = reader.previous();
    const KeywordSpec* element = word.kind == WordKind::word ? find_keyword(range_elements(), word.folded) : nullptr;
    if (element == nullptr || element->support != Support::runs || reader.at_end()) return false;
    reader.spell(element->words.front().word);
    element->read(reader, &command.range);
    if (!reader.at_end()) read_range(reader, command.range);
    command.range.place = word.place;
    return true;
}

/// A word that is neither a list nor a range nor close to one; few words may follow.
void refuse_after(const Word& word, const Listed& item) {
    if (word.kind != WordKind::word || word.text == "?") return;
    std::vector<std::string_view> others{"range", "jmat"};
    for (const auto& element : range_elements())
        for (const auto& spelling : element.words) others.push_back(spelling.word);
    for (const auto& list : listed())
        for (const auto& spelling : list.words) others.push_back(spelling.word);
    const bool is_list = std::ranges::any_of(listed(), [&](const Listed& list) {
        return std::ranges::any_of(list.words, [&](const Spelling& s) { return s.matches(word.folded); });
    });
    constexpr std::size_t telling = 4; // fewer letters are near to anything
    if (is_list || (word.folded.size() >= telling && !did_you_mean(word.folded, others).empty())) return;
    const std::string_view name = item.words.front().word;
    std::string hint = fmt::format("nothing follows it but a range: list {} range ...", name);
    if (item.follows == Follows::number) hint = fmt::format("a number may follow: list {} 2", name);
    if (item.follows == Follows::objects)
        hint = fmt::format("a number or a range may follow: list {0} 2, list {0} range ...", name);
    if (item.follows == Follows::parts) hint = fmt::format("mat or jmat may follow, and a number: list {} mat 2", name);
    Diagnostic d(fmt::format("'{}' does not follow 'list {}'", word.text, name), std::move(hint));
    d.code = "unknown-word";
    throw d.at(word.place);
}

RangeElement element_of_number(std::int64_t number) {
    RangeElement element;
    element.kind = RangeElement::Kind::id;
    element.low = element.high = static_cast<double>(number);
    return element;
}

/// Reads what follows the name of a list.
bool read_after(Reader& reader, List& command) {
    const Word& word = *reader.peek();
    if (word.kind == WordKind::word && find_keyword(range_elements(), word.folded)) {
        const bool materials =
            command.what == List::What::properties && command.part == List::Part::all && !command.number;
        if (materials && (word.folded == "mat" || word.folded == "jmat")) {
            command.part = word.folded == "mat" ? List::Part::blocks : List::Part::joints;
            reader.take();
        } else {
            read_range(reader, command.range);
        }
        return true;
    }
    const auto item = std::ranges::find(listed(), command.what, &Listed::what);
    const bool number = word.kind == WordKind::number || word.late();
    if (!number) refuse_after(word, *item);
    if (!number || item->follows == Follows::range || command.number || command.range.place) return false;
    command.number = reader.integer(integer("n").at_least(1).spec);
    if (item->follows != Follows::objects) return true;
    RangeElement element = element_of_number(*command.number);
    element.place = command.range.place = reader.previous().place;
    command.range.elements.push_back(std::move(element));
    return true;
}

/// `show velocity`: one of the subjects of the list.
void read_subject(Reader& reader, List& command) {
    const Word show = reader.previous();
    const auto subjects = list_subjects(command.what.value_or(List::What::symbols));
    if (subjects.empty())
        throw Diagnostic("show follows blocks, contacts, subcontacts, gridpoints, zones or faces",
                         "write for example: list blocks show velocity")
            .at(show.place);
    std::vector<std::string_view> words;
    for (const ListSubject& subject : subjects) words.push_back(subject.word);
    if (reader.at_end()) reader.missing(text("subject").spec);
    const Word& word = *reader.peek();
    const auto found =
        std::ranges::find_if(words, [&](std::string_view w) { return Spelling(w, 3).matches(word.folded); });
    if (found == words.end()) reader.unknown("a subject of this list", words);
    reader.take();
    reader.spell(*found);
    command.subjects.emplace_back(*found);
}

Parts<List>::Forms next_subject(Parts<List>::Form form, const List& wanted) {
    auto& subjects = form.after.subjects;
    if (subjects.size() >= wanted.subjects.size()) return {};
    subjects.push_back(wanted.subjects[subjects.size()]);
    form.words.push_back({subjects.back()});
    return {std::move(form)};
}

/// What follows the name of a list, or @name in place of it.
Parts<List>::Forms next_value(Parts<List>::Form form, const List& wanted) {
    List& now = form.after;
    if (!now.what && now.symbols.size() < wanted.symbols.size()) {
        now.symbols.push_back(wanted.symbols[now.symbols.size()]);
        form.words.push_back({"@" + now.symbols.back()});
    } else if (now.part != wanted.part && now.what) {
        now.part = wanted.part;
        form.words.push_back({now.part == List::Part::blocks ? "mat" : "jmat"});
    } else if (wanted.number && !now.number && now.what) {
        now.number = wanted.number;
        print_value(form.words, *now.number);
        if (std::ranges::find(listed(), *now.what, &Listed::what)->follows == Follows::objects)
            now.range.elements.push_back(element_of_number(*now.number));
    } else {
        return {};
    }
    return {std::move(form)};
}

CommandSpec list() {
    Entry<List> entry({"list", "print"});
    entry.help("shows parts of the model, or the value of a variable");
    for (const auto& item : listed()) {
        const auto write = [what = item.what](Parts<List>::Form form, const List& wanted) {
            if (wanted.what != what || form.after.what) return Parts<List>::Forms{};
            form.after.what = what;
            return Parts<List>::Forms{std::move(form)};
        };
        Parts<List> parts;
        for (const ArgumentSpec& argument : arguments_after(item.follows)) parts.argument(argument);
        parts.by(
            [what = item.what](Reader& reader, List& command) {
                if (what == List::What::quality && command.what == List::What::blocks) command.what.reset();
                if (command.what && read_element(reader, command)) return;
                if (command.what || !command.symbols.empty())
                    throw Diagnostic("one list command shows one thing", "write a second list command")
                        .at(reader.previous().place);
                command.what = what;
            },
            write);
        entry.keyword(item.words, parts, item.help);
    }
    entry.keyword(
        {"show"}, Parts<List>().argument(text("subject").spec).by(read_subject, next_subject),
        "what the columns of blocks, contacts, subcontacts, gridpoints, zones or faces are about: velocity, ...");
    entry.otherwise({text("@name").optional().spec}, [](Reader& reader, List& command) {
        if (command.what) return read_after(reader, command);
        if (reader.peek()->kind != WordKind::symbol) return false;
        command.symbols.push_back(reader.symbol(text("@name").spec));
        return true;
    });
    entry.prints(Parts<List>().by({}, next_value), true);
    entry.range(&List::range, true); // print x is more likely meant as print @x; after a list its word may be left out
    entry.finish([](const Reader& reader, List& command) {
        if (!command.what && command.symbols.empty())
            incomplete_line(reader, "list has no subject", "write for example: list blocks");
    });
    entry.right("list blocks")
        .right("print @x")
        .right("print @a @b")
        .right("pri max")
        .right("list contacts range z 0 1")
        .right("list blocks quality")
        .right("list block 3")
        .right("list block z 0 1 group wall")
        .right("print prop jmat")
        .right("print hist 2")
        .right("list frequencies 10")
        .right("print cycle");
    entry.right("list blocks show velocity show moment range z 0 1").right("list gp show displacement");
    entry.wrong("list blocks show velocty", "'velocty' is not a subject of this list");
    entry.wrong("list time show velocity", "show follows blocks, contacts, subcontacts, gridpoints, zones or faces");
    entry.wrong("list blocks show", "a word is missing after 'show'");
    entry.wrong("list", "list has no subject");
    entry.wrong("print blokcs", "'blokcs' is not a keyword of list");
    entry.wrong("list blocks zones", "one list command shows one thing");
    entry.wrong("list time 5", "expected a keyword of list, found '5'");
    entry.wrong("list blocks 1.5", "blocks takes a whole number, not 1.5");
    entry.wrong("list blocks z", "a number is missing after 'z'");
    entry.wrong("print x", "'x' is not a keyword of list: a FISH variable is @x");
    entry.wrong("print hist one", "'one' does not follow 'list hist'");
    entry.wrong("list time zonse", "'zonse' is not a keyword of list");
    entry.wrong("list 5", "expected a keyword of list, found '5'");
    return entry;
}

CommandSpec find() {
    return Entry<List>({"find"})
        .help("lists the blocks of a range")
        .start([](const Statement&, List& command) { command.what = List::What::blocks; })
        .range(&List::range)
        .right("find range sphere center 0 0 0 radius 1")
        .right("find region 2")
        .wrong("find reigon 2", "'reigon' is not a keyword of find");
}

CommandSpec ignored(const char* word, const char* help, const char* instead) {
    Entry<Ignored> entry({word});
    entry.help(help);
    entry.raw(&Ignored::word).whole_line([](const Ignored& command) { return command.word; });
    entry.support(Support::ignored);
    entry.start([word, instead](const Statement&, Ignored& command) { command = {word, instead}; });
    return entry;
}

/// The words of a line from the second on, as typed; the range phrase, from `range` on, is left in `range`.
std::vector<Plot::Item> plot_words(const Statement& statement, std::string* range) {
    std::vector<Plot::Item> words;
    for (std::size_t i = 1; i < statement.words.size(); ++i) {
        const Word& word = statement.words[i];
        if (range != nullptr && word.kind == WordKind::word && word.folded == "range") {
            *range = statement.raw(i);
            break;
        }
        words.push_back(
            {word.text, word.folded, word.kind == WordKind::text || word.kind == WordKind::open, word.late()});
    }
    return words;
}

/// The words as a line holds them.
std::string line_of_words(const char* name, const std::vector<Plot::Item>& words, const std::string& range) {
    std::string line = name;
    for (const Plot::Item& word : words) {
        const bool plain = word.text.find_first_of(" ()[]") == std::string::npos;
        if (word.script) line += plain ? " @" + word.text : " [" + word.text + "]";
        else line += " " + (word.quoted ? joined({{word.text, true}}, true) : word.text);
    }
    return range.empty() ? line : line + " " + range;
}

CommandSpec movie() {
    Entry<Movie> entry({"movie"});
    entry.help("makes a picture of the current plot every so many cycles, the frames of a film");
    entry.raw().start([](const Statement& statement, Movie& command) {
        command.place = statement.words.front().place;
        command.words = plot_words(statement, nullptr);
    });
    entry.whole_line([](const Movie& movie) { return line_of_words("movie", movie.words, {}); });
    entry.right("movie on file a.avi").right("movie on interval 200 file slide").right("movie off");
    return entry;
}

CommandSpec plot() {
    Entry<Plot> entry({"plot"});
    entry.help("makes pictures of the model, of histories and of tables");
    entry.raw().start([](const Statement& statement, Plot& command) {
        command.place = statement.words.front().place;
        command.words = plot_words(statement, &command.range);
    });
    entry.whole_line([](const Plot& plot) { return line_of_words("plot", plot.words, plot.range); });
    entry.right("pl block").right("plot hist 1 vs 2 &\n  hold").right("plot set dip 10 dd 'open");
    entry.right("plot block disp cut origin 0 0 0 normal 1 0 0 file cut.png").right("plot joint slip size 1600 1200");
    entry.right("plot principal cut dip 90 dd 0").right("plot iso sig1 -1e6 -2e6 block").right("plot stereonet");
    entry.right("plot block disp interval 200 file slide");
    entry.right("plot create view wall").right("plot add block group").right("plot export wall.png");
    return entry;
}

} // namespace

Family output() {
    CommandSpec update =
        ignored("update", "accepted and ignored: contacts are updated by the cycle", "the cycle looks after itself");
    update.right = {{"update", {}}};
    CommandSpec label =
        ignored("label", "read to its end, without effect", "pictures are made from the files of 'vtk write'");
    label.right = {{"label arrow 1 2 3", {}}};
    return {"output",
            "lists, pictures, files for other programs",
            {
                list(),
                find(),
                plot(),
                Entry<VtkWrite>({"vtk"}, {"write"})
                    .help("writes the present model for ParaView; files of one name form a series")
                    .argument(text("file").help("name without suffix"), &VtkWrite::file)
                    .right("vtk write shear")
                    .wrong("vtk", "a word is missing after 'vtk'")
                    .wrong("vtk write", "a word is missing after 'write'")
                    .wrong("vtk wirte a", "'wirte' is not a kind of vtk"),
                movie(),
                std::move(label),
                std::move(update),
            }};
}

} // namespace kaya::lang
