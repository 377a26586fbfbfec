// hist: adding, labelling, writing.
#include "commands/conditions/tables.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/new_contacts.hpp"
#include "commands/world/joint_values.hpp"
#include "commands/program/text_table.hpp"

#include "mechanics/assign/contact_properties.hpp"
#include "model/fields/field.hpp"
#include "model/fields/sampling.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

using SourceKind = HistorySource::Kind;

/// "": that of the field.
std::string label_of(const lang::HistoryItem& item) {
    if (!item.name.empty()) return item.name;
    const auto* quantity = std::get_if<lang::HistoryItem::Quantity>(&item.what);
    return quantity == nullptr ? std::string() : quantity->rate;
}

/// The source of a kind of item; the place is that of the item.
struct SourceOf {
    Session& session;
    HistorySource source;

    HistorySource operator()(const lang::HistoryItem::Script& item) {
        source.kind = SourceKind::function;
        source.quantity = item.symbol;
        if (!session.engine.scripts->knows(source.quantity)) {
            const auto symbols = session.engine.scripts->symbols();
            const auto near = did_you_mean(source.quantity, {symbols.begin(), symbols.end()});
            throw Diagnostic(fmt::format("there is no FISH variable or function '{}'", source.quantity),
                             near.empty() ? "define it before it is recorded"
                                          : fmt::format("did you mean '@{}'?", near));
        }
        return source;
    }
    HistorySource operator()(const lang::HistoryItem::Own& item) {
        find_joints(session);
        source.kind = SourceKind::sub_contact;
        source.quantity = recorded_name(session.engine, item.name, source.place);
        return source;
    }
    HistorySource operator()(const lang::HistoryItem::Quantity& item) {
        source.kind = item.kind;
        source.quantity = item.field;
        source.rate = !item.rate.empty();
        // Contacts are found late, at the first cycle; a history of one wants them now.
        if (info_of(source.kind).found_late) find_joints(session);
        return source;
    }
};

HistorySource source_of(Session& session, const lang::HistoryItem& item) {
    HistorySource source;
    source.place = item.place;
    return std::visit(SourceOf{session, source}, item.what);
}

void warn_of_far_place(Session& session, const History& history, const Place& word) {
    const auto object = sampled_object(session.engine.model, history.source);
    if (!object || !object->far) return;
    Diagnostic warning(fmt::format("{} is {} away from {}: history {} records what is at {}", object->name,
                                   number_text(object->distance), place_text(history.source.place), history.number,
                                   place_text(object->place)),
                       "check the place, or delete the history: hist delete");
    warning.code = "far-away";
    session.warn(warning.at(word));
}

History& history_of(Session& session, std::int64_t number, const Place& place) {
    auto& all = session.engine.model.histories.all;
    const auto found = std::ranges::find(all, number, &History::number);
    if (found != all.end()) return *found;
    throw Diagnostic(fmt::format("there is no history {}", number),
                     all.empty() ? "there are none" : fmt::format("the last one is {}", all.back().number))
        .at(place);
}

} // namespace

void run(Session& session, const lang::HistoryAdd& command) {
    const auto& all = session.engine.model.histories.all;
    const std::int64_t next = all.empty() ? 1 : all.back().number + 1;
    if (command.number && *command.number != next)
        session.warn(Diagnostic(fmt::format("this becomes history {}, not {}", next, *command.number),
                                "histories are counted in the order in which they are made")
                         .at(command.place));
    for (const auto& item : command.items) {
        try {
            const History& history = add_history(session.engine.model, source_of(session, item), label_of(item));
            warn_of_far_place(session, history, item.text);
            if (history.source.kind == SourceKind::function)
                warn_of_no_value(session, history.source.quantity, item.text);
        } catch (Diagnostic& mistake) {
            mistake.at(item.text);
            throw;
        }
    }
    if (command.interval) session.engine.model.histories.interval = static_cast<std::int32_t>(*command.interval);
}

void run(Session& session, const lang::HistoryDelete& command) {
    for (const auto number : command.numbers) history_of(session, number, command.place);
    auto& histories = session.engine.model.histories;
    std::erase_if(histories.all, [&](const History& history) {
        return command.numbers.empty() || std::ranges::find(command.numbers, history.number) != command.numbers.end();
    });
    if (!histories.all.empty()) return;
    // Without histories the sampled times have no meaning.
    histories.time.clear();
    histories.cycle.clear();
}

void run(Session& session, const lang::HistoryLabel& command) {
    history_of(session, command.number, command.place).label = command.text;
}

void add_handlers(HandlerTable& table, lang::HistoryCommands list) { fill(table, list); }

} // namespace kaya
