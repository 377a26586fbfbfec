#include "study_files.hpp"

#include <array>
#include <fmt/format.h>
#include <string_view>

namespace kaya::soak {

namespace {

constexpr const char* deck = R"(param friction = 25
param load = 5
param law = 'mohr'
poly brick 0 1 0 1 -1 0
poly brick 0 1 0 1 0 1
fix range z -1 0
prop mat 1 dens 2000
jmodel model mohr
jmodel jkn 1e9 jks 1e9 jfric @friction
gravity @load 0 -8.66
cycle 10
def speed
  speed = b_xvel(b_near(0.5,0.5,0.5))
end
def name
  name = law
end
)";

constexpr std::array parameters{"friction",       "load",    "law",        "'prop 1 dens'",
                                "'jmodel jfric'", "nothing", "friction.x", "''"};
constexpr std::array results{"speed", "slides", "label", "again"};

/// Of the magnitude that the study needs; in one of twenty cases another value.
std::string value(Chance& c, double low = 20, double high = 40) {
    if (c.heads(0.95)) return fmt::format("{:.3g}", c.between(low, high));
    static constexpr std::array others{"'mohr'", "true", "[]", "1979-05-27", "{ }"};
    return c.heads() ? c.of(others) : odd_number(c);
}

/// One key of an inline table, `name = value`.
std::string pair(const char* name, Chance& c) {
    struct Span {
        std::string_view names;
        double low, high;
    };
    static constexpr std::array spans{Span{"from least", 5, 20},  Span{"to most", 30, 50},
                                      Span{"deviation", 0.1, 5},  Span{"shape alpha beta", 1, 4},
                                      Span{"tolerance", 0.1, 10}, Span{"value", 0, 1e-3}};
    for (const Span& span : spans)
        if (span.names.find(name) != span.names.npos)
            return fmt::format("{} = {}", name, value(c, span.low, span.high));
    return fmt::format("{} = {}", name, value(c));
}

std::string list(Chance& c) {
    std::vector<std::string> values;
    for (int k = c.heads(0.05) ? 0 : 1 + c.below(3); k > 0; --k) values.push_back(value(c));
    return "[" + join(values, ", ") + "]";
}

std::string distribution(Chance& c) {
    struct Kind {
        const char* name;
        std::vector<const char*> numbers;
    };
    static const std::array kinds{Kind{"normal", {"mean", "deviation"}},
                                  Kind{"lognormal", {"mean", "deviation"}},
                                  Kind{"gamma", {"mean", "deviation"}},
                                  Kind{"uniform", {"from", "to"}},
                                  Kind{"triangular", {"from", "mode", "to"}},
                                  Kind{"exponential", {"mean"}},
                                  Kind{"weibull", {"shape", "scale"}},
                                  Kind{"beta", {"from", "to", "alpha", "beta"}},
                                  Kind{"cauchy", {"mean"}}};
    const Kind& kind = c.of(kinds);
    std::vector<std::string> pairs{fmt::format("distribution = \"{}\"", kind.name)};
    for (const char* name : kind.numbers)
        if (c.heads(0.95)) pairs.push_back(pair(name, c));
    for (const char* name : {"least", "most"})
        if (c.heads(0.2)) pairs.push_back(pair(name, c));
    return "{ " + join(pairs, ", ") + " }";
}

std::string variation(Chance& c) {
    switch (c.below(6)) {
    case 0: return value(c);
    case 1: return list(c);
    case 2:
        return fmt::format("{{ {}, {}, count = {} }}", pair("from", c), pair("to", c),
                           c.heads(0.9) ? std::to_string(1 + c.below(3)) : odd_number(c));
    case 3: return fmt::format("{{ {}, {} }}", pair("from", c), pair("to", c));
    case 4: return fmt::format("{{ values = {}, {} }}", list(c), pair("base", c));
    default: return distribution(c);
    }
}

std::string design(Chance& c) {
    static constexpr std::array methods{"grid",  "list",   "one-at-a-time",  "latin-hypercube",
                                        "sobol", "random", "point-estimate", "magic"};
    std::string text = fmt::format("[design]\nmethod = \"{}\"\n", c.of(methods));
    if (c.heads(0.8))
        text += fmt::format("samples = {}\n", c.heads(0.9) ? std::to_string(1 + c.below(4)) : odd_number(c));
    if (c.heads(0.3)) text += fmt::format("seed = {}\n", number(c, 0.3));
    if (c.heads(0.2))
        text +=
            fmt::format("correlation = [[\"{}\", \"{}\", {}]]\n", c.of(parameters), c.of(parameters), number(c, 0.2));
    return text;
}

std::string result(Chance& c) {
    if (c.heads(0.6)) return "\"@speed\"";
    static constexpr std::array expressions{"\"@speed\"",
                                            "{ lua = \"fish.speed() > 1e-4\" }",
                                            "\"@name\"",
                                            "\"1/0\"",
                                            "{ lua = \"nil\" }",
                                            "\"b_next(block_head)\"",
                                            "{ lua = \"history[1].maximum\" }",
                                            "\"@speed + 1\"",
                                            "7",
                                            "{ lua = \"0/0\" }",
                                            "{ lua = \"1e999\" }",
                                            "\"\"",
                                            "\"block_head\""};
    return c.of(expressions);
}

std::string questions(Chance& c) {
    std::string text;
    if (c.heads(0.4)) {
        static constexpr std::array asks{"probability", "tornado", "response", "oracle"};
        text += fmt::format("[ask]\n{} = \"{}\"\n", c.of(asks), c.of(results));
    }
    if (c.heads(0.15))
        text += fmt::format("[critical]\nparameter = \"{}\"\nof = \"{}\"\n{}\n{}\n{}\n", c.of(parameters),
                            c.of(results), pair("from", c), pair("to", c), pair("tolerance", c));
    if (c.heads(0.15))
        text += fmt::format(
            "[fit]\nruns = {}\nmethod = \"bobyqa\"\n[fit.parameters]\n{} = {{ {}, {}, {} }}\n[fit.observed]\n{} = {{ {}, {} }}\n",
            c.heads(0.9) ? "4" : odd_number(c), c.of(parameters), pair("from", c), pair("to", c), pair("start", c),
            c.of(results), pair("value", c), pair("deviation", c));
    return text;
}

/// Consistent parameters, design, results and questions.
std::string sound_parts(Chance& c) {
    const bool sampled = c.heads();
    std::string text = "[parameters]\n";
    for (const char* name : {"friction", "load"}) {
        if (c.heads(0.3)) text += fmt::format("{} = {:.3g}\n", name, c.between(5, 40));
        else if (sampled)
            text += fmt::format("{} = {}\n", name,
                                c.heads() ? "{ from = 5, to = 40 }"
                                          : "{ distribution = \"normal\", mean = 20, deviation = 3 }");
        else
            text +=
                fmt::format("{} = {{ from = {:.3g}, to = 40, count = {} }}\n", name, c.between(1, 30), 2 + c.below(2));
    }
    text += fmt::format("law = [\"mohr\", \"{}\"]\n", c.heads() ? "elastic" : "<b>");
    static constexpr std::array sampling{"latin-hypercube", "sobol", "random"};
    if (sampled) text += fmt::format("[design]\nmethod = \"{}\"\nsamples = {}\n", c.of(sampling), 2 + c.below(4));
    text += "[results]\nspeed = \"@speed\"\nslides = { lua = \"fish.speed() > 1e-4\" }\n";
    text += fmt::format("label = {}\nagain = {}\n", result(c), result(c));
    static constexpr std::array asks{"probability = \"slides\"", "tornado = \"speed\"", "response = \"speed\"",
                                     "tornado = \"again\""};
    return text + (c.heads(0.6) ? fmt::format("[ask]\n{}\n", c.of(asks)) : "");
}

/// Random parts, valid by chance.
std::string any_parts(Chance& c) {
    std::string text = "[parameters]\n";
    for (int k = 1 + c.below(2); k > 0; --k)
        text +=
            fmt::format("{} = {}\n", c.heads(0.8) ? (k == 1 ? "friction" : "load") : c.of(parameters), variation(c));
    if (c.heads(0.6)) text += design(c);
    text += "[results]\n";
    for (const char* name : results)
        if (c.heads()) text += fmt::format("{} = {}\n", name, result(c));
    return text + questions(c);
}

} // namespace

Case study(Chance& c) {
    std::string text = c.heads(0.97) ? "deck = \"deck.3dd\"\n" : "deck = \"../deck.3dd\"\n";
    if (c.heads(0.2)) text += "title = \"<b>\\u001b[31m = 1 + 1\"\n";
    if (c.heads(0.2)) text += "keep = [\"*.csv\", \"../*\", \"[\"]\n";
    text += c.heads(0.6) ? sound_parts(c) : any_parts(c);
    text += fmt::format("[limits]\ncycles = 30\nseconds = {}\n", c.heads(0.9) ? "5" : odd_number(c));
    if (c.heads(0.1)) text += fmt::format("megabytes = {}\n", number(c, 0.3));
    return {{{"study.toml", text}, {"deck.3dd", deck}}, {"study", "study.toml", "--jobs", "1", "-q"}};
}

} // namespace kaya::soak
