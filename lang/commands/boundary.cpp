// Loads, velocities and initial values.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/directions.hpp"
#include "lang/commands/language.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

/// Translation, then rotation.
const std::vector<Spelling> velocity_words[6] = {
    {"xvel", "xvelocity"},
    {"yvel", "yvelocity"},
    {"zvel", "zvelocity"},
    {"rxvel", "rxvelocity", Spelling{"xrvel", 3}}, // xr is a range
    {"ryvel", "ryvelocity", Spelling{"yrvel", 3}},
    {"rzvel", "rzvelocity", Spelling{"zrvel", 3}},
};

Argument<double> velocity_argument(std::size_t component) {
    return component < 3 ? real("v").unit("velocity") : real("v").unit("angle in radians/time");
}

/// Kinds of `hist`: each reads the rest of the line as a factor that varies with time.
std::vector<KeywordSpec> multiplier_kinds() {
    Keywords<Multiplier> kinds;
    const auto wave = [&](const char* word, Wave::Form form, std::string_view help) {
        kinds.keyword({word},
                      Parts<Multiplier>().in(as<Wave>(&Multiplier::function),
                                             Parts<Wave>()
                                                 .set(&Wave::form, form)
                                                 .then(real("f").unit("1/time").above(0), &Wave::frequency)
                                                 .maybe(real("t").unit("time").above(0).optional(), &Wave::duration)),
                      help);
    };
    using enum Wave::Form;
    wave("sine", sine, "sin(2 pi f time), for the time t or without end");
    wave("cosine", cosine, "cos(2 pi f time), for the time t or without end");
    wave("impulse", impulse, "(1 - cos(2 pi f time))/2, for the time t or without end");
    kinds.keyword({"table"},
                  Parts<Multiplier>().in(as<TableValue>(&Multiplier::function),
                                         Parts<TableValue>().then(integer("n").at_least(0), &TableValue::table)),
                  "value of table n over time");
    return std::move(kinds).list();
}

/// A kind with its numbers, or @name.
Parts<Multiplier> multiplier_parts() {
    const auto kind = Parts<Multiplier>().one_of(
        multiplier_kinds(), {.name = "sine, cosine, impulse, table or @name", .kind = ArgumentKind::text},
        "a kind of history", {"sine", "cosine", "impulse", "table", "@name"});
    const auto read = [kind](Reader& reader, Multiplier& multiplier) {
        const Word* word = reader.peek();
        multiplier.place = word ? word->place : Place{};
        if (word && word->kind == WordKind::symbol)
            multiplier.function = ScriptValue{reader.symbol(text("@name").spec)};
        else kind.read(reader, multiplier);
    };
    const auto write = [kind](Parts<Multiplier>::Form form, const Multiplier& wanted) {
        const auto* script = std::get_if<ScriptValue>(&wanted.function);
        if (script == nullptr) return kind.forms(std::move(form), wanted);
        form.words.push_back({"@" + script->symbol});
        form.after = wanted;
        return Parts<Multiplier>::Forms{std::move(form)};
    };
    return Parts<Multiplier>().described(kind.keywords()).by(read, write);
}

template <class Command> void add_multiplier(Entry<Command>& entry) {
    entry.keyword({"hist", "history"}, Parts<Command>().in(made(&Command::multiplier), multiplier_parts()),
                  "all velocities, loads and stresses of the line are multiplied by a function of time, or by "
                  "@name: the value of a FISH function or variable in each cycle");
    entry.once(&Command::multiplier, "hist is given twice, and one function multiplies all values of a line",
               "write a line for each function");
}

/// The words xvel to rzvel.
template <class Command> void add_velocities(Entry<Command>& entry, std::string_view help, std::string_view spin) {
    for (std::size_t i = 0; i < 6; ++i)
        entry.keyword(
            velocity_words[i], velocity_argument(i), [i](Command & c) -> auto& { return c.velocity[i]; },
            i < 3 ? help : spin);
}

/// A value along a direction; several values are added.
template <class Command> void add_directed(Entry<Command>& entry, std::vector<Spelling> words,
                                           const Argument<double>& value, std::vector<Directed> Command::*list,
                                           std::string_view help) {
    const auto parts = Parts<Directed>()
                           .then(value, &Directed::value)
                           .in(member(&Directed::direction), direction(vector("dx dy dz").spec));
    entry.keyword(std::move(words), Parts<Command>().in(next_of(list), parts), help);
}

template <class Values> bool any(const Values& values) {
    for (const auto& value : values)
        if (value) return true;
    return false;
}

