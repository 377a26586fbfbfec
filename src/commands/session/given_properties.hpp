// Property values that override those of the deck: param 'prop 1 jfric' = 30.
#pragma once

#include "lang/commands/commands.hpp"

#include <map>
#include <string>
#include <vector>

namespace kaya {

/// Values by command and property. A deck written with plain numbers can be used in a study unchanged.
class GivenProperties {
public:
    /// Accepts a name such as "prop 1 jfric", "prop jmat 2 kn" or "jmodel jfric"; the first value of a name counts. Throws Diagnostic at
    /// `place` for other names.
    void give(const std::string& name, double value, const Place& place);
    bool empty() const { return values_.empty(); }

    /// The items of a command with the values that were given in their place: of `prop` with that number, of `jmodel` without.
    std::vector<lang::Property::Item> replaced(std::vector<lang::Property::Item> items, std::int64_t number);
    static constexpr std::int64_t of_jmodel = -1;

    /// Names, as given, that no command has used so far.
    std::vector<std::string> unused() const;

private:
    struct Given {
        std::string name;
        double value;
        bool used = false;
    };
    std::map<std::pair<std::int64_t, std::string>, Given> values_; ///< by number and whole word
};

} // namespace kaya
