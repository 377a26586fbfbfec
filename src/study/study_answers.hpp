// Results of a study for users: the summary on the terminal, and the page report.html.
#pragma once

#include "study/search.hpp"
#include "study/statistics.hpp"

#include <optional>
#include <string>
#include <vector>

namespace kaya {

struct StudyAnswers {
    std::vector<Case> cases;
    std::vector<Outcome> outcomes;
    std::vector<std::pair<std::string, Moments>> moments; ///< of the results that are numbers
    std::optional<Probability> probability;
    std::vector<Bar> tornado;
    std::optional<Response> response;
    std::optional<CriticalAnswer> critical;
    std::optional<FitAnswer> fit;
};

/// Does the runs and evaluates them. Throws Diagnostic.
StudyAnswers answer(const Study& study, Runs& runs);

std::string summary_text(const Study& study, const StudyAnswers& answers);

/// One page that opens without a network: the summary, curves, scatter, bars, lines through all parameters, the table.
std::string report_page(const Study& study, const StudyAnswers& answers, const std::string& version);

} // namespace kaya
