#include "model/edit/bounded.hpp"

#include "model/measure/compatibility.hpp"
#include "model/edit/plain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>

namespace kaya {

namespace {

constexpr const char* remedy =
    "the model is unchanged: restore a save from before, or delete the object; then look at the "
    "time step, stiffnesses, loads and initial values";

bool may_be_negative(std::string_view column) {
    constexpr std::string_view never[] = {"mass", "inertial_mass", "volume", "margin"};
    return std::ranges::find(never, column) == std::end(never);
}

/// "excavated_blocks" as "excavated block", "rotational_velocity" as "rotational velocity".
std::string in_words(std::string_view name, bool plural) {
    std::string words(name.substr(0, name.size() - (plural ? 1 : 0)));
    std::ranges::replace(words, '_', ' ');
    return words;
}

std::string number_or_numbers(std::span<const double> values) {
    return values.size() == 1 ? fmt::format("{:g}", values[0]) : fmt::format("({:g})", fmt::join(values, ", "));
}

/// Objects without a number are named by their block.
template <class Rows>
std::string object_at(const Model& model, std::string_view table, const Rows& rows, std::size_t row) {
    const std::string noun = in_words(table, true);
    if constexpr (requires { rows.number[row]; }) return fmt::format("{} {}", noun, rows.number[row]);
    else if constexpr (requires { static_cast<std::size_t>(rows.block[row]); }) {
        const auto& blocks = table.starts_with("excavated") ? model.excavated.blocks : model.blocks;
        const auto block = static_cast<std::size_t>(rows.block[row]); // an invalid block is beyond all
        if (block < blocks.size()) return fmt::format("a {} of block {}", noun, blocks.number[block]);
    }
    return fmt::format("{} {}", noun, row + 1);
}

/// The numbers of a column, `count` in each row.
struct ColumnNumbers {
    std::span<const double> all;
    std::size_t count;
    double most() const { return count == 3 ? largest_coordinate : std::numeric_limits<double>::max(); } // 3: a vector
};

/// The first that is invalid; none: as many as there are.
std::size_t first_invalid(std::string_view name, const ColumnNumbers& numbers) {
    const double most = numbers.most(), least = may_be_negative(name) ? -most : 0;
    const auto wrong = std::ranges::find_if(numbers.all, [&](double x) { return !(x >= least && x <= most); });
    return static_cast<std::size_t>(wrong - numbers.all.begin());
}

std::string wrong_number(std::string_view name, const std::string& object, const ColumnNumbers& numbers,
                         std::size_t at) {
    const double wrong = numbers.all[at], most = numbers.most();
    const auto limit = std::isfinite(wrong) && std::abs(wrong) > most
                           ? fmt::format("; numbers beyond {:g} belong to a run that has diverged", most)
                           : std::string();
    const auto row = numbers.all.subspan(at / numbers.count * numbers.count, numbers.count);
    return fmt::format("the {} of {} is {}{}", in_words(name, false), object, number_or_numbers(row), limit);
}

/// The fault of the first invalid row of a column; empty: none.
template <class Rows, class T> std::string wrong_row(const Model& model, std::string_view table, const Rows& rows,
                                                     std::string_view name, Column<T>& column) {
    const ColumnNumbers numbers{{scalars(column), column.size() * Plain<T>::count}, Plain<T>::count};
    const std::size_t at = first_invalid(name, numbers);
    if (at == numbers.all.size()) return {};
    return wrong_number(name, object_at(model, table, rows, at / numbers.count), numbers, at);
}

/// The same for the clock and settings of the cycle.
std::string wrong_of_time(const Model& model) {
    struct Number {
        const char* name;
        double value;
        bool may_be_negative = false;
    };
    const Clock& clock = model.clock;
    const Settings& settings = model.settings;
    for (const Number& number :
         {Number{"time", clock.time, true}, Number{"time step", clock.time_step},
          Number{"last time step", clock.last_step}, Number{"viscosity of global damping", clock.global_viscosity},
          Number{"given time step", settings.given_time_step, settings.given_time_step == step_of_3dec_wanted},
          Number{"scaled time step", settings.scaled_time_step},
          Number{"part of the stable time step", settings.time_step_fraction}}) {
        // A step of -0 is negative too: it would be neither computed nor moved by.
        const bool right =
            std::abs(number.value) <= largest_coordinate && (number.may_be_negative || !std::signbit(number.value));
        if (!right) return fmt::format("the {} is {:g}", number.name, number.value);
    }
    if (!is_bounded(settings.gravity))
        return fmt::format("gravity is {}", number_or_numbers({settings.gravity.data(), 3}));
    return {};
}

} // namespace

std::string unbounded_number(Model& model) {
    std::string found = wrong_of_time(model);
    const auto visit_rows = [&](const char* table, auto& rows) {
        rows.columns([&]<class T, class RoleType>(std::string_view name, Column<T>& column, RoleType role) {
            if constexpr (std::is_same_v<RoleType, Role> && requires { typename Plain<T>::scalar; }) {
                if constexpr (std::is_same_v<typename Plain<T>::scalar, double>) {
                    const bool counts = role == Role::geometry || role == Role::motion || role == Role::displacement;
                    if (found.empty() && counts) found = wrong_row(model, table, rows, name, column);
                }
            }
        });
    };
    model.tables(visit_rows);
    model.structure_tables(visit_rows);
    return found;
}

void require_bounded(Model& model) {
    if (const std::string wrong = unbounded_number(model); !wrong.empty()) throw Diagnostic(wrong, remedy, Fault::run);
}

Diagnostic diverged(Model& model) {
    const std::string wrong = unbounded_number(model);
    Diagnostic d(fmt::format("the run diverged: {}",
                             wrong.empty() ? "a velocity or a force is infinite, or not a number" : wrong),
                 "a velocity or a force has grown without limit: look at the time step, stiffnesses and loads",
                 Fault::run);
    d.code = "motion-lost";
    return d;
}

} // namespace kaya
