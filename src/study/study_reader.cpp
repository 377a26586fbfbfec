// The study file, TOML, as a Study.
#include "study/study.hpp"
#include "study/toml_section.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_grid_values = 100000;

std::optional<StudyValue> value_of(const toml::node& node) {
    if (node.is_boolean()) return StudyValue(*node.value<bool>());
    if (node.is_integer()) return StudyValue(*node.value<std::int64_t>());
    if (node.is_floating_point() && std::isfinite(*node.value<double>())) return StudyValue(*node.value<double>());
    if (node.is_string()) return StudyValue(*node.value<std::string>());
    return std::nullopt;
}

StudyValue needed_value(const TomlSection& in, const toml::node& node) {
    auto value = value_of(node);
    if (!value) in.fail(in.place_of(node), "a parameter is a number, a boolean or a string");
    return *value;
}

/// A name that a deck can have: letters, digits and _, no digit in front.
void check_name(const TomlSection& in, const std::string& name, const char* what) {
    if (is_property(name) && std::string_view(what) == "parameter") return;
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 || !std::ranges::all_of(name, allowed))
        in.fail(in.place_of(name), fmt::format("'{}' is not a valid name of a {}", name, what),
                "a name has letters, digits and _, and does not begin with a digit");
}

template <class Names>
std::size_t index_of_name(TomlSection& in, std::string_view key, const std::string& word, const Names& names) {
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) {
        const std::vector<std::string_view> candidates(names.begin(), names.end());
        const auto near = did_you_mean(word, candidates);
        in.fail(in.place_of(*in.find(key)), fmt::format("there is no {} '{}'", key, word),
                near.empty() ? fmt::format("known are {}", fmt::join(names, ", "))
                             : fmt::format("did you mean '{}'?", near));
    }
    return static_cast<std::size_t>(found - names.begin());
}

Distribution read_distribution(TomlSection& in, const std::string& word) {
    Distribution d;
    using Kind = Distribution::Kind;
    d.kind = static_cast<Kind>(index_of_name(in, "distribution", word, distribution_names()));
    switch (d.kind) {
    case Kind::normal:
    case Kind::lognormal:
    case Kind::gamma: d.a = in.needed_number("mean"), d.b = in.needed_number("deviation"); break;
    case Kind::exponential: d.a = in.needed_number("mean"); break;
    case Kind::weibull: d.a = in.needed_number("shape"), d.b = in.needed_number("scale"); break;
    case Kind::triangular: d.mode = in.needed_number("mode"); [[fallthrough]];
    case Kind::uniform: d.a = in.needed_number("from"), d.b = in.needed_number("to"); break;
    case Kind::beta:
        d.a = in.needed_number("from"), d.b = in.needed_number("to");
        d.alpha = in.needed_number("alpha"), d.beta = in.needed_number("beta");
        break;
    }
    if (const auto least = in.number("least")) d.least = *least;
    if (const auto most = in.number("most")) d.most = *most;
    return d;
}

/// Steps that end between two values would leave out 'to'.
[[noreturn]] void refuse_step(const TomlSection& in, double from, double to, double by) {
    const double fewer = std::floor((to - from) / by), range = to - from;
    const auto form = [&](double steps) { return fmt::format("by = {:.10g}", range / steps); };
    in.fail(in.place_of("by"), fmt::format("steps of {:g} from {:g} do not end at {:g}", by, from, to),
            fewer < 1 ? "write " + form(1) + ", or count = 2"
                      : fmt::format("write {} or {}, or count = {}", form(fewer), form(fewer + 1), fewer + 2));
}

/// from, to and `count` or `by`: evenly spaced values, both ends among them.
std::vector<StudyValue> read_span(TomlSection& in, double from, double to) {
    const auto count = in.count("count");
    const auto by = in.number("by");
    if (count && by) in.fail(in.place_of("by"), "a parameter takes 'count' or 'by', not both");
    std::size_t steps = 0;
    if (count) {
        if (*count < 2 || static_cast<std::size_t>(*count) > most_grid_values)
            in.fail(in.place_of("count"), fmt::format("'count' must be 2 to {}", most_grid_values));
        steps = static_cast<std::size_t>(*count) - 1;
    } else if (by) {
        const double parts = (to - from) / *by;
        if (!(parts > 0) || parts > static_cast<double>(most_grid_values))
            in.fail(in.place_of("by"), "'by' must lead from 'from' to 'to'");
        const double whole = std::max(1.0, std::round(parts));
        if (std::abs(parts - whole) > 1e-9 * whole) refuse_step(in, from, to, *by);
        steps = static_cast<std::size_t>(whole);
    } else {
        return {};
    }
    std::vector<StudyValue> values;
    for (std::size_t i = 0; i <= steps; ++i)
        values.emplace_back(i == steps ? to
                            : by       ? from + static_cast<double>(i) * *by
                                       : from + (to - from) * static_cast<double>(i) / static_cast<double>(steps));
    return values;
}

