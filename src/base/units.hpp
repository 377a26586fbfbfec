// Units as labels of results. They never change a number.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// A consistent system of units: force = mass * length / time^2. Without a name: quantities are labelled by their words ("length").
class Units {
public:
    Units() = default;
    /// Throws Diagnostic for an unknown name, with the nearest one.
    explicit Units(std::string_view name);
    static std::vector<std::string_view> names();
    /// Whether these are units of one system that can be named by its units one by one, in any order: "m", "kg-m".
    static bool fit(std::string_view units);

    const std::string& name() const { return name_; }
    bool given() const { return !name_.empty(); }
    /// "stress/length" becomes "MPa/m"; words that are not quantities stay.
    std::string label(std::string_view quantity) const;
    /// The same for the quantity at the beginning of each pair of brackets: "force [force, block nearest to 0 0 0]".
    std::string in_brackets(std::string_view text) const;
    /// A heading with the unit of its numbers, if there is a system of units and the quantity has one: "volume [m^3]".
    std::string heading(std::string_view words, std::string_view quantity) const;
    /// A number of this system in kilograms, metres and seconds: those of a density (kg/m^3), a stress (Pa), an acceleration (m/s^2).
    double density_in_si(double value) const;
    double stress_in_si(double value) const;
    double acceleration_in_si(double value) const;

private:
    std::string name_;
};

} // namespace kaya
