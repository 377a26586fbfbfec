// model ...: the model as a whole.
#include "lang/modern/leaf.hpp"
#include "lang/modern/language.hpp"

#include <array>

namespace kaya::lang {

namespace {

CommandSpec model_new() {
    Leaf<New> leaf("model new", "new");
    leaf.no_effect("force", "without asking, which kaya never does");
    leaf.right("model new", "new").right("model new force", "new");
    leaf.wrong("model new now", "'now' is not a keyword of model new");
    return leaf;
}

template <class Command> CommandSpec file_line(Leaf<Command> leaf) {
    leaf.arguments_of_meaning();
    for (const char* word : {"compress", "nocompress", "readonly", "text", "inputdir"})
        leaf.no_effect(word, "accepted, without effect");
    return leaf;
}

CommandSpec model_save() {
    Leaf<Save> leaf("model save", "save");
    leaf.right("model save 'settled'", "save settled").right("model save 'settled' compress inputdir", "save settled");
    leaf.wrong("model save", "a word is missing after 'save'");
    leaf.wrong("model save 'a' comprss", "'comprss' is not a keyword of model save");
    return file_line(std::move(leaf));
}

CommandSpec model_restore() {
    Leaf<Restore> leaf("model restore", "restore");
    leaf.right("model restore 'settled'", "restore settled").right("mod res './settled'", "restore ./settled");
    leaf.wrong("model restore", "a word is missing after 'restore'");
    return file_line(std::move(leaf));
}

CommandSpec model_title() {
    Leaf<Title> leaf("model title");
    leaf.help("names the model");
    leaf.argument(text("title").help("the name"), &Title::text);
    leaf.right("model title 'A wall, second try'", "title A wall, second try");
    leaf.wrong("model title", "a word is missing after 'title'");
    return leaf;
}

CommandSpec model_configure() {
    Leaf<Config> leaf("model configure", "config");
    leaf.word("dynamic", "dynamic");
    for (const char* word : {"mechanical", "plugins", "energy", "highorder", "hotetra", "array", "cluster"})
        leaf.no_effect(word, "accepted, without effect");
    static constexpr std::array<std::pair<const char*, const char*>, 9> missing{
        {{"thermal", "heat"},
         {"fluid", "flow of water"},
         {"fluid-flow", "flow of water"},
         {"fluid-explicit", "flow of water"},
         {"fluid-implicit", "flow of water"},
         {"matrixflow", "flow of water"},
         {"feblock", "blocks of finite elements"},
         {"creep", "creep"},
         {"imass", "a licensed zone model"}}};
    for (const auto& [word, about] : missing) leaf.not_yet({word}, about);
    leaf.right("model configure dynamic", "config dynamic").right("model configure plugins");
    leaf.wrong("model configure dynmic", "'dynmic' is not a keyword of model configure");
    leaf.wrong("model configure thermal", "'model configure thermal' is known, but kaya does not support it yet");
    return leaf;
}

CommandSpec large_strain() {
    Leaf<Set> leaf("model large-strain");
    leaf.help("on: the geometry follows the motion, the default of kaya; off: it is not updated");
    leaf.argument(on_off(),
                  Through{[](Set& set, bool on) { set.small = !on; },
                          [](const Set& set) { return set.small ? std::optional(!*set.small) : std::nullopt; }});
    leaf.right("model large-strain on", "set small off").right("model large-strain off", "set small on");
    leaf.wrong("model large-strain", "a word is missing after 'large-strain'");
    leaf.wrong("model large-strain maybe", "expected on or off, found 'maybe'");
    return leaf;
}

/// Three components, or the magnitude of a gravity that acts downward.
CommandSpec model_gravity() {
    Leaf<Gravity> leaf("model gravity");
    leaf.means("gravity");
    leaf.help("acceleration of gravity: a vector, or its magnitude, which acts along -z");
    const ArgumentSpec value = real("g").unit("acceleration").spec;
    const ArgumentSpec three = vector("gx gy gz").unit("acceleration").spec;
    leaf.otherwise({three}, [=](Reader& reader, Gravity& gravity) {
        const auto& words = reader.statement().words;
        if (reader.peek() != &words[2]) return false;
        if (words.size() > 3) {
            gravity.value = reader.vector(three);
            return true;
        }
        if (!words[2].late()) {
            gravity.value = Vec3(0, 0, -reader.real(value));
            return true;
        }
        const Value given = reader.any(value);
        if (const auto* components = std::get_if<Vec3>(&given)) gravity.value = *components;
        else if (const auto* real = std::get_if<double>(&given)) gravity.value = Vec3(0, 0, -*real);
        else if (const auto* whole = std::get_if<std::int64_t>(&given))
            gravity.value = Vec3(0, 0, -static_cast<double>(*whole));
        else
            throw Diagnostic("gravity must be a number or a vector", "write for example: model gravity 0 0 -9.81")
                .at(words[2].place);
        return true;
    });
    leaf.prints(Parts<Gravity>().then(vector("gx gy gz"), &Gravity::value));
    leaf.finish([](const Reader& reader, Gravity&) {
        if (reader.statement().words.size() == 2)
            incomplete_line(reader, "a number is missing after 'gravity'", "write: model gravity 0 0 -9.81");
    });
    leaf.right("model gravity 0 0 -9.81", "gravity 0 0 -9.81").right("model gravity (0,0,-10)", "gravity 0 0 -10");
    leaf.right("model grav 9.81", "gravity 0 0 -9.81").right("model gravity @g");
    leaf.right("model gravity [g]");
    leaf.wrong("model gravity", "a number is missing after 'gravity'");
    leaf.wrong("model gravity 0 0", "a number is missing after '0'");
    leaf.wrong("model gravity down", "expected a number, found 'down'");
    leaf.wrong("model gravity 0 0 -9.81 1", "unexpected '1' after the end of the command");
    return leaf;
}

CommandSpec model_cycle() {
    Leaf<CycleCommand> leaf("model cycle|step", "cycle");
    leaf.arguments_of_meaning();
    leaf.finish([](const Reader& reader, CycleCommand& command) {
        if (!command.cycles)
            incomplete_line(reader, "model cycle has no number of cycles", "write for example: model cycle 1000");
    });
    leaf.word("calm", "calm");
    leaf.right("model cycle 10 calm 5", "cycle 10 calm 5")
        .right("model cycle 10", "cycle 10")
        .right("model step 10", "cycle 10")
        .right("model cyc @n", "cycle @n");
    leaf.wrong("model cycle", "model cycle has no number of cycles");
    leaf.wrong("model cycle 10.5", "cycle takes a whole number, not 10.5");
    leaf.wrong("model step many", "'many' is not a keyword of model cycle");
    return leaf;
}

CommandSpec model_random() {
    Leaf<Set> leaf("model random");
    leaf.means("set random");
    leaf.help("restarts the random numbers of FISH and Lua from this seed");
    leaf.argument(integer("n").at_least(0).optional().help("the seed; 10000 if not given"), &Set::seed);
    leaf.start([](const Statement&, Set& set) { set.seed = 10000; });
    leaf.right("model random 7", "set random 7").right("model random", "set random 10000");
    leaf.wrong("model random 1.5", "random takes a whole number, not 1.5");
    return leaf;
}

CommandSpec range_create() {
    Leaf<NameRange> leaf("model range create", "range name");
    leaf.arguments_of_meaning();
    // The elements follow the name without the word range.
    leaf.range(&NameRange::range, false, modern_ranges());
    leaf.finish([](const Reader& reader, NameRange& named) {
        if (named.range.elements.empty())
            incomplete_line(reader, "the named range has no element",
                            "write for example: model range create 'top' position-z 1 2");
    });
    leaf.right("model range create 'low' position-z -1 0.5 group 'wall'", "range name low z -1 0.5 group wall");
    leaf.wrong("model range create 'low'", "the named range has no element");
    leaf.wrong("model range create", "a word is missing after 'create'");
    return leaf;
}

CommandSpec model_dynamic() {
    Leaf<Set> leaf("model dynamic");
    leaf.means("set dynamic");
    leaf.help("switches dynamic motion: no damping unless `block mechanical damping` asks for it");
    leaf.keyword({"active"}, on_off(), &Set::dynamic, "on: dynamic; off: static, local damping of 0.8");
    leaf.otherwise({on_off().optional().spec}, [](Reader& reader, Set& set) {
        const std::string& word = reader.peek()->folded;
        if (set.dynamic || (word != "on" && word != "off")) return false;
        set.dynamic = reader.on_off(on_off().spec);
        return true;
    });
    leaf.finish([](const Reader& reader, Set& set) {
        if (!set.dynamic)
            incomplete_line(reader, "model dynamic does not say what to set", "write: model dynamic active on");
    });
    leaf.right("model dynamic active on", "set dyn on").right("model dynamic off", "set dyn off");
    leaf.wrong("model dynamic", "model dynamic does not say what to set");
    leaf.wrong("model dynamic actve on", "'actve' is not a keyword of model dynamic");
    return leaf;
}

CommandSpec dynamic_time() {
    Leaf<Reset> leaf("model dynamic|mechanical time-total");
    leaf.help("sets the time of the model back to 0");
    leaf.argument(real("t").at_least(0).at_most(0).unit("time"),
                  Through{[](Reset& reset, double) { reset.what = {Reset::What::time}; },
                          [](const Reset&) { return std::optional(0.0); }});
    leaf.right("model dynamic time-total 0", "reset time").right("model mechanical time-total 0.0", "reset time");
    leaf.wrong("model dynamic time-total", "a number is missing after 'time-total'");
    leaf.wrong("model dynamic time-total 5", "time-total must be at most 0, not 5");
    return leaf;
}

CommandSpec model_calm() {
    Leaf<Reset> leaf("model calm");
    leaf.help("sets all velocities to zero");
    leaf.start([](const Statement&, Reset& reset) { reset.what = {Reset::What::velocities}; });
    leaf.right("model calm", "reset vel");
    return leaf;
}

/// Motion is the only process.
CommandSpec mechanical_active() {
    Leaf<Ignored> leaf("model mechanical active");
    leaf.help("motion, the only process of kaya: on, without effect").support(Support::ignored);
    leaf.start([](const Statement&, Ignored& command) {
        command = {"model mechanical active", "kaya has no other process"};
    });
    leaf.argument(on_off(), Through{[](Ignored&, bool on) {
                                        if (!on)
                                            throw Diagnostic("motion cannot be switched off",
                                                             "kaya has no other process");
                                    },
                                    [](const Ignored&) { return std::optional(true); }});
    leaf.right("model mechanical active on");
    leaf.wrong("model mechanical active off", "motion cannot be switched off");
    return leaf;
}

CommandSpec time_step_fix() {
    Leaf<Set> leaf("model mechanical|dynamic timestep fix");
    leaf.means("set dt");
    leaf.help("the time step; one above the critical step is refused");
    leaf.argument(real("dt").unit("time").above(0), &Set::time_step);
    leaf.right("model mechanical timestep fix 1e-7", "set dt 1e-7");
    leaf.wrong("model mechanical timestep fix 0", "dt must be greater than 0, not 0");
    return leaf;
}

CommandSpec time_step_automatic() {
    Leaf<Set> leaf("model mechanical|dynamic timestep automatic");
    leaf.help("the time step is a fraction of the critical step again");
    leaf.start([](const Statement&, Set& set) { set.time_step = 0; });
    leaf.right("model mechanical timestep automatic", "set dt 0");
    return leaf;
}

CommandSpec time_step_safety() {
    Leaf<Fraction> leaf("model mechanical|dynamic timestep safety-factor", "fraction");
    leaf.arguments_of_meaning().help("the time step as a fraction of the critical step");
    leaf.right("model mechanical timestep safety-factor 0.5", "fraction 0.5");
    leaf.wrong("model mechanical timestep safety-factor 2", "safety-factor must be at most 1, not 2");
    return leaf;
}

CommandSpec compatibility() {
    Leaf<Set> leaf("model compatibility", "set");
    leaf.means("set compatibility");
    leaf.help("3dec: joints of rigid blocks stand on their corners, and the time step is that of 3DEC where it is "
              "shorter; none: the default");
    leaf.argument_of("compatibility");
    leaf.right("model compatibility 3dec", "set compatibility 3dec");
    leaf.wrong("model compatibility", "a word is missing after 'compatibility'");
    leaf.wrong("model compatibility 3dce", "there are no conventions of '3dce'");
    return leaf;
}

CommandSpec range_delete() {
    Leaf<NameRange> leaf("model range delete", "range delete");
    leaf.arguments_of_meaning();
    leaf.right("model range delete 'low'", "range delete low");
    leaf.wrong("model range delete", "a word is missing after 'delete'");
    return leaf;
}

} // namespace

std::vector<CommandSpec> model_commands() {
    constexpr const char* own = "kaya needs no such setting";
    return {
        model_new(),
        model_save(),
        model_restore(),
        model_title(),
        model_configure(),
        large_strain(),
        model_gravity(),
        model_cycle(),
        model_random(),
        range_create(),
        range_delete(),
        compatibility(),
        model_dynamic(),
        dynamic_time(),
        model_calm(),
        mechanical_active(),
        time_step_fix(),
        time_step_automatic(),
        time_step_safety(),
        list_line("model list information", List::What::information, "overview of the model", "model list information",
                  "list information"),
        list_line("model list range", List::What::ranges, "named ranges", "model list range", "list ranges"),
        list_line("model list", List::What::information, "overview of the model", "model list", "list information"),
        list_line("model dynamic|mechanical list", List::What::settings, "settings of the model", "model dynamic list",
                  "list settings"),
        ignored_line("model precision", "digits of printed numbers", own, "model precision 10"),
        ignored_line("model domain", "the space of the model", "the space of kaya has no limits",
                     "model domain extent -10 10 -10 10 -10 10"),
        ignored_line("model deterministic", "the same result for any number of threads", "kaya always does so",
                     "model deterministic on"),
        ignored_line("model energy", "the energy account", "kaya always keeps it", "model energy mechanical on"),
        ignored_line("model clean", "updates contacts and data", own, "model clean all"),
        ignored_line("model orientation-tracking", "orientations of blocks", "kaya always tracks them",
                     "model orientation-tracking on"),
        ignored_line("model update-interval", "cycles between two updates of the screen", own,
                     "model update-interval 50"),
        ignored_line("model display", "shows values while the model cycles", "the status line of kaya shows them",
                     "model display active on"),
    };
}

} // namespace kaya::lang