void read_factor_table(TomlSection in, Factor& factor) {
    if (const auto word = in.text("distribution")) {
        factor.distribution = read_distribution(in, *word);
    } else if (const auto from = in.number("from")) {
        const double to = in.needed_number("to");
        if (!(*from < to)) in.fail(in.place_of("to"), "'to' must be above 'from'");
        factor.values = read_span(in, *from, to);
        Distribution even;
        even.kind = Distribution::Kind::uniform, even.a = *from, even.b = to;
        factor.distribution = even;
    } else if (const auto* list = in.find("values")) {
        if (!list->is_array() || list->as_array()->empty())
            in.fail(in.place_of(*list), "'values' must be a list that is not empty");
        for (const auto& node : *list->as_array()) factor.values.push_back(needed_value(in, node));
    }
    if (const auto* base = in.find("base")) factor.base = needed_value(in, *base);
    if (factor.distribution) {
        const std::string mistake = factor.distribution->mistake();
        if (!mistake.empty()) in.fail(in.place(), fmt::format("the distribution of '{}': {}", factor.name, mistake));
    } else if (factor.values.empty()) {
        in.finish();
        in.fail(in.place(), fmt::format("'{}' does not say how it varies", factor.name),
                "give values = [...], from and to with count, or distribution = \"normal\" with mean and deviation");
    }
    in.finish();
}

void read_parameters(TomlSection in, Study& study) {
    in.each([&](const std::string& name, const toml::node& node) {
        check_name(in, name, "parameter");
        Factor factor{.name = name, .values = {}, .distribution = {}, .base = {}, .place = in.place_of(name)};
        if (node.is_table()) {
            read_factor_table(in.section_of(name, node), factor);
        } else if (node.is_array()) {
            if (node.as_array()->empty()) in.fail(in.place_of(node), fmt::format("the list of '{}' is empty", name));
            for (const auto& one : *node.as_array()) factor.values.push_back(needed_value(in, one));
        } else {
            study.fixed.emplace_back(name, needed_value(in, node));
            return;
        }
        study.factors.push_back(std::move(factor));
    });
}

void read_results(TomlSection in, Study& study) {
    in.each([&](const std::string& name, const toml::node& node) {
        check_name(in, name, "result");
        Asked asked{.name = name, .expression = {}, .lua = false, .place = in.place_of(name)};
        if (node.is_string()) {
            asked.expression = *node.value<std::string>();
        } else {
            TomlSection own = in.section_of(name, node);
            asked.expression = own.needed_text("lua");
            asked.lua = true;
            own.finish();
        }
        if (asked.expression.find_first_not_of(" \t@") == std::string::npos)
            in.fail(in.place_of(node), fmt::format("the expression of '{}' is empty", name));
        study.asked.push_back(std::move(asked));
    });
}

std::size_t factor_named(const TomlSection& in, const Place& place, const Study& study, const std::string& name) {
    const auto found = std::ranges::find(study.factors, name, &Factor::name);
    if (found == study.factors.end()) {
        std::vector<std::string_view> names;
        for (const auto& factor : study.factors) names.push_back(factor.name);
        const auto near = did_you_mean(name, names);
        in.fail(place, fmt::format("there is no parameter '{}' that varies", name),
                near.empty() ? "" : fmt::format("did you mean '{}'?", near));
    }
    return static_cast<std::size_t>(found - study.factors.begin());
}

