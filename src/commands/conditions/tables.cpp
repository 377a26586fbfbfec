// table, and tables for histories of boundary conditions.
#include "commands/conditions/tables.hpp"
#include "base/lower_case.hpp"
#include "commands/session/handlers.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace kaya {

namespace {

/// Reads a table's file: a line of title, a line `count step`, then the values.
class TableFile {
public:
    TableFile(const std::filesystem::path& path, std::string name) : name_(std::move(name)) {
        const auto text = file_text(path);
        if (!text)
            throw Diagnostic(fmt::format("the table file '{}' cannot be read: {}", name_, std::strerror(errno)),
                             "check the name; it is searched next to the deck and in the current folder");
        std::istringstream in(*text);
        for (std::string line; std::getline(in, line);) {
            if (line.ends_with('\r')) line.pop_back();
            lines_.push_back(line);
        }
    }

    script::Table read() {
        if (lines_.size() < 2)
            throw Diagnostic(fmt::format("the table file '{}' ends before its second line", name_),
                             "its first line is a title, its second the number of values and their step");
        line_ = 1;
        next_word();
        const double count = number("the number of values");
        const double step = number("the step, or 0 for pairs x y");
        if (!(count >= 1) || count != std::floor(count)) fail("the number of values must be a whole number above 0");
        if (!(step >= 0)) fail("the step must not be below 0");
        if (!std::isfinite((count - 1) * step))
            fail(fmt::format("{} values with a step of {} reach x that no number can hold", number_text(count),
                             number_text(step)));
        std::vector<script::TablePoint> points;
        for (double i = 0; i < count; ++i) {
            const std::string what = fmt::format("value {:.0f} of {:.0f}", i + 1, count);
            const double x = step > 0 ? i * step : number(what);
            if (!points.empty() && x < points.back().x)
                fail(fmt::format("x goes back from {} to {}", number_text(points.back().x), number_text(x)));
            points.push_back({x, number(what)});
        }
        if (!word_.empty()) fail(fmt::format("there is more in the file than the {:.0f} values it speaks of", count));
        script::Table table;
        table.replace(std::move(points));
        return table;
    }

private:
    static constexpr std::string_view blanks = " \t,";

    /// Advances to the next word of the file; none at its end.
    void next_word() {
        word_ = {};
        while (line_ < lines_.size()) {
            const std::string_view line = lines_[line_];
            const std::size_t first = line.find_first_not_of(blanks, column_);
            if (first != std::string_view::npos) {
                const std::size_t end = std::min(line.find_first_of(blanks, first), line.size());
                word_ = line.substr(first, end - first);
                word_line_ = line_ + 1;
                column_ = end;
                return;
            }
            ++line_;
            column_ = 0;
        }
    }

    double number(const std::string& what) {
        if (word_.empty()) fail(fmt::format("the file ends before {}", what));
        std::string_view digits = word_;
        if (digits.starts_with('+')) digits.remove_prefix(1);
        double value = 0;
        last_line_ = word_line_;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
            fail(fmt::format("expected {}, found '{}'", what, word_));
        next_word();
        return value;
    }

    [[noreturn]] void fail(const std::string& message) const {
        throw Diagnostic(
            fmt::format("{}, line {}: {}", name_, word_.empty() ? lines_.size() : last_line_, message),
            "line 1 is a title, line 2 the number of values and their step (0: pairs x y), then come the values");
    }

    std::string name_;
    std::vector<std::string> lines_;
    std::size_t line_ = 0, column_ = 0;
    std::string_view word_;
    std::size_t word_line_ = 0, last_line_ = 0; ///< counted from 1, of the present word and of the number before it
};

} // namespace

namespace {

auto find_named(script::Tables& tables, const std::string& name) {
    return std::ranges::find_if(tables,
                                [&](const auto& entry) { return equal_ignoring_case(entry.second.name, name); });
}

/// The table that a command fills, by its name unless that is empty; a new name gets a new number.
std::int64_t table_to_fill(script::Tables& tables, const lang::TableCommand& command) {
    if (command.name.empty()) return command.number;
    if (const auto found = find_named(tables, command.name); found != tables.end()) return found->first;
    const std::int64_t next = tables.empty() ? 1 : std::max<std::int64_t>(tables.rbegin()->first, 0) + 1;
    tables[next].name = command.name;
    return next;
}

} // namespace

