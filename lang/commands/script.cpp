// Scripts inside a deck: FISH and Lua.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace kaya::lang {

namespace {

/// Locations in a cycle, as later versions number them: those below the second one are before the forces.
constexpr double at_start = 1, forces_are_known = 40;

CommandSpec define(std::vector<Spelling> words, std::vector<Spelling> form) {
    Entry<FishDefinition> entry(std::move(words), std::move(form));
    entry.help("defines a FISH function; its lines go up to a line with the word end");
    entry.body("end", &FishDefinition::text, &FishDefinition::place, false);
    entry.whole_line([](const FishDefinition& definition) { return definition.text; });
    entry.argument(text("name").help("name of the function"), [](FishDefinition&, const std::string&) {});
    // Arguments of the function: the FISH compiler reads them from the text.
    entry.otherwise({text("argument").optional().spec}, [](Reader& reader, FishDefinition&) {
        reader.take();
        return true;
    });
    return entry;
}

/// Events at which a function may run; the others of 3DEC are known by name.
FishCallback::When read_event(Reader& reader, const ArgumentSpec& name) {
    using enum FishCallback::When;
    static constexpr std::array run{std::pair{"solve_start", solve_start}, std::pair{"solve_complete", solve_complete}};
    static constexpr std::array known{
        "block_create",   "block_delete",   "subcontact_create", "subcontact_delete", "subcontact_state_change",
        "contact_create", "contact_delete", "slip_change",       "solve_ending",      "fos_start",
        "fos_complete",   "zone_stress",    "zone_eom",          "zone_update",       "struct_eom"};
    std::string event = fold(reader.text(name));
    std::ranges::replace(event, '-', '_');
    for (const auto& [word, when] : run)
        if (event == word) return when;
    const Place place = reader.previous().place;
    if (std::ranges::find(known, event) != known.end())
        not_supported_yet("event " + event, "other events than solve_start and solve_complete", place);
    std::vector<std::string_view> words(known.begin(), known.end());
    for (const auto& [word, when] : run) words.push_back(word);
    const auto near = did_you_mean(event, words);
    Diagnostic d(fmt::format("there is no event '{}'", event),
                 near.empty() ? "solve_start or solve_complete" : fmt::format("did you mean '{}'?", near));
    d.code = "unknown-word";
    throw d.at(place);
}

CommandSpec callback() {
    using When = FishCallback::When;
    const Through location{[](FishCallback& callback, double at) {
                               callback.when = at < forces_are_known ? When::before_cycle : When::after_forces;
                               callback.location = at;
                           },
                           [](const FishCallback& callback) { return callback.location; }};
    const auto function = Parts<FishCallback>()
                              .then(text("name").help("name of a function without arguments"), &FishCallback::function)
                              .mark(&FishCallback::place)
                              .maybe(real("location").optional(), location);
    Entry<FishCallback> entry({"fish"}, {"callback"});
    entry.help("runs a FISH function in every cycle, in every n-th, or at an event");
    entry.keyword(
        {"add"}, function,
        "the function; below 40 it runs before the cycle, else (40 if not given) when the forces of the cycle are known; "
        "smaller locations run first, and at one location in the order in which they were added");
    entry.keyword({"remove"}, Parts<FishCallback>().set(&FishCallback::remove, true).then(function),
                  "stops running the function, at that location or event only if one is given");
    const auto name = text("name");
    entry.keyword({"event"},
                  Parts<FishCallback>().argument(name.spec).by(
                      [name](Reader& reader, FishCallback& callback) { callback.when = read_event(reader, name.spec); },
                      [](Parts<FishCallback>::Form form, const FishCallback& wanted) {
                          if (wanted.when < When::solve_start) return Parts<FishCallback>::Forms{};
                          form.words.push_back({*wanted.when == When::solve_start ? "solve_start" : "solve_complete"});
                          form.after.when = wanted.when;
                          return Parts<FishCallback>::Forms{std::move(form)};
                      }),
                  "in place of a location: solve_start or solve_complete, before and after each `solve`");
    entry.keyword({"interval"}, integer("n").at_least(1), &FishCallback::interval, "in every n-th cycle only");
    entry.action(
        {"process"}, [](FishCallback&) {}, "accepted, with `mechanical` or `dynamic`");
    entry.action(
        {"mechanical"}, [](FishCallback&) {}, "the only process");
    entry.action(
        {"dynamic"}, [](FishCallback&) {}, "the only process");
    entry.finish([](const Reader& reader, FishCallback& callback) {
        if (!callback.remove && !callback.when) {
            callback.when = When::after_forces;
            callback.location = forces_are_known;
        }
        if (callback.function.empty())
            incomplete_line(reader, "fish callback does not say what to do", "write: fish callback add NAME");
        if (callback.when >= FishCallback::When::solve_start && callback.interval > 1)
            incomplete_line(reader, "an event has no interval", "remove 'interval'");
    });
    entry.right("fish callback add watch 1 interval 50").right("fish callback add watch event solve_complete");
    entry.right("fish callback remove watch");
    entry.wrong("fish callback add watch event solve_strat", "there is no event 'solve_strat'");
    entry.wrong("fish callback add watch event block_create",
                "'event block_create' is known, but kaya does not support it yet");
    entry.wrong("fish callback add watch event solve_start interval 2", "an event has no interval");
    entry.wrong("fish callback", "fish callback does not say what to do");
    entry.wrong("fish callback add watch interval 0", "interval must be at least 1, not 0");
    return entry;
}

/// set fishcall n NAME: the older form of the same command.
CommandSpec fishcall() {
    const auto name = text("name").spec;
    Entry<FishCallback> entry({"set"}, {Spelling{"fishcall", 5}});
    entry.help("runs a FISH function in every cycle");
    entry.place(&FishCallback::place);
    entry.argument(
        integer("n").help("0: before the cycle; 1: when its forces are known; 2: after it"),
        Through{[](FishCallback& callback, std::int64_t n) {
                    using enum FishCallback::When;
                    static constexpr std::array<std::pair<FishCallback::When, std::optional<double>>, 3> places{
                        {{before_cycle, at_start}, {after_forces, forces_are_known}, {after_cycle, {}}}};
                    if (n < 0 || n >= static_cast<std::int64_t>(places.size()))
                        throw Diagnostic(fmt::format("there is no place {} in a cycle", n),
                                         "0: before the cycle, 1: when its forces are known, 2: after it");
                    std::tie(callback.when, callback.location) = places[static_cast<std::size_t>(n)];
                },
                [](const FishCallback& callback) -> std::optional<std::int64_t> {
                    if (!callback.when) return 0;
                    const auto place = static_cast<std::int64_t>(*callback.when);
                    return place <= 2 ? std::optional(place) : std::nullopt;
                }});
    entry.keyword({Spelling{"remove", 6}},
                  Parts<FishCallback>().set(&FishCallback::remove, true).then(text("name"), &FishCallback::function),
                  "stops running the function");
    entry.otherwise({name}, [name](Reader& reader, FishCallback& callback) {
        if (!callback.function.empty()) return false;
        const Word& word = *reader.peek();
        callback.place = word.place;
        // @name would run the function here; the name itself is needed.
        callback.function = word.kind == WordKind::symbol ? reader.symbol(name) : reader.text(name);
        return true;
    });
    entry.prints(Parts<FishCallback>().then(text("name"), &FishCallback::function));
    entry.finish([](const Reader& reader, FishCallback& callback) {
        if (callback.function.empty())
            incomplete_line(reader, "set fishcall needs the name of a function", "write: set fishcall 2 NAME");
        if (!callback.remove) return;
        callback.when.reset(); // it is removed wherever it runs
        callback.location.reset();
    });
    entry.right("set fishcall 2 watch").right("set fishcall 0 remove watch");
    entry.wrong("set fishcall", "a number is missing after 'fishcall'");
    entry.wrong("set fishcall 2", "set fishcall needs the name of a function");
    entry.wrong("set fishcall 7 watch", "there is no place 7 in a cycle");
    return entry;
}

CommandSpec automatic_create() {
    Entry<FishSetting> entry({"fish"}, {"automatic-create"});
    entry.help("off: a variable of FISH must be declared by global or local before it is used");
    entry.argument(on_off(), &FishSetting::automatic_create);
    entry.place(&FishSetting::place);
    entry.right("fish automatic-create off").right("fish automatic-create on");
    entry.wrong("fish automatic-create", "a word is missing after 'automatic-create'");
    entry.wrong("fish automatic-create maybe", "expected on or off, found 'maybe'");
    return entry;
}

CommandSpec fish_structure() {
    Entry<FishSetting> entry({"fish"}, {"structure"});
    entry.help("names the members of a kind of structure, which `struct NAME` makes in FISH");
    entry.place(&FishSetting::place);
    entry.argument(text("name").help("name of the structure"), &FishSetting::structure);
    const auto member = Parts<std::string>().then(
        text("member").optional(), Through{[](std::string& to, const std::string& name) { to = fold(name); },
                                           [](const std::string& name) { return std::optional(name); }});
    entry.values(Parts<FishSetting>().in(next_of(&FishSetting::members), member),
                 [](Reader&, FishSetting&) { return true; });
    entry.right("fish structure bolt(length, angle)").right("fish structure empty");
    entry.wrong("fish structure", "a word is missing after 'structure'");
    return entry;
}

CommandSpec fish_set() {
    Entry<Set> entry({"fish"}, {"set"});
    entry.help("gives variables of FISH a value");
    entry.values(Parts<Set>().in(next_of(&Set::fish), fish_variable(false)), [](Reader&, Set&) { return true; },
                 {text("@name").spec, real("value").spec});
    entry.finish([](const Reader& reader, Set& set) {
        if (set.fish.empty()) incomplete_line(reader, "fish set has no variable", "write: fish set @load 5e6");
    });
    entry.right("fish set @load 5e6").right("fish set width = 2 height = 3");
    entry.wrong("fish set", "fish set has no variable").wrong("fish set @load", "a number is missing after '@load'");
    return entry;
}

CommandSpec fish_list() {
    const auto name = text("name").optional().spec;
    Entry<List> entry({"fish"}, {"list"});
    entry.help("shows the value of a variable or an expression of FISH, or all names");
    const auto accepted = [](List&) {};
    entry.action({"basic"}, accepted, "accepted, without effect");
    entry.action({"symbols"}, accepted, "accepted, without effect");
    entry.action({"contents"}, accepted, "accepted, without effect");
    entry.otherwise({name}, [name](Reader& reader, List& command) {
        const WordKind kind = reader.peek()->kind;
        command.symbols.push_back(kind == WordKind::expression ? "[" + reader.take().text + "]"
                                                               : name_at(reader, name));
        return true;
    });
    entry.prints(Parts<List>().in(next_of(&List::symbols), Parts<std::string>().by({}, [](Parts<std::string>::Form form,
                                                                                          const std::string& symbol) {
        form.words.push_back({symbol, !symbol.starts_with('[')});
        form.after = symbol;
        return Parts<std::string>::Forms{std::move(form)};
    })));
    entry.finish([](const Reader&, List& command) {
        if (command.symbols.empty()) command.what = List::What::symbols;
    });
    entry.right("fish list").right("fish list @load").right("fish list [load * 2]").right("fish list contents load");
    return entry;
}

/// @f(1), or expressions in brackets.
void read_call(const Statement& statement, FishCall& call) {
    const Word& first = statement.words.front();
    call.place = first.place;
    if (first.kind == WordKind::symbol) {
        const std::string text = statement.raw(0);
        call.expression = text.substr(text.find('@') + 1);
        return;
    }
    // The lines of a bracket over several lines have no brackets.
    const auto expression_of = [&](const Word& word) {
        return statement.body.empty() ? word.text : fmt::format("[{}]", word.text);
    };
    call.expression = expression_of(first);
    for (std::size_t i = 1; i < statement.words.size(); ++i) {
        const Word& word = statement.words[i];
        if (word.kind != WordKind::expression)
            throw Diagnostic(fmt::format("unexpected {} after the bracket", word.shown()),
                             "a bracket is a line by itself, or a value in a command")
                .at(word.place);
        call.further.emplace_back(expression_of(word), word.place);
    }
}

CommandSpec parameter() {
    Entry<Parameter> entry({Spelling{"parameter", 5}});
    entry.help("sets a FISH variable, or a property of the deck, unless `kaya --set` or an earlier line has set it");
    entry.place(&Parameter::place);
    const auto value = real("value").help("a number, a word or a text").spec;
    entry.otherwise({text("name").spec, value}, [value](Reader& reader, Parameter& parameter) {
        if (!parameter.name.empty()) return false;
        const auto name = text("name").spec;
        parameter.name = reader.peek()->kind == WordKind::symbol ? reader.symbol(name) : reader.text(name);
        parameter.value = reader.any(value);
        return true;
    });
    entry.prints(Parts<Parameter>().by({}, [](Parts<Parameter>::Form form, const Parameter& wanted) {
        form.words.push_back({wanted.name, true});
        form.after = wanted;
        const bool said = form.after.name.empty() || print_any(form.words, wanted.value);
        return said ? Parts<Parameter>::Forms{form} : Parts<Parameter>::Forms{};
    }));
    entry.finish([](const Reader& reader, Parameter& parameter) {
        if (parameter.name.empty())
            incomplete_line(reader, "param needs a name and a value", "write: param friction = 30");
    });
    entry.right("param friction = 30").right("param @name = 'left wall'").right("param 'prop 1 jfric' = 30");
    entry.wrong("param", "param needs a name and a value");
    entry.wrong("param friction", "a number is missing after 'friction'");
    return entry;
}

} // namespace