CommandSpec bound() {
    Entry<Boundary> entry({"boundary"});
    entry.help(
        "prescribes velocities and loads of gridpoints, vertices and rigid blocks at the boundary of the visible blocks");
    entry.place(&Boundary::place);
    static constexpr const char* load[] = {"xload", "yload", "zload"};
    static constexpr const char* free[] = {"xfree", "yfree", "zfree", "rxfree", "ryfree", "rzfree"};
    add_velocities(entry, "prescribed velocity", "prescribed rotation of rigid blocks");
    for (std::size_t i = 0; i < 3; ++i)
        entry.keyword(
            {load[i]}, real("f").unit("force"), [i](Boundary & b) -> auto& { return b.load[i]; },
            "force added at every vertex");
    for (std::size_t i = 0; i < 6; ++i)
        entry.action(
            {free[i]}, [i](Boundary& b) { b.free[i] = true; }, "not prescribed in this direction any more");
    entry.keyword({"stress"}, tensor("sxx syy szz sxy sxz syz").unit("stress"), &Boundary::stress,
                  "stress on the boundary faces, compression negative");
    entry.keyword({"xgradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"), &Boundary::x_gradient,
                  "change of the stress with x");
    entry.keyword({"ygradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"), &Boundary::y_gradient,
                  "change of the stress with y");
    entry.keyword({"zgradient"}, tensor("sxx syy szz sxy sxz syz").unit("stress/length"), &Boundary::z_gradient,
                  "change of the stress with z");
    add_local_axes(entry);
    add_multiplier(entry);
    static constexpr const char* quiet[][2] = {
        {"xviscous", "viscous (absorbing) boundary in x"},
        {"yviscous", "viscous (absorbing) boundary in y"},
        {"zviscous", "viscous (absorbing) boundary in z"},
        {"nviscous", "quiet boundary: by the velocity along the normal of a face"},
        {"sviscous", "quiet boundary: by the velocity in the plane of a face"}};
    for (std::size_t i = 0; i < 5; ++i)
        entry.action(
            {Spelling{quiet[i][0], 3}}, [i](Boundary& b) { b.quiet[i] = true; }, quiet[i][1]);
    static constexpr const char* reaction[] = {"xreaction", "yreaction", "zreaction"};
    for (std::size_t i = 0; i < 3; ++i)
        entry.action(
            {Spelling{reaction[i], 3}}, [i](Boundary& b) { b.reaction[i] = true; },
            "replaces the prescribed velocity in this direction by its reaction force");
    entry.keyword({"nvel", "nvelocity"}, real("v").unit("velocity"), &Boundary::normal_velocity,
                  "prescribed velocity along the outward normals of faces; motion in their planes is free");
    add_directed(entry, {"dvel", "dvelocity"}, real("v").unit("velocity"), &Boundary::directed_velocity,
                 "prescribed velocity along a direction; motion normal to it is free");
    add_directed(entry, {"dload"}, real("f").unit("force"), &Boundary::directed_load,
                 "force along a direction, added at every vertex");
    entry.not_yet({"ff", "freefield"}, "free fields at the sides of a model");
    entry.not_yet({"pp"}, "pore pressure at a boundary: see initialize pp and water");
    entry.not_yet({"point", "nload", "sload"}, "loads on faces");
    entry.not_yet({"temperature", "flux"}, "heat and flow");
    entry.range(&Boundary::range);
    entry.finish([](const Reader& reader, Boundary& b) {
        const bool prescribed = b.stress || any(b.velocity) || any(b.load) || !b.directed_load.empty();
        const std::array<double, 6> none{};
        const bool gradient = b.x_gradient != none || b.y_gradient != none || b.z_gradient != none;
        if (gradient && !b.stress)
            incomplete_line(reader, "a gradient of stress needs the stress at the origin",
                            "write: bound stress sxx syy szz sxy sxz syz xgrad ...");
        const auto none_of = [](const auto& words) {
            return std::ranges::none_of(words, [](bool word) { return word; });
        };
        const bool silent =
            none_of(b.quiet) && none_of(b.reaction) && !b.normal_velocity && b.directed_velocity.empty();
        if (!prescribed && !any(b.free) && silent)
            incomplete_line(reader, "bound has no boundary condition",
                            "expected: xvel, xload, xfree, xvisc, xreac (or y, z), nvel or stress");
        if (b.multiplier && !prescribed)
            incomplete_line(reader, "hist has nothing to multiply", "give xvel (or y, z), a load or a stress");
    });
    entry.right("bound xvel = 0 zvel=0 range zr -1 0.01").right("bound str 0 0 -5 0 0 0 range z .09 .11");
    entry.right("bound zload -1e4 range group roof").right("bound xfree yfree zfree");
    entry.right("bound stress -1 -1 -2 0 0 0 zgrad 0.1 0.1 0.2 0 0 0 range x 0");
    entry.right("bound xvel @v y 0 1")
        .right("bound xvisc yvisc zvisc range region 3")
        .right("bound nvisc svisc range x 0");
    entry.right("bound zreaction range z -0.1 0.1").right("bound nvel 0 range x -0.1 0.1");
    entry.right("bound xvel 0.2 hist sine 5 range region 1").right("bound xvel 1 hist table 3 range z 0");
    entry.right("bound str 0 0 -1e6 0 0 0 hist @wave range z 10");
    entry.right("bound dvel 0 1 0 1 range x 0").right("bound dload -1e3 1 0 2 hist sine 5 range region 1");
    entry.wrong("bound dvel 0 0 0 0", "(0, 0, 0) is not a direction");
    entry.wrong("bound dload 5 1 0", "a number is missing after '0'");
    entry.right("bound stress -5e6 -2e6 -1e6 0 0 0 local 1 1 0 0 0 1 range x 0");
    entry.wrong("bound local 1 0 0 0 1 0", "local has no stress to rotate");
    entry.wrong("bound stress 0 0 -1 0 0 0 local 1 0 0 2 0 0", "(2, 0, 0) is parallel to (1, 0, 0)");
    entry.wrong("bound dvel 1 0 0 1 hist sine 5", "hist has nothing to multiply");
    entry.wrong("bound", "bound has no boundary condition");
    entry.wrong("bound xvel range x 0", "expected a number, found 'range'");
    entry.wrong("bound ff", "'boundary ff' is known, but kaya does not support it yet");
    entry.wrong("bound nvel", "a number is missing after 'nvel'");
    entry.wrong("bound xvisc 1", "expected a keyword of boundary, found '1'");
    entry.wrong("bound xvle 0", "'xvle' is not a keyword of boundary");
    entry.wrong("bound stress 0 0 -5", "a number is missing after '-5'");
    entry.wrong("bound stress 0 0 -5 0 0 0 0", "expected a keyword of boundary, found '0'");
    entry.wrong("bound xgrad 1 0 0 0 0 0", "a gradient of stress needs the stress at the origin");
    entry.wrong("bound xvel 1 hist", "a word is missing after 'hist'");
    entry.wrong("bound xvel 1 hist sin", "a number is missing after 'sin'");
    entry.wrong("bound xvel 1 hist tabel 1", "'tabel' is not a kind of history");
    entry.wrong("bound xfree hist table 1", "hist has nothing to multiply");
    return entry;
}

