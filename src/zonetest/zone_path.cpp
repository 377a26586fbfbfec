#include "zonetest/zone_path.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what, std::string hint) {
    throw Diagnostic(fmt::format("{}: {}", file.string(), what), std::move(hint));
}

/// The column of the path that a component follows, and whether it is a stress. None: the strain stays 0.
const std::vector<double>* column_of(const std::filesystem::path& file, const CsvTable& table,
                                     const std::string& component, bool& is_stress) {
    const auto strain = table.find(component + "_strain"), stress = table.find(component + "_stress");
    if (strain && stress)
        refuse(file, fmt::format("it gives {0}_strain and {0}_stress", component),
               "one of them follows from the other: leave one out");
    is_stress = stress.has_value();
    if (!strain && !stress) return nullptr;
    return &table.columns[strain ? *strain : *stress];
}

} // namespace

ZonePath read_zone_path(const std::filesystem::path& file) {
    const CsvTable table = read_csv(file);
    std::vector<std::string> known{"time"};
    for (const char* component : component_names)
        for (const char* kind : {"strain", "stress"}) known.push_back(fmt::format("{}_{}", component, kind));
    for (const auto& name : table.names)
        if (std::ranges::find(known, name) == known.end()) {
            const auto near = did_you_mean(name, {known.begin(), known.end()});
            refuse(file, fmt::format("no path of a zone has a column {}", name),
                   near.empty() ? "columns are xx_strain to yz_strain, xx_stress to yz_stress and time"
                                : fmt::format("did you mean '{}'?", near));
        }
    if (table.rows() < 2) refuse(file, "a path needs two points at least", "the first is where the test begins");
    ZonePath path;
    path.points.resize(table.rows());
    bool leads_anywhere = false;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto* column = column_of(file, table, component_names[k], path.is_stress[k]);
        for (std::size_t row = 0; column && row < table.rows(); ++row) path.points[row].value[k] = (*column)[row];
        leads_anywhere = leads_anywhere || column;
    }
    if (!leads_anywhere) refuse(file, "it prescribes no strain and no stress", "give a column, zz_strain say");
    const auto time = table.find("time");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        path.points[row].time = time ? table.columns[*time][row] : static_cast<double>(row);
        if (row > 0 && path.points[row].time < path.points[row - 1].time)
            refuse(file, "time goes back", "sort the rows by time");
    }
    return path;
}

} // namespace kaya