std::int64_t table_number(Session& session, const lang::TableValue& value) {
    if (value.name.empty()) return value.table;
    auto& tables = session.engine.scripts->tables();
    if (const auto found = find_named(tables, value.name); found != tables.end()) return found->first;
    std::vector<std::string_view> known;
    for (const auto& [number, table] : tables) known.push_back(table.name);
    const auto near = did_you_mean(value.name, known);
    throw Diagnostic(fmt::format("there is no table '{}'", value.name),
                     near.empty() ? "make it before: table 'name' import 'file'"
                                  : fmt::format("did you mean '{}'?", near));
}

void run(Session& session, const lang::TableCommand& command) {
    auto& tables = session.engine.scripts->tables();
    if (!command.file.empty()) {
        try {
            script::Table table = TableFile(session.input_file(command.file), command.file).read();
            table.name = command.name;
            tables[table_to_fill(tables, command)] = std::move(table);
        } catch (Diagnostic& mistake) {
            mistake.at(command.place);
            throw;
        }
    }
    if (command.clear && command.name.empty()) tables.erase(command.number);
    else if (command.clear)
        std::erase_if(tables, [&](const auto& entry) { return equal_ignoring_case(entry.second.name, command.name); });
    if (command.points.empty()) return;
    const std::int64_t number = table_to_fill(tables, command);
    tables[number].require_sorted(fmt::format("table {}", number));
    for (const auto& [x, y] : command.points) tables[number].insert(x, y);
}

void check_table(Session& session, std::int64_t number) {
    const auto& tables = session.engine.scripts->tables();
    const auto found = tables.find(number);
    if (found == tables.end()) {
        std::vector<std::string> known;
        for (const auto& [n, table] : tables) known.push_back(std::to_string(n));
        throw Diagnostic(fmt::format("there is no table {}", number),
                         known.empty() ? "make it before: table n x y ..., or table n read file"
                                       : fmt::format("tables that are there: {}", fmt::join(known, ", ")));
    }
    if (found->second.points().empty())
        throw Diagnostic(fmt::format("table {} holds no pair", number), "fill it before");
    found->second.require_sorted(fmt::format("table {}", number));
}

void check_symbol(Session& session, const std::string& name) {
    if (session.engine.scripts->knows(name)) return;
    const auto symbols = session.engine.scripts->symbols();
    const auto near = did_you_mean(name, {symbols.begin(), symbols.end()});
    throw Diagnostic(fmt::format("there is no FISH variable or function '{}'", name),
                     near.empty() ? "define it before it is used" : fmt::format("did you mean '@{}'?", near));
}

void warn_of_no_value(Session& session, const std::string& function, const Place& place) {
    if (session.engine.scripts->gives_value(function)) return;
    Diagnostic warning(fmt::format("the function '{}' never sets its name: its value is always 0", function),
                       fmt::format("write {} = ... in it, or return a value", function));
    warning.code = "no-value";
    if (session.program.said_once.insert(warning.message).second) session.warn(warning.at(place));
}

void check_time_functions(Session& session) {
    const std::set<std::int32_t> used(session.engine.model.boundary_histories.function.begin(),
                                      session.engine.model.boundary_histories.function.end());
    for (const auto row : used) {
        const TimeFunction& function = session.engine.model.time_functions[static_cast<std::size_t>(row)];
        try {
            if (function.kind == TimeFunction::Kind::table) check_table(session, function.table);
            if (function.kind == TimeFunction::Kind::script) check_symbol(session, function.script);
        } catch (Diagnostic& mistake) {
            if (!function.place.empty()) mistake.add("history of the boundary condition given at " + function.place);
            throw;
        }
    }
}

void add_handlers(HandlerTable& table, lang::TableCommands list) { fill(table, list); }

} // namespace kaya
