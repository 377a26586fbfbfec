// block contact material-table, block contact generate-subcontacts.
#include "commands/session/new_contacts.hpp"

#include "base/counted.hpp"
#include "commands/session/handlers.hpp"
#include "commands/ranges/saved_ranges.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/assign/new_joints.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

using Items = std::vector<lang::Property::Item>;

/// Calls `give(items, failed)`; a mistake is reported at the word of item number `failed`, or at that of the joint model.
template <class Give> void pointing_at_words(const Items& words, const Place& model_place, Give give) {
    std::vector<std::pair<std::string, double>> items;
    for (const auto& word : words) items.emplace_back(word.word, word.value);
    std::size_t failed = items.size();
    try {
        give(items, &failed);
    } catch (Diagnostic& mistake) {
        mistake.at(failed < items.size() ? words[failed].place : model_place);
        throw;
    }
}

std::string text_of_range(const lang::RangePhrase& range) { return ranges_text({{"", range}}); }
lang::RangePhrase range_of_text(const std::string& text) { return ranges_from_text(text).at(""); }

/// The contacts of the list that a range picks are taken out of it. A range that cannot be tested, of a group that is not there, picks none.
std::vector<Row> take_picked(Session& session, std::vector<Row>& contacts, std::size_t entry) {
    std::vector<Row> picked;
    try {
        const RangeTest test =
            session.test_of(ObjectKind::contact, range_of_text(session.engine.model.joint_rules[entry].range));
        std::erase_if(contacts, [&](Row contact) {
            if (test && !test(session.engine.model, ObjectKind::contact, contact)) return false;
            picked.push_back(contact);
            return true;
        });
    } catch (const Diagnostic& mistake) {
        session.warn_once(
            fmt::format("entry {} of the material table picks no contact: {}", entry + 1, mistake.message),
            mistake.hint);
    }
    return picked;
}

/// Returns how many contacts got an entry.
std::size_t apply_entries(Session& session, std::vector<Row> contacts) {
    Model& model = session.engine.model;
    const std::size_t all = contacts.size();
    for (std::size_t entry = 0; entry < model.joint_rules.size() && !contacts.empty(); ++entry) {
        const auto picked = take_picked(session, contacts, entry);
        if (!picked.empty()) give_joints(model, session.engine.joints, picked, model.joint_rules[entry].properties);
    }
    return all - contacts.size();
}

/// An entry by its number.
std::size_t entry_of(const Model& model, const lang::JointRuleCommand& command) {
    const auto number = *command.number;
    const auto count = static_cast<std::int64_t>(model.joint_rules.size());
    if (number > count)
        throw Diagnostic(fmt::format("the material table has no entry {}", number),
                         count == 0 ? "it is empty" : fmt::format("it has {}", counted(count, "entry")))
            .at(command.place);
    return static_cast<std::size_t>(number - 1);
}

/// The row of properties that the words of an entry make of another row.
void set_entry(Session& session, const lang::JointRuleCommand& command, Row from, std::int32_t& properties) {
    pointing_at_words(command.items, command.model_place, [&](const auto& items, std::size_t* failed) {
        properties = changed_joints(session.engine.model, session.engine.joints, from, command.model, items,
                                    session.deck.here(), failed);
    });
}

void add_entry(Session& session, const lang::JointRuleCommand& command) {
    Model& model = session.engine.model;
    JointRule rule{text_of_range(command.range), 0};
    set_entry(session, command, model.settings.default_properties, rule.properties);
    if (model.joint_rules.empty()) model.ruled_contacts = model.next_contact_number;
    model.joint_rules.push_back(std::move(rule));
}

void remove_entries(Model& model, const lang::JointRuleCommand& command) {
    if (command.number)
        model.joint_rules.erase(model.joint_rules.begin() + static_cast<long>(entry_of(model, command)));
    else model.joint_rules.clear();
    if (model.joint_rules.empty()) model.ruled_contacts = 0;
}

void list_entries(Session& session) {
    const auto& model = session.engine.model;
    if (model.joint_rules.empty()) return session.program.output.print("the material table is empty");
    TextTable table({"entry", "joint model", "given in"});
    for (std::size_t i = 0; i < model.joint_rules.size(); ++i) {
        const auto& set = model.joint_properties[static_cast<std::size_t>(model.joint_rules[i].properties)];
        table.add({std::to_string(i + 1), set.model, set.place});
    }
    session.program.output.print(table.text());
}

} // namespace

void find_joints(Session& session) {
    find_contacts(session.engine.model, session.engine.joints);
    follow_material_table(session);
}

void follow_material_table(Session& session) {
    Model& model = session.engine.model;
    if (model.joint_rules.empty() || model.ruled_contacts == model.next_contact_number) return;
    std::vector<Row> fresh;
    for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c)
        if (model.contacts.number[c] >= model.ruled_contacts) fresh.push_back(c);
    model.ruled_contacts = model.next_contact_number;
    apply_entries(session, std::move(fresh));
}

void run(Session& session, const lang::NewContacts& command) {
    pointing_at_words(command.items, command.model_place, [&](const auto& items, std::size_t* failed) {
        if (!command.model.empty()) session.engine.joints.get(command.model);
        set_new_joints(session.engine.model, session.engine.joints, command.model, items, session.deck.here(), failed);
    });
}

void run(Session& session, const lang::JointRuleCommand& command) {
    using enum lang::JointRuleCommand::Action;
    Model& model = session.engine.model;
    switch (command.action) {
    case add: return add_entry(session, command);
    case remove: return remove_entries(model, command);
    case list: return list_entries(session);
    case modify: {
        JointRule& rule = model.joint_rules[entry_of(model, command)];
        return set_entry(session, command, rule.properties, rule.properties);
    }
    case apply: {
        find_joints(session);
        const auto contacts = session.pick(ObjectKind::contact, {});
        const std::size_t count = apply_entries(session, contacts);
        session.program.output.say(
            fmt::format("{} of {} have an entry of the material table", counted(count, "contact"), contacts.size()));
    }
    }
}

void run(Session& session, const lang::FindContacts&) { find_joints(session); }

void add_handlers(HandlerTable& table, lang::NewContactCommands list) { fill(table, list); }

} // namespace kaya
