#include "study/study_answers.hpp"

#include "base/counted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

std::vector<double> weights_of(const std::vector<Case>& cases) {
    std::vector<double> weights;
    for (const auto& one : cases) weights.push_back(one.weight);
    return weights;
}

std::vector<double> numbers_of(const std::vector<Outcome>& outcomes, const std::string& result) {
    std::vector<double> numbers;
    for (const auto& outcome : outcomes) numbers.push_back(known_number(outcome, result));
    return numbers;
}

std::string ends_text(const std::vector<Outcome>& outcomes) {
    std::array<std::size_t, 5> count{};
    for (const auto& outcome : outcomes) ++count[static_cast<std::size_t>(outcome.end)];
    std::string text = fmt::format("{}: {} done", counted(outcomes.size(), "run"), count[0]);
    for (std::size_t i = 1; i < count.size(); ++i)
        if (count[i] > 0)
            text += fmt::format(", {} {}", count[i], i == 2 ? "over a limit" : name_of(static_cast<Outcome::End>(i)));
    return text + '\n';
}

/// The messages of runs that were not done, each once, with how often and where first.
std::string messages_text(const StudyAnswers& answers) {
    std::vector<std::tuple<std::string, std::size_t, std::size_t>> said; // message, times, first run
    for (std::size_t i = 0; i < answers.outcomes.size(); ++i) {
        if (answers.outcomes[i].end == Outcome::End::done) continue;
        const auto found =
            std::ranges::find(said, answers.outcomes[i].message, [](const auto& one) { return std::get<0>(one); });
        if (found != said.end()) ++std::get<1>(*found);
        else said.emplace_back(answers.outcomes[i].message, 1, answers.cases[i].number);
    }
    std::string text;
    for (const auto& [message, times, first] : said)
        text += times == 1 ? fmt::format("  run {}: {}\n", first, message)
                           : fmt::format("  {} runs, the first is {}: {}\n", times, first, message);
    return text;
}

std::string fit_text(const FitAnswer& fit) {
    std::string text = fit.converged ? "fitted:\n" : "fitted, but the runs that are allowed were not enough:\n";
    for (const auto& one : fit.found) {
        text += fmt::format("  {} = {:.6g}", one.parameter, one.value);
        text += std::isnan(one.deviation) ? ", its uncertainty is not known" : fmt::format(" +- {:.2g}", one.deviation);
        text += one.at_bound ? ", at its bound\n" : "\n";
    }
    for (std::size_t j = 0; j < fit.correlation.size(); ++j)
        for (std::size_t k = j + 1; k < fit.correlation.size(); ++k)
            if (!std::isnan(fit.correlation[j][k]))
                text += fmt::format("  correlation of {} and {}: {:.2f}\n", fit.found[j].parameter,
                                    fit.found[k].parameter, fit.correlation[j][k]);
    for (const auto& one : fit.compared)
        text += fmt::format("  {}: measured {:.6g}, found {:.6g}\n", one.result, one.measured, one.found);
    return text;
}

/// `form` is that of fmt: "{:.3f}".
std::string known_text(double number, const char* form) {
    return std::isnan(number) ? "unknown" : fmt::format(fmt::runtime(form), number);
}

std::string probability_text(const std::string& result, const Probability& p) {
    std::string text = fmt::format("probability of '{}': ", result);
    if (!p.counts_truths) return text + "unknown, it has other values than true and false, or 1 and 0\n";
    if (p.count == 0) return text + "unknown, no run has a value\n";
    text += p.missing == 0
                ? fmt::format("{:.4g}", p.value)
                : fmt::format("{:.4g} to {:.4g}, by {} without a value", p.least, p.most, counted(p.missing, "run"));
    if (p.has_interval)
        text += fmt::format(" ({} of {} runs), between {:.4g} and {:.4g} with 95 %", p.hits, p.count + p.missing, p.low,
                            p.high);
    return text + '\n';
}

std::string response_text(const std::string& result, const Response& response) {
    std::string text =
        fmt::format("'{}' is about, with R^2 = {}:\n", result, known_text(response.determination, "{:.4f}"));
    for (const auto& term : response.terms) text += fmt::format("  {:+.6g} * {}\n", term.factor, term.name);
    if (!response.undetermined.empty())
        text += fmt::format("  left out, as these runs do not determine them: {}\n",
                            fmt::join(response.undetermined, ", "));
    return text;
}

} // namespace

StudyAnswers answer(const Study& study, Runs& runs) {
    StudyAnswers answers;
    if (study.critical) {
        answers.critical = find_critical(study, runs);
        answers.cases = answers.critical->cases, answers.outcomes = answers.critical->outcomes;
    } else if (study.fit) {
        answers.fit = fit_parameters(study, runs);
        answers.cases = answers.fit->cases, answers.outcomes = answers.fit->outcomes;
    } else {
        answers.cases = cases_of(study);
        answers.outcomes = runs.all(answers.cases);
    }
    const auto weights = weights_of(answers.cases);
    for (const auto& asked : study.asked) {
        const auto moments = moments_of(numbers_of(answers.outcomes, asked.name), weights);
        if (moments.count > 0) answers.moments.emplace_back(asked.name, moments);
    }
    if (!study.probability_of.empty())
        answers.probability = probability_of(numbers_of(answers.outcomes, study.probability_of), weights);
    if (!study.tornado_of.empty()) answers.tornado = tornado_of(study, answers.cases, answers.outcomes);
    if (!study.response_of.empty()) answers.response = response_of(study.response_of, answers.cases, answers.outcomes);
    return answers;
}

std::string summary_text(const Study& study, const StudyAnswers& answers) {
    std::string text = ends_text(answers.outcomes) + messages_text(answers);
    if (answers.critical)
        text += fmt::format("'{}' changes at {} = {:.6g} (between {:.6g} and {:.6g})\n", study.critical->of,
                            study.critical->parameter, answers.critical->value, answers.critical->below,
                            answers.critical->above);
    if (answers.fit) text += fit_text(*answers.fit);
    if (!answers.critical && !answers.fit)
        for (const auto& [name, m] : answers.moments)
            text +=
                fmt::format("{}: mean {}, deviation {}, {:.6g} to {:.6g}, median {:.6g}{}\n", name,
                            known_text(m.mean, "{:.6g}"), known_text(m.deviation, "{:.4g}"), m.least, m.most, m.median,
                            m.missing > 0 ? fmt::format(", and {} without a value", counted(m.missing, "run")) : "");
    if (answers.probability) text += probability_text(study.probability_of, *answers.probability);
    if (!answers.tornado.empty()) {
        text += fmt::format("sensitivity of '{}':\n", study.tornado_of);
        for (const auto& bar : answers.tornado)
            text += bar.low_text.empty()
                        ? fmt::format("  {}: rank correlation {}\n", bar.parameter, known_text(bar.high, "{:.3f}"))
                        : fmt::format("  {}: {} at {} to {} at {}\n", bar.parameter, known_text(bar.low, "{:.6g}"),
                                      bar.low_text, known_text(bar.high, "{:.6g}"), bar.high_text);
    }
    if (!study.response_of.empty() && !answers.response)
        text += fmt::format("too few runs for a response surface of '{}'\n", study.response_of);
    if (answers.response) text += response_text(study.response_of, *answers.response);
    return text;
}

} // namespace kaya
