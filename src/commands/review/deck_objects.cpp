#include "commands/review/deck_objects.hpp"

#include "commands/review/deck_finding.hpp"
#include "commands/review/plot_views.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/named_word.hpp"

#include <algorithm>
#include <any>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

using lang::RangeElement;
using lang::RangePhrase;

template <class Command> const RangePhrase* range_in(const std::any& command) {
    if constexpr (requires(const Command& c) { RangePhrase(c.range); })
        if (const auto* found = std::any_cast<Command>(&command)) return &found->range;
    return nullptr;
}

/// The range phrase of a command; null when it has none.
template <class... Command> const RangePhrase* range_of(const std::any& command, lang::CommandList<Command...>) {
    const RangePhrase* found = nullptr;
    (void)((found = range_in<Command>(command)) || ...);
    return found;
}

template <class Command> void groups_in(const std::any& command, std::vector<std::string>& names) {
    if (const auto* found = std::any_cast<Command>(&command)) {
        if constexpr (requires { found->options.group; }) names.push_back(found->options.group);
        if constexpr (requires { found->core_group; }) names.push_back(found->core_group);
        if constexpr (requires { found->group; }) names.push_back(found->group);
    }
}

/// Names of the groups that a command makes.
template <class... Command> std::vector<std::string> groups_of(const std::any& command, lang::CommandList<Command...>) {
    std::vector<std::string> names;
    (groups_in<Command>(command, names), ...);
    if (const auto* group = std::any_cast<lang::Group>(&command); group != nullptr && !group->remove)
        names.push_back(group->name);
    std::erase(names, "");
    return names;
}

template <class Command> bool is(const std::any& command) { return command.type() == typeid(Command); }

bool holds_any(const std::string& text, std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(words, [&](auto word) { return text.find(word) != text.npos; });
}

/// The name of a group without its slot, in lower case.
std::string group_key(const std::string& name) {
    const std::string folded = lang::fold(name);
    return folded.substr(folded.find('=') + 1);
}

/// A name that is known when its line is reached.
bool is_late(const std::string& name) { return name.starts_with('@') || name.starts_with('['); }

bool is_number(const std::string& name) {
    constexpr std::size_t longest = 9;
    return !name.empty() && name.size() <= longest && name.find_first_not_of("0123456789") == name.npos;
}

std::string table_key(const lang::TableValue& value) {
    return value.name.empty() ? std::to_string(value.table) : lang::fold(value.name);
}

const lang::Multiplier* multiplier_of(const std::any& command) {
    if (const auto* boundary = std::any_cast<lang::Boundary>(&command))
        return boundary->multiplier ? &*boundary->multiplier : nullptr;
    if (const auto* apply = std::any_cast<lang::Apply>(&command))
        return apply->multiplier ? &*apply->multiplier : nullptr;
    return nullptr;
}

/// Commands that act on blocks which are there, beside those that cut.
using OnBlocks =
    lang::CommandList<lang::GenerateEdge, lang::GenerateQuad, lang::FaceTriangulation, lang::Fix, lang::Free,
                      lang::Boundary, lang::Apply, lang::Initialize, lang::InSitu, lang::Excavate, lang::Hide,
                      lang::Delete, lang::Mark, lang::CycleCommand, lang::Solve, lang::SolveControl,
                      lang::LimitEquilibrium, lang::VtkWrite, lang::Export>;
/// Whether cycles may follow in another deck: histories and loads after the last cycle are not in vain.
using HandsOver = lang::CommandList<lang::Save, lang::LuaFile, lang::LimitEquilibrium>;
/// Whether a command acts in cycles only.
using ActInCycles = lang::CommandList<lang::Gravity, lang::Apply, lang::Boundary>;

constexpr std::array nouns{"group", "named range", "table"};
constexpr std::array makers{"`group block NAME range ...` makes one", "`range name NAME ...` makes one",
                            "make it before: table n x y ..., or table n read file"};

} // namespace

void DeckObjects::anything_may_be_made() {
    open_.fill(true);
    histories_open_ = blocks_ = true;
}

void DeckObjects::check_script(std::string_view text) {
    const std::string folded = lang::fold(text);
    open_[0] = open_[0] || holds_any(folded, {"group", "import", "command"});
    open_[1] = open_[1] || holds_any(folded, {"range", "command"});
    open_[2] = open_[2] || holds_any(folded, {"table", "command"});
    histories_open_ = histories_open_ || holds_any(folded, {"hist", "command"});
    blocks_ = blocks_ || holds_any(folded, {"poly", "block", "import", "command", "create"});
    if (holds_any(folded, {"cycle", "solve", "step", "command"})) idle_.clear();
}

