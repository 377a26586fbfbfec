// The result of one run of a study, and its file.
#pragma once

#include "study/design.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

struct Outcome {
    enum class End {
        done,
        failed,  ///< its deck ended with an error
        limit,   ///< it took more than the study allows
        crashed, ///< the program crashed or called exit
        lost     ///< it was killed from outside, more than once
    };
    End end = End::done;
    std::string message; ///< why it is not done
    std::vector<std::pair<std::string, StudyValue>> results;
    double seconds = 0;
    std::int64_t cycles = 0;
    std::int64_t warnings = 0;
    std::string hash; ///< of the final state
};

const char* name_of(Outcome::End end);

/// The value of a result; nothing when the run has none.
StudyValue result_of(const Outcome& outcome, const std::string& name);

/// The number of a result of a run that is done; NaN for others, and for texts and nothing.
double known_number(const Outcome& outcome, const std::string& name);

/// Whole or not at all. Throws Diagnostic (Fault::run).
void write_outcome(const std::filesystem::path& file, const Case& one, const Outcome& outcome);

/// None when there is no such file. Throws Diagnostic when it is damaged, or belongs to a run with other values.
std::optional<Outcome> read_outcome(const std::filesystem::path& file, const Case& one);

/// The case of an existing outcome.
std::optional<Case> read_case(const std::filesystem::path& file);

/// The cases of a batch, for programs that do them elsewhere.
void write_cases(const std::filesystem::path& file, const std::vector<Case>& cases);
std::vector<Case> read_cases(const std::filesystem::path& file);

} // namespace kaya