void read_correlations(TomlSection& in, Study& study) {
    const auto* list = in.find("correlation");
    if (list == nullptr) return;
    const std::string form = "write correlation = [[\"c\", \"phi\", -0.5]]";
    if (!list->is_array()) in.fail(in.place_of(*list), "'correlation' must be a list", form);
    for (const auto& node : *list->as_array()) {
        const auto* row = node.as_array();
        if (row == nullptr || row->size() != 3 || !(*row)[0].is_string() || !(*row)[1].is_string() ||
            !(*row)[2].is_number())
            in.fail(in.place_of(node), "a correlation is two names and a number", form);
        Design::Correlation c;
        c.one = factor_named(in, in.place_of((*row)[0]), study, *(*row)[0].value<std::string>());
        c.other = factor_named(in, in.place_of((*row)[1]), study, *(*row)[1].value<std::string>());
        c.value = *(*row)[2].value<double>();
        if (c.one == c.other) in.fail(in.place_of(node), "a parameter is not correlated with itself");
        if (!(c.value > -1 && c.value < 1)) in.fail(in.place_of((*row)[2]), "a correlation lies between -1 and 1");
        for (const std::size_t i : {c.one, c.other})
            if (!study.factors[i].distribution)
                in.fail(in.place_of(node), fmt::format("'{}' has no distribution", study.factors[i].name));
        for (const auto& other : study.design.correlations)
            if (std::minmax(other.one, other.other) == std::minmax(c.one, c.other))
                in.fail(in.place_of(node), fmt::format("'{}' and '{}' have a correlation already",
                                                       study.factors[c.one].name, study.factors[c.other].name));
        study.design.correlations.push_back(c);
    }
}

void read_design(std::optional<TomlSection> found, Study& study) {
    using Method = Design::Method;
    Design& design = study.design;
    const bool scatters = std::ranges::any_of(study.factors, [](const Factor& f) { return f.values.empty(); });
    if (!found) {
        if (scatters && !study.factors.empty()) {
            const auto& factor = *std::ranges::find_if(study.factors, [](const Factor& f) { return f.values.empty(); });
            throw Diagnostic(fmt::format("'{}' scatters, and no [design] says how it is sampled", factor.name),
                             "give [design] with method = \"latin-hypercube\" and samples = 200")
                .at(factor.place);
        }
        return;
    }
    TomlSection& in = *found;
    design.method = static_cast<Method>(index_of_name(in, "method", in.needed_text("method"), method_names()));
    const bool samples =
        design.method == Method::latin_hypercube || design.method == Method::sobol || design.method == Method::random;
    if (samples) {
        design.samples = static_cast<std::size_t>(in.needed_number("samples"));
        const auto whole = in.count("samples");
        if (*whole < 1 || *whole > 10'000'000) in.fail(in.place_of("samples"), "'samples' must be 1 to 10000000");
        if (const auto seed = in.count("seed")) design.seed = static_cast<std::uint64_t>(*seed);
    }
    for (const auto& factor : study.factors) {
        const bool needs_distribution = samples || design.method == Method::point_estimate;
        if (needs_distribution && !factor.distribution)
            in.fail(factor.place,
                    fmt::format("method \"{}\" needs a distribution of '{}'",
                                method_names()[static_cast<std::size_t>(design.method)], factor.name),
                    "give distribution = \"normal\" with mean and deviation, or from and to");
        if (!needs_distribution && factor.values.empty())
            in.fail(factor.place,
                    fmt::format("method \"{}\" needs values of '{}'",
                                method_names()[static_cast<std::size_t>(design.method)], factor.name),
                    "give values = [...], or from, to and count");
        if (design.method == Method::one_at_a_time && !factor.base)
            in.fail(factor.place, fmt::format("method \"one-at-a-time\" needs the base of '{}'", factor.name),
                    "give base = 30 next to its values");
        if (design.method == Method::list && factor.values.size() != study.factors.front().values.size())
            in.fail(factor.place, fmt::format("a list needs as many values of '{}' as of '{}': {}", factor.name,
                                              study.factors.front().name, study.factors.front().values.size()));
    }
    read_correlations(in, study);
    in.finish();
}

void read_limits(std::optional<TomlSection> found, Study& study) {
    if (!found) return;
    const auto above_zero = [&](const char* key) {
        const auto value = found->number(key);
        if (value && !(*value > 0)) found->fail(found->place_of(key), fmt::format("'{}' must be above 0", key));
        return value.value_or(0);
    };
    study.limits.seconds = above_zero("seconds");
    study.limits.megabytes = above_zero("megabytes");
    above_zero("cycles");
    study.limits.cycles = found->count("cycles").value_or(0);
    found->finish();
}

void check_result(const TomlSection& in, const Place& place, const Study& study, const std::string& name) {
    std::vector<std::string_view> names;
    for (const auto& asked : study.asked) names.push_back(asked.name);
    if (std::ranges::find(names, name) != names.end()) return;
    const auto near = did_you_mean(name, names);
    in.fail(place, fmt::format("there is no result '{}'", name),
            near.empty() ? "results stand in [results]" : fmt::format("did you mean '{}'?", near));
}