void DeckObjects::check(const lang::BoundCommand& command, bool inside) {
    const auto& any = command.command;
    if (is<lang::Restore>(any)) anything_may_be_made();
    if (is<lang::Quit>(any) && !inside) ended_ = true;
    if (ended_) return;
    if (const auto* function = std::any_cast<lang::FishDefinition>(&any)) return check_script(function->text);
    if (const auto* chunk = std::any_cast<lang::LuaChunk>(&any)) return check_script(chunk->text);
    if (is<lang::LuaFile>(any)) return anything_may_be_made();
    if (is<lang::FishCall>(any)) idle_.clear(); // it may cycle
    if (is<lang::New>(any)) forget();
    if (!inside) check_names(command);
    make(command);
    make_history(command);
    if (cycled_ && !inside && is_one_of(any, ActInCycles{}))
        idle_.push_back({"this load moves nothing", command.place});
    if (inside && is<lang::HistoryAdd>(any)) histories_open_ = true;
}

void DeckObjects::forget() {
    histories_.clear();
    history_names_.clear();
    idle_.clear();
    blocks_ = cycled_ = histories_open_ = false;
}

void DeckObjects::make(const lang::BoundCommand& command) {
    const auto& any = command.command;
    const auto made_here = [&](Kind kind, const std::string& name) {
        made_[static_cast<std::size_t>(kind)].try_emplace(name, command.place);
    };
    for (const auto& name : groups_of(any, lang::Commands{})) {
        if (is_late(name)) open_[0] = true;
        made_here(Kind::group, group_key(name));
    }
    if (is<lang::Import>(any)) open_[0] = true; // the file may have groups
    if (const auto* range = std::any_cast<lang::NameRange>(&any)) {
        if (is_late(range->name)) open_[1] = true;
        made_here(Kind::range, lang::fold(range->name));
    }
    if (const auto* table = std::any_cast<lang::TableCommand>(&any)) {
        if (command.late) open_[2] = true;
        made_here(Kind::table, table_key({table->number, table->name}));
    }
    if (const auto* limit = std::any_cast<lang::LimitEquilibrium>(&any); limit != nullptr && limit->table)
        made_here(Kind::table, std::to_string(*limit->table));
    if (is_one_of(any, lang::ShapeCommands{}) || is<lang::Import>(any)) blocks_ = true;
    if (is_one_of(any, CyclingCommands{})) cycled_ = true, idle_.clear();
    if (is_one_of(any, HandsOver{})) idle_.clear();
}

void DeckObjects::make_history(const lang::BoundCommand& command) {
    if (const auto* added = std::any_cast<lang::HistoryAdd>(&command.command)) {
        for (std::size_t i = 0; i < added->items.size(); ++i)
            histories_.insert(histories_.empty() ? 1 : *histories_.rbegin() + 1);
        for (const auto& item : added->items)
            if (!item.name.empty() && !item.name.starts_with('@') && !history_names_.insert(item.name).second)
                found_.push_back(finding(fmt::format("there is a history named '{}' already", item.name),
                                         "the name means the first one: give this one another", "implausible",
                                         Severity::warning)
                                     .at(command.place));
        if (cycled_ && !added->items.empty()) idle_.push_back({"this history records nothing", command.place});
    } else if (const auto* removed = std::any_cast<lang::HistoryDelete>(&command.command)) {
        if (removed->numbers.empty()) histories_.clear();
        history_names_.clear();
        for (const auto number : removed->numbers) histories_.erase(number);
    } else if (const auto* reset = std::any_cast<lang::Reset>(&command.command)) {
        if (std::ranges::find(reset->what, lang::Reset::What::histories) == reset->what.end()) return;
        histories_.clear();
        history_names_.clear();
        idle_.clear();
    }
}

void DeckObjects::check_names(const lang::BoundCommand& command) {
    const auto& any = command.command;
    // The ranges of these are read when they are used.
    const bool later = is<lang::NameRange>(any) || is<lang::JointRuleCommand>(any);
    if (const auto* range = later ? nullptr : range_of(any, lang::Commands{}))
        for (const auto& element : range->elements) {
            using enum lang::RangeKind;
            if (element.kind == group || element.kind == group_intersection)
                use(Kind::group, element.name, element.place);
            if (element.kind == group_intersection) use(Kind::group, element.second_name, element.place);
            if (element.kind == named) use(Kind::range, element.name, element.place);
        }
    if (const auto* multiplier = multiplier_of(any))
        if (const auto* table = std::get_if<lang::TableValue>(&multiplier->function); table != nullptr && !command.late)
            use(Kind::table, table->name.empty() ? std::to_string(table->table) : table->name, multiplier->place);
    if (const auto* limit = std::any_cast<lang::LimitEquilibrium>(&any); limit != nullptr && limit->water_table)
        use(Kind::table, std::to_string(*limit->water_table), command.place);
    if (!command.late) check_histories(command);
    if (const auto* plot = std::any_cast<lang::Plot>(&any)) check_plot(*plot, command);
    check_order(command);
}

void DeckObjects::use(Kind kind, const std::string& name, const Place& place) {
    const std::string key = kind == Kind::group ? group_key(name) : lang::fold(name);
    if (open_[static_cast<std::size_t>(kind)] || key.empty() || key == "none" || is_late(key) ||
        made(kind).contains(key))
        return;
    missing_.push_back({kind, key, place});
}

