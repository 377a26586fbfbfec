// The content of a study file.
#pragma once

#include "base/diagnostic.hpp"
#include "study/distribution.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace kaya {

/// A number, truth or text: the value of a parameter, or a result. Nothing: a result that is not there.
using StudyValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// As `param` and `kaya --set` read it, with the fewest digits that preserve the bits. "" for nothing.
std::string text_of(const StudyValue& value);
/// NaN for texts and for nothing; 0 and 1 for truths.
double number_of(const StudyValue& value);

/// The name is that of a property that commands of the deck set: "prop 1 jfric", "jmodel jfric".
bool is_property(const std::string& name);

/// A parameter of the deck that varies.
struct Factor {
    std::string name;
    std::vector<StudyValue> values;           ///< values of a list or grid
    std::optional<Distribution> distribution; ///< how it scatters
    std::optional<StudyValue> base;           ///< its value while another parameter varies
    Place place;
};

/// A result of each run: an expression of FISH, or of Lua.
struct Asked {
    std::string name, expression;
    bool lua = false;
    Place place;
};

struct Design {
    enum class Method { grid, list, one_at_a_time, latin_hypercube, sobol, random, point_estimate };
    Method method = Method::grid;
    std::size_t samples = 0;
    std::uint64_t seed = 1;
    struct Correlation {
        std::size_t one = 0, other = 0; ///< indices of factors
        double value = 0;
    };
    std::vector<Correlation> correlations;
};
/// The names that a study file uses, in the order of Method.
const std::vector<std::string>& method_names();

/// Limits of one run; 0: unlimited.
struct RunLimits {
    double seconds = 0;
    double megabytes = 0;
    std::int64_t cycles = 0;
};

/// The value of a parameter at which a result changes from false to true, or through zero.
struct Critical {
    std::string parameter, of;
    double from = 0, to = 0, tolerance = 0;
    Place place;
};

/// Parameters for which results are as measured.
struct Fit {
    struct Observation {
        std::string result;
        double value = 0, deviation = 0; ///< deviation 0: unknown, equal weights
    };
    struct Unknown {
        std::string parameter;
        double from = 0, to = 0, start = 0;
    };
    std::vector<Observation> observations;
    std::vector<Unknown> unknowns;
    std::string method = "bobyqa";
    double tolerance = 1e-3; ///< as a fraction of the bounds
    std::size_t most_runs = 200;
    Place place;
};

struct Study {
    std::string file, text; ///< of the study itself
    std::string deck;       ///< as found from the current folder
    Place deck_place;       ///< where the file names it
    std::string title;
    std::vector<Factor> factors;
    std::vector<Asked> asked;
    std::vector<std::pair<std::string, StudyValue>> fixed; ///< parameters that do not vary
    Design design;
    RunLimits limits;
    std::optional<std::vector<std::string>> kept;        ///< patterns of files of a run that are kept; none: all
    std::string probability_of, tornado_of, response_of; ///< names of results; "" when not requested
    std::optional<Critical> critical;
    std::optional<Fit> fit;
};

/// Throws Diagnostic at the word that is wrong.
Study read_study(const std::string& file);
/// The same for a text, whose deck is next to `file`.
Study read_study(const std::string& file, const std::string& text);

} // namespace kaya
