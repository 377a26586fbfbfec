// initialize: velocities, displacements, stresses and pore pressures to start with.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

constexpr const char* velocities[6][2] = {{"xvel", "xvelocity"},   {"yvel", "yvelocity"},   {"zvel", "zvelocity"},
                                          {"rxvel", "rxvelocity"}, {"ryvel", "ryvelocity"}, {"rzvel", "rzvelocity"}};
constexpr const char* displacements[3][2] = {
    {"xdis", "xdisplacement"}, {"ydis", "ydisplacement"}, {"zdis", "zdisplacement"}};
constexpr const char* stresses[6] = {"sxx", "syy", "szz", "sxy", "sxz", "syz"};

/// xgrad, ygrad, zgrad after a number: how it changes with the coordinates.
std::vector<KeywordSpec> gradients() {
    Keywords<LinearNumber> words;
    static constexpr const char* word[] = {"xgradient", "ygradient", "zgradient"};
    static constexpr const char* help[] = {"change with x", "change with y", "change with z"};
    for (int k = 0; k < 3; ++k)
        words.keyword(
            {word[k]},
            real("g").unit("stress/length"), [k](LinearNumber & number) -> auto& { return number.gradient[k]; },
            help[k]);
    return std::move(words).list();
}

/// A word with the number at the origin of coordinates, and its gradients.
template <class Target>
void add_linear(Entry<Initialize>& entry, std::vector<Spelling> words, Target target, std::string_view help) {
    const auto parts =
        Parts<LinearNumber>().then(real("s").unit("stress"), &LinearNumber::at_origin).words(gradients());
    entry.keyword(std::move(words), Parts<Initialize>().in(made_at<Initialize, LinearNumber>(target), parts), help);
}

template <class Values> bool any(const Values& values) {
    return std::ranges::any_of(values, [](const auto& value) { return value.has_value(); });
}

} // namespace

CommandSpec initialize() {
    Entry<Initialize> entry({"initialize"});
    entry.help("sets initial values of gridpoints, rigid blocks, zones and joints");
    entry.place(&Initialize::place);
    for (std::size_t i = 0; i < 6; ++i)
        entry.keyword(
            {velocities[i][0], velocities[i][1]},
            i < 3 ? real("v").unit("velocity") : real("v").unit("angle in radians/time"),
            [i](Initialize & c) -> auto& { return c.velocity[i]; }, i < 3 ? "velocity" : "rotation of rigid blocks");
    for (std::size_t i = 0; i < 3; ++i)
        entry.keyword(
            {displacements[i][0], displacements[i][1]},
            real("d").unit("length"), [i](Initialize & c) -> auto& { return c.displacement[i]; },
            "displacement so far; no position changes");
    for (std::size_t i = 0; i < 6; ++i)
        add_linear(
            entry, {stresses[i]}, [i](Initialize & c) -> auto& { return c.stress[i]; },
            "stress of zones at the origin of coordinates, compression negative; xgrad, ygrad and zgrad may follow");
    add_linear(
        entry, {"pp"}, [](Initialize & c) -> auto& { return c.pore_pressure; },
        "pore pressure of gridpoints, which the joints next to them have; xgrad, ygrad and zgrad may follow");
    entry.not_yet({"temperature"}, "heat");
    entry.range(&Initialize::range);
    entry.finish([](const Reader& reader, Initialize& c) {
        if (!any(c.velocity) && !any(c.displacement) && !any(c.stress) && !c.pore_pressure)
            incomplete_line(reader, "initialize does not say what to set",
                            "expected: xvel, rxvel, xdis (or y, z), sxx or pp and a number");
    });
    entry.right("ini xvel 1").right("initialize xvel 0 yvel 0 zvel -2 range group ball");
    entry.right("ini rzvel 0.5 range id 2").right("ini xdis 0 ydis 0 zdis 0 range z 0 1");
    entry.right("ini szz -1e6 zgrad 2.6e4 sxx -5e5 zgrad 1.3e4 range z -100 0").right("ini pp 1e5 zgrad -1e4");
    entry.wrong("ini", "initialize does not say what to set");
    entry.wrong("ini sxx", "a number is missing after 'sxx'");
    entry.wrong("ini sxx -1e6 zgrad", "a number is missing after 'zgrad'");
    entry.wrong("ini zgrad 1e4", "'zgrad' is not a keyword of initialize");
    entry.wrong("ini xvel", "a number is missing after 'xvel'");
    entry.wrong("ini zval 1", "'zval' is not a keyword of initialize");
    return entry;
}

} // namespace kaya::lang