void read_critical(std::optional<TomlSection> found, Study& study) {
    if (!found) return;
    TomlSection& in = *found;
    Critical c;
    c.parameter = in.needed_text("parameter");
    c.of = in.needed_text("of");
    check_result(in, in.place_of(*in.find("of")), study, c.of);
    c.from = in.needed_number("from"), c.to = in.needed_number("to");
    c.tolerance = in.needed_number("tolerance");
    c.place = in.place();
    if (!(c.from < c.to)) in.fail(in.place_of("to"), "'to' must be above 'from'");
    if (!(c.tolerance > 0)) in.fail(in.place_of("tolerance"), "'tolerance' must be above 0");
    check_name(in, c.parameter, "parameter");
    in.finish();
    study.critical = std::move(c);
}

Fit::Observation read_observation(TomlSection& in, const std::string& name, const toml::node& node,
                                  const Study& study) {
    check_result(in, in.place_of(name), study, name);
    Fit::Observation seen{.result = name, .value = 0, .deviation = 0};
    if (node.is_number()) {
        seen.value = *node.value<double>();
        return seen;
    }
    TomlSection own = in.section_of(name, node);
    seen.value = own.needed_number("value");
    if (const auto deviation = own.number("deviation")) {
        if (!(*deviation > 0)) own.fail(own.place_of("deviation"), "the deviation must be above 0");
        seen.deviation = *deviation;
    }
    own.finish();
    return seen;
}

void read_fit(std::optional<TomlSection> found, Study& study) {
    if (!found) return;
    TomlSection& in = *found;
    Fit fit;
    fit.place = in.place();
    if (const auto method = in.text("method")) {
        const std::array<std::string, 3> methods{"bobyqa", "cobyla", "sbplx"};
        fit.method = methods[index_of_name(in, "method", *method, methods)];
    }
    if (const auto tolerance = in.number("tolerance")) fit.tolerance = *tolerance;
    if (!(fit.tolerance > 0)) in.fail(in.place_of("tolerance"), "'tolerance' must be above 0");
    if (const auto runs = in.count("runs")) fit.most_runs = static_cast<std::size_t>(*runs);
    auto parameters = in.section("parameters");
    auto observed = in.section("observed");
    if (!parameters || !observed)
        in.fail(in.place(), "[fit] needs 'parameters' and 'observed'",
                "write [fit.parameters] with friction = { from = 10, to = 50 }, and [fit.observed] with slip = 0.012");
    parameters->each([&](const std::string& name, const toml::node& node) {
        check_name(*parameters, name, "parameter");
        TomlSection own = parameters->section_of(name, node);
        Fit::Unknown unknown{
            .parameter = name, .from = own.needed_number("from"), .to = own.needed_number("to"), .start = 0};
        if (!(unknown.from < unknown.to)) own.fail(own.place_of("to"), "'to' must be above 'from'");
        unknown.start = own.number("start").value_or(0.5 * (unknown.from + unknown.to));
        if (unknown.start < unknown.from || unknown.start > unknown.to)
            own.fail(own.place_of("start"), "'start' must lie between 'from' and 'to'");
        own.finish();
        fit.unknowns.push_back(unknown);
    });
    observed->each([&](const std::string& name, const toml::node& node) {
        fit.observations.push_back(read_observation(*observed, name, node, study));
    });
    if (fit.unknowns.empty() || fit.observations.empty())
        in.fail(in.place(), "[fit] needs a parameter and an observation");
    const auto has_deviation = [](const Fit::Observation& seen) { return seen.deviation > 0; };
    const bool none = std::ranges::none_of(fit.observations, has_deviation);
    for (const auto& seen : fit.observations)
        if (!has_deviation(seen) && (!none || seen.value == 0))
            in.fail(observed->place_of(seen.result),
                    fmt::format("'{}' needs a deviation, by which its difference is weighed", seen.result),
                    none ? "differences are parts of the measurement, which is 0 here: give deviations of all"
                         : "others have one: give it for all measurements, or for none");
    in.finish();
    study.fit = std::move(fit);
}

void read_ask(TomlSection in, Study& study) {
    const auto result_of = [&](const char* key) -> std::string {
        const auto name = in.text(key);
        if (!name) return {};
        check_result(in, in.place_of(*in.find(key)), study, *name);
        return *name;
    };
    study.probability_of = result_of("probability");
    study.tornado_of = result_of("tornado");
    study.response_of = result_of("response");
    in.finish();
}