CommandSpec apply() {
    Entry<Apply> entry({"apply"});
    entry.help("prescribes velocities and loads of whole blocks, selected by their centroid");
    entry.place(&Apply::place);
    static constexpr const char* load[] = {"xload", "yload", "zload", "xmoment", "ymoment", "zmoment"};
    add_velocities(entry, "prescribed velocity of the blocks", "prescribed rotation of rigid blocks");
    for (std::size_t i = 0; i < 6; ++i)
        entry.keyword(
            {load[i]}, real("f").unit(i < 3 ? "force" : "moment"), [i](Apply & a) -> auto& { return a.load[i]; },
            i < 3 ? "force added at the centroid of each rigid block" : "moment added to each rigid block");
    add_directed(entry, {"dvel", "dvelocity"}, real("v").unit("velocity"), &Apply::directed_velocity,
                 "prescribed velocity of the blocks along a direction");
    add_directed(entry, {"dload"}, real("f").unit("force"), &Apply::directed_load,
                 "force along a direction, added to each rigid block");
    add_directed(entry, {"dmoment"}, real("m").unit("moment"), &Apply::directed_moment,
                 "moment about a direction, added to each rigid block");
    entry.keyword({"at"}, vector("x y z").unit("length"), &Apply::at,
                  "place of one block where the forces of the line act; its centroid if not given");
    add_multiplier(entry);
    entry.range(&Apply::range);
    entry.finish([](const Reader& reader, Apply& a) {
        const bool forces =
            std::any_of(a.load.begin(), a.load.begin() + 3, [](const auto& force) { return force.has_value(); }) ||
            !a.directed_load.empty();
        const bool multiplied =
            any(a.velocity) || any(a.load) || !a.directed_load.empty() || !a.directed_moment.empty();
        if (!multiplied && a.directed_velocity.empty())
            incomplete_line(reader, "apply has no velocity and no load",
                            "expected: xvel, rxvel, xload or xmoment (or y, z), dvel, dload or dmoment");
        if (a.at && !forces)
            incomplete_line(reader, "at has no force to place", "give xload (or y, z) or dload; a moment has no place");
        if (a.multiplier && !multiplied)
            incomplete_line(reader, "hist has nothing to multiply", "give xvel (or y, z), a load or a moment");
    });
    entry.right("apply xvel 0.8 range region 2").right("apply xvel 1 hist table 1 range z -1 0");
    entry.right("apply zload -1e4 hist sine 2 range group block").right("apply rzvel 0.1 range id 3");
    entry.right("apply xrvel 0 zrvel 0.1 range id 3").right("apply dvel 0 1 1 0 range id 3");
    entry.right("apply zload -500 at 0.2 0.5 1 range id 1")
        .right("apply dload 5e3 1 0 1 dmoment 20 0 1 0 range region 2");
    entry.wrong("apply at 0 0 1 range id 3", "apply has no velocity and no load");
    entry.wrong("apply xmoment 5 at 0 0 1 range id 3", "at has no force to place");
    entry.wrong("apply dload 1 0 0 0", "(0, 0, 0) is not a direction");
    entry.wrong("apply", "apply has no velocity and no load");
    entry.wrong("apply xvel", "a number is missing after 'xvel'");
    entry.wrong("apply xvel 1 hist sine 1 yvel 1 hist sine 2",
                "hist is given twice, and one function multiplies all values of a line");
    entry.wrong("apply xvle 1", "'xvle' is not a keyword of apply");
    return entry;
}