std::string name_at(Reader& reader, const ArgumentSpec& name) {
    const bool symbol = reader.peek() && reader.peek()->kind == WordKind::symbol;
    return symbol ? reader.symbol(name) : reader.text(name);
}

Family script() {
    CommandSpec plain = define({Spelling{"define", 3}}, {});
    plain.right = {{"def half\n  half = 0.5\nend", {}}, {"define twice(a)\n  twice = 2*a\nend", {}}};
    plain.wrong = {{"def half\n  half = 0.5", "define 'half' is never ended"},
                   {"def\nend", "a word is missing after 'def'"}};
    CommandSpec modern = define({"fish"}, {"define"});
    modern.right = {{"fish define half\n  half = 0.5\nend", {}}};
    modern.wrong = {{"fish define half\n  half = 0.5", "fish define 'half' is never ended"}};
    CommandSpec parallel = define({"fish"}, {"operator"});
    parallel.right = {{"fish operator half(a)\n  half = 0.5*a\nend", {}}};
    parallel.wrong = {{"fish operator half(a)\n  half = a", "fish operator 'a' is never ended"}};
    return {"script",
            "FISH and Lua",
            {
                std::move(plain),
                std::move(modern),
                std::move(parallel),
                callback(),
                automatic_create(),
                fish_structure(),
                fish_set(),
                fish_list(),
                fishcall(),
                parameter(),
                Entry<FishCall>({"@"})
                    .help("runs a function or shows a value: @name or @name(arguments) alone on a line")
                    .raw()
                    .start(read_call)
                    .whole_line([](const FishCall& call) {
                        std::string line = "[" + call.expression + "]";
                        for (const auto& [expression, place] : call.further) line += " [" + expression + "]";
                        return line;
                    })
                    .right("@build_wall")
                    .right("@place(1, 2)")
                    .right("[stiffness * 2]"),
                Entry<LuaChunk>({"lua"})
                    .help("lines of Lua up to a line with the word endlua")
                    .body("endlua", &LuaChunk::text, &LuaChunk::place, true)
                    .whole_line([](const LuaChunk& chunk) { return "lua\n" + chunk.text + "endlua"; })
                    .right("lua\n  x = 1\nendlua")
                    .wrong("lua\n  x = 1", "lua is never ended"),
                Entry<LuaFile>({"lua"})
                    .help("runs a file of Lua")
                    .argument(text("file").help("name of the file"), &LuaFile::file)
                    .place(&LuaFile::place)
                    .right("lua average.lua")
                    .wrong("lua a.lua b.lua", "unexpected 'b.lua' after the end of the command"),
            }};
}

} // namespace kaya::lang