void read_questions(TomlSection& in, Study& study) {
    if (auto ask = in.section("ask")) read_ask(*ask, study);
    read_critical(in.section("critical"), study);
    read_fit(in.section("fit"), study);
    if (study.critical && study.fit)
        in.fail(study.fit->place, "a study looks for a critical value or fits parameters, not both");
    if (!study.critical && !study.fit) return;
    if (!study.factors.empty())
        in.fail(study.factors.front().place,
                fmt::format("'{}' varies in addition to a search", study.factors.front().name),
                "a study with [critical] or [fit] gives its other parameters one value each");
}

/// Nothing may be given twice: a parameter that varies and is searched for.
void check_once(const TomlSection& in, const Study& study) {
    std::vector<std::string> names;
    for (const auto& [name, value] : study.fixed) names.push_back(name);
    if (study.critical && std::ranges::find(names, study.critical->parameter) != names.end())
        in.fail(study.critical->place,
                fmt::format("'{}' has a value in [parameters] and is searched for", study.critical->parameter));
    if (!study.fit) return;
    for (const auto& unknown : study.fit->unknowns)
        if (std::ranges::find(names, unknown.parameter) != names.end())
            in.fail(study.fit->place, fmt::format("'{}' has a value in [parameters] and is fitted", unknown.parameter));
}

} // namespace

bool is_property(const std::string& name) {
    return name.find(' ') != std::string::npos && name.find('\'') == std::string::npos;
}

const std::vector<std::string>& method_names() {
    static const std::vector<std::string> names{"grid",  "list",   "one-at-a-time", "latin-hypercube",
                                                "sobol", "random", "point-estimate"};
    return names;
}

std::string text_of(const StudyValue& value) {
    struct Text {
        std::string operator()(std::monostate) const { return {}; }
        std::string operator()(bool truth) const { return truth ? "true" : "false"; }
        std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
        std::string operator()(double number) const {
            std::string text = fmt::format("{}", number);
            // A number with a decimal point keeps it: 30.0 / 4 is 7.5, and 30 / 4 is 7.
            if (text.find_first_of(".en") == std::string::npos) text += ".0";
            return text;
        }
        std::string operator()(const std::string& text) const { return text; }
    };
    return std::visit(Text{}, value);
}

double number_of(const StudyValue& value) {
    if (const auto* truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    if (const auto* number = std::get_if<double>(&value)) return *number;
    return std::numeric_limits<double>::quiet_NaN();
}

Study read_study(const std::string& file, const std::string& text) {
    Study study;
    study.file = file;
    study.text = text;
    const auto source = source_of(file, text);
    const toml::table table = parse_toml(source, text);
    TomlSection in(table, source, "", Place{source, 1, 1, 1});
    const auto deck = in.text("deck");
    if (!deck)
        in.fail(in.place(), "a study needs its deck",
                in.hint_for_missing("deck", "write deck = \"slope.3dd\" in its first lines"));
    study.deck = (fs::path(file).parent_path() / *deck).string();
    study.deck_place = in.place_of(*in.find("deck"));
    std::error_code ignored;
    if (!fs::is_regular_file(study.deck, ignored))
        in.fail(study.deck_place, fmt::format("there is no deck '{}'", *deck),
                "the deck is looked for next to the study file");
    study.title = in.text("title").value_or("");
    if (auto parameters = in.section("parameters")) read_parameters(*parameters, study);
    auto results = in.section("results");
    if (!results)
        in.fail(in.place(), "a study needs results",
                "write [results] with slip = \"@max_slip\": a variable or function of the deck");
    read_results(*results, study);
    if (study.asked.empty())
        in.fail(results->place(), "[results] is empty",
                "write slip = \"@max_slip\": a variable or function of the deck");
    read_questions(in, study);
    if (!study.critical && !study.fit && study.factors.empty())
        in.fail(in.place(), "no parameter varies", "write [parameters] with friction = [20, 25, 30]");
    read_design(in.section("design"), study);
    read_limits(in.section("limits"), study);
    if (const auto* kept = in.find("keep")) {
        if (!kept->is_array())
            in.fail(in.place_of(*kept), "'keep' must be a list of patterns", "write keep = [\"*.png\", \"*.csv\"]");
        study.kept.emplace();
        for (const auto& node : *kept->as_array()) {
            if (!node.is_string())
                in.fail(in.place_of(node), "a pattern is a text", "write keep = [\"*.png\", \"*.csv\"]");
            study.kept->push_back(*node.value<std::string>());
        }
    }
    in.finish();
    check_once(in, study);
    return study;
}

Study read_study(const std::string& file) { return read_study(file, read_whole_file(file)); }

} // namespace kaya
