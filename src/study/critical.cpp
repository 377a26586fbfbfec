#include "study/search.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr int most_steps = 60;

class Search {
public:
    Search(const Study& study, Runs& runs, CriticalAnswer& answer) : study_(study), runs_(runs), answer_(answer) {}

    /// Whether the result is true, or above zero, at these values of the parameter.
    std::vector<bool> at(const std::vector<double>& values) {
        std::vector<Case> cases;
        for (const double value : values) {
            Case one;
            one.number = answer_.cases.size() + cases.size() + 1;
            one.values = {{study_.critical->parameter, StudyValue(value)}};
            one.values.insert(one.values.end(), study_.fixed.begin(), study_.fixed.end());
            cases.push_back(std::move(one));
        }
        const auto outcomes = runs_.all(cases);
        std::vector<bool> truths;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const double result = number_of(result_of(outcomes[i], study_.critical->of));
            if (outcomes[i].end != Outcome::End::done || std::isnan(result))
                throw Diagnostic(fmt::format("run {} ({} = {}) has no result: {}", cases[i].number,
                                             study_.critical->parameter, values[i],
                                             outcomes[i].message.empty() ? study_.critical->of + " is not a number"
                                                                         : outcomes[i].message),
                                 "a search needs each of its runs", Fault::run)
                    .at(study_.critical->place);
            truths.push_back(result > 0);
        }
        answer_.cases.insert(answer_.cases.end(), cases.begin(), cases.end());
        answer_.outcomes.insert(answer_.outcomes.end(), outcomes.begin(), outcomes.end());
        return truths;
    }

private:
    const Study& study_;
    Runs& runs_;
    CriticalAnswer& answer_;
};

} // namespace

CriticalAnswer find_critical(const Study& study, Runs& runs) {
    const Critical& asked = *study.critical;
    CriticalAnswer answer;
    Search search(study, runs, answer);
    double low = asked.from, high = asked.to;
    const auto ends = search.at({low, high});
    if (ends[0] == ends[1])
        throw Diagnostic(fmt::format("'{}' is the same at {} = {} and {}", asked.of, asked.parameter, low, high),
                         "the critical value lies elsewhere: widen 'from' and 'to'")
            .at(asked.place);
    for (int step = 0; high - low > asked.tolerance && step < most_steps; ++step) {
        const double third = (high - low) / 3;
        const double first = low + third, second = high - third;
        if (!(low < first && first < second && second < high)) break; // no numbers between
        const auto there = search.at({first, second});
        if (there[0] != ends[0]) high = first;
        else if (there[1] != ends[0]) low = first, high = second;
        else low = second;
    }
    answer.below = low, answer.above = high, answer.value = 0.5 * (low + high);
    return answer;
}

} // namespace kaya