void DeckObjects::use_history(std::int64_t number, const lang::BoundCommand& command, Severity severity) {
    if (histories_open_ || histories_.contains(number)) return;
    const bool picture = severity == Severity::warning;
    Diagnostic d = finding(fmt::format("{}there is no history {}", picture ? "no picture: " : "", number),
                           picture              ? "'list hist' shows those that are there"
                           : histories_.empty() ? "there are none"
                                                : fmt::format("the last one is {}", *histories_.rbegin()),
                           "no-object", severity);
    lang::place_problem(d, lang::language(), command.place);
    found_.push_back(std::move(d));
}

void DeckObjects::check_histories(const lang::BoundCommand& command) {
    const auto& any = command.command;
    std::vector<std::int64_t> numbers;
    if (const auto* write = std::any_cast<lang::HistoryWrite>(&any)) {
        numbers = write->numbers;
        for (const auto& name : write->names)
            if (is_number(name)) numbers.push_back(std::stoll(name));
        if (write->versus) numbers.push_back(*write->versus);
        if (histories_.empty() && !histories_open_) {
            found_.push_back(
                finding("there are no histories to write", "hist records one: hist unbal", "no-object", Severity::error)
                    .at(command.place));
            return;
        }
    } else if (const auto* label = std::any_cast<lang::HistoryLabel>(&any)) {
        numbers.push_back(label->number);
    } else if (const auto* removed = std::any_cast<lang::HistoryDelete>(&any)) {
        numbers = removed->numbers;
    }
    for (const auto number : numbers) use_history(number, command, Severity::error);
}

void DeckObjects::check_plot(const lang::Plot& plot, const lang::BoundCommand& command) {
    auto words = plot.words;
    if (std::ranges::any_of(words, &lang::Plot::Item::script)) return;
    if (words.size() > 1 && words.front().quoted && !words[1].quoted) words.erase(words.begin());
    const PlotLine line = read_plot_line(words, plot.range, PlotView());
    const std::size_t before = found_.size();
    if (!line.unknown.empty()) {
        Diagnostic d = finding(fmt::format("plot ignores '{}'", fmt::join(line.unknown, " ")),
                               line.meant.empty() ? "docs/commands/plot.md lists what it draws"
                                                  : fmt::format("did you mean '{}'?", line.meant),
                               said_by_the_run, Severity::warning);
        lang::place_problem(d, lang::language(), command.place);
        found_.push_back(std::move(d));
    }
    for (const PlotItem& item : line.items) {
        if (item.kind != PlotItem::Kind::histories) continue;
        for (const auto number : item.numbers) use_history(std::abs(number), command, Severity::warning);
        if (item.versus && *item.versus > 0) use_history(*item.versus, command, Severity::warning);
    }
    for (std::size_t k = before; k < found_.size(); ++k) found_[k].code = said_by_the_run;
    const bool draws = line.task == PlotLine::Task::draw && line.unknown.empty();
    if (draws && line.items.empty() && made_plots_ == 0)
        found_.push_back(finding("no picture: the line names nothing to draw",
                                 "write for example: plot block disp file a.png", "implausible", Severity::warning)
                             .at(command.place));
    if (line.task != PlotLine::Task::draw) ++made_plots_;
}

/// What acts on blocks before the first of them.
void DeckObjects::check_order(const lang::BoundCommand& command) {
    if (blocks_ || !(is_one_of(command.command, OnBlocks{}) || is_one_of(command.command, lang::CutCommands{}))) return;
    blocks_ = true; // said once
    found_.push_back(finding("there are no blocks yet: this has no effect", "make them first: poly brick ...",
                             said_by_the_run, Severity::warning)
                         .at(command.place));
}

std::vector<Diagnostic> DeckObjects::findings() const {
    std::vector<Diagnostic> all = found_;
    for (const auto& [kind, name, place] : missing_) {
        const auto which = static_cast<std::size_t>(kind);
        const auto later = made_[which].find(name);
        std::vector<std::string_view> known;
        for (const auto& [other, line] : made_[which]) known.push_back(other);
        const auto near = did_you_mean(name, known);
        const bool number = kind == Kind::table && is_number(name);
        std::string hint = later != made_[which].end()
                               ? fmt::format("line {} makes it: it must come first", later->second.line)
                           : number && !known.empty() ? fmt::format("tables that are there: {}", fmt::join(known, ", "))
                           : near.empty() || number   ? makers[which]
                                                      : fmt::format("did you mean '{}'?", near);
        all.push_back(finding(number ? fmt::format("there is no table {}", name)
                                     : fmt::format("there is no {} '{}'", nouns[which], name),
                              std::move(hint), "no-object", Severity::error)
                          .at(place));
    }
    for (const auto& [what, place] : idle_)
        all.push_back(finding(fmt::format("no cycle follows: {}", what), "write it before the cycles", "implausible",
                              Severity::warning)
                          .at(place));
    return all;
}

} // namespace kaya