/// Components of fix and free.
template <class Command> Entry<Command> components(std::vector<Spelling> words) {
    Entry<Command> entry(std::move(words));
    for (std::size_t i = 0; i < 6; ++i)
        entry.action(
            velocity_words[i], [i](Command& c) { c.components[i] = true; },
            i < 3 ? "only translation in this direction" : "only rotation about this axis");
    entry.action(
        {"velocity"}, [](Command& c) { c.components[0] = c.components[1] = c.components[2] = true; },
        "only translation, in all directions");
    entry.action(
        {"rotation"}, [](Command& c) { c.components[3] = c.components[4] = c.components[5] = true; },
        "only rotation, about all axes");
    return entry;
}

Entry<Fix> directions(Entry<Fix> entry) {
    entry.keyword({"direction"}, Parts<Fix>().in(next_of(&Fix::directions), direction(vector("dx dy dz").spec)),
                  "only translation along this direction; the word may be repeated");
    return entry;
}

CommandSpec table() {
    Entry<TableCommand> entry({"table"});
    entry.help("defines a table of pairs (x, y), with linear interpolation");
    entry.place(&TableCommand::place);
    entry.argument(integer("n").at_least(0).help("number of the table"), &TableCommand::number);
    entry.keyword({"read"}, text("file"), &TableCommand::file,
                  "replaces the table by that of a file: a line of title, a line `count step`, then one y per line, or "
                  "x and y when the step is 0");
    entry.action(
        {"clear", "delete"}, [](TableCommand& t) { t.clear = true; }, "removes all pairs");
    using Point = std::array<double, 2>;
    entry.values(Parts<TableCommand>().in(next_of(&TableCommand::points),
                                          Parts<Point>()
                                              .then(
                                                  real("x"), [](Point & p) -> auto& { return p[0]; })
                                              .then(
                                                  real("y"), [](Point & p) -> auto& { return p[1]; })),
                 [](Reader& reader, TableCommand&) { return reader.at_number(); });
    entry.finish([](const Reader& reader, TableCommand& t) {
        if (t.points.empty() && t.file.empty() && !t.clear)
            incomplete_line(reader, "table has no pairs", "expected: pairs x y, read and a file, or clear");
    });
    entry.right("table 1 0 0 0.4 1.962 10 1.962").right("table 2 read quake.tab").right("table 1 (0,1) (1,2)");
    entry.right("table 1 clear");
    entry.wrong("table", "a number is missing after 'table'");
    entry.wrong("table 1", "table has no pairs");
    entry.wrong("table 1 0 0 0.4", "a number is missing after '0.4'");
    entry.wrong("table 1 read", "a word is missing after 'read'");
    entry.wrong("table 1 raed quake.tab", "'raed' is not a keyword of table");
    return entry;
}

CommandSpec water() {
    Entry<WaterCommand> entry({"water"});
    entry.help("water pressure in joints and zones: below a table, or linear in space");
    entry.place(&WaterCommand::place);
    using Kind = WaterCommand::Kind;
    // The last kind of a line counts.
    const auto of_kind = [](Kind kind) {
        return Parts<WaterCommand>().set([kind](WaterCommand& w) {
            w.kind = kind;
            w.pressure = 0;
            w.file.clear();
        });
    };
    entry.keyword({"table"}, of_kind(Kind::table).then(vector("x y z").unit("length"), &WaterCommand::origin),
                  "hydrostatic pressure below a plane through this point; it follows gravity");
    entry.keyword({"normal"}, vector("nx ny nz"), &WaterCommand::normal,
                  "upward normal of the table; 0 0 1 if not given");
    entry.keyword({"density"}, real("d").unit("density").above(0), &WaterCommand::density,
                  "density of the water; 1000 if not given, which `set units` must have as that of water");
    entry.keyword({"pressure", "pp"}, of_kind(Kind::pressure).then(real("p").unit("stress"), &WaterCommand::pressure),
                  "pressure at the origin of coordinates; where it would be negative it is 0");
    entry.keyword({"gradient"}, vector("gx gy gz").unit("stress/length"), &WaterCommand::gradient,
                  "change of the pressure with x, y and z");
    entry.keyword(
        {"ground"}, of_kind(Kind::ground).then(text("file"), &WaterCommand::file),
        "hydrostatic pressure below the surface of a file, as `cut ground` reads it; beyond its edge it is level");
    entry.keyword({"shift"}, vector("dx dy dz").unit("length"), &WaterCommand::origin, "moves that surface");
    entry.keyword({"off"}, of_kind(Kind::off), "removes the water");
    entry.finish([](const Reader& reader, WaterCommand& w) {
        if (!w.kind)
            incomplete_line(reader, "water has no table, ground or pressure",
                            "expected: table, ground, pressure or off");
    });
    entry.right("water ground 'hill.xyz' shift 0 0 -2")
        .right("water table 0 0 10")
        .right("water table 0 0 10 normal 0.1 0 1 density 1025");
    entry.right("water pressure 5e3").right("water pp 1e5 gradient 0 0 -1e4").right("water off");
    entry.wrong("water", "water has no table, ground or pressure");
    entry.wrong("water table 0 0", "a number is missing after '0'");
    entry.wrong("water tabel 0 0 1", "'tabel' is not a keyword of water");
    entry.wrong("water density 1000", "water has no table, ground or pressure");
    return entry;
}

} // namespace

Family boundary() {
    return {"boundary",
            "loads, velocities and initial values",
            {
                bound(),
                apply(),
                directions(components<Fix>({"fix"}))
                    .help("fixes blocks, or some components of their motion")
                    .range(&Fix::range)
                    .right("fix")
                    .right("fix range z -0.1 0")
                    .right("fix region 1")
                    .right("fix xvel rotation range id 2")
                    .right("fix direction 1 0 1 range id 3")
                    .wrong("fix direction 0 0 0", "(0, 0, 0) is not a direction")
                    .wrong("fix range z a", "expected a number, found 'a'")
                    .wrong("fix reigon 1", "'reigon' is not a keyword of fix"),
                components<Free>({"free"})
                    .action(
                        {"direction", "directions"}, [](Free& f) { f.directions = true; },
                        "only directions prescribed by `fix direction` and dvel")
                    .help("releases fixed blocks")
                    .range(&Free::range)
                    .right("free")
                    .right("free range id 3 5")
                    .right("free direction range id 3")
                    .wrong("free range id 1.5", "id takes a whole number, not 1.5"),
                Entry<Gravity>({"gravity"})
                    .help("acceleration of gravity, the same everywhere")
                    .argument(vector("gx gy gz").unit("acceleration"), &Gravity::value)
                    .right("gravity 0 0 -9.81")
                    .right("grav (0,0,-10)")
                    .right("grav @g")
                    .wrong("gravity", "a number is missing after 'gravity'")
                    .wrong("gravity 0 0", "a number is missing after '0'")
                    .wrong("gravity 0 0 -9.81 1", "unexpected '1' after the end of the command"),
                initialize(),
                insitu(),
                table(),
                water(),
            }};
}

} // namespace kaya::lang
