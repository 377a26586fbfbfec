// block contact material-table default, block contact generate-subcontacts.
#include "commands/handlers.hpp"
#include "mechanics/contact_properties.hpp"
#include "mechanics/new_joints.hpp"

namespace kaya {

void run(Session& session, const lang::NewContacts& command) {
    std::vector<std::pair<std::string, double>> items;
    for (const auto& item : command.items) items.emplace_back(item.word, item.value);
    std::size_t failed = items.size();
    try {
        if (!command.model.empty()) session.joints.get(command.model);
        set_new_joints(session.model, session.joints, command.model, items, session.here(), &failed);
    } catch (Diagnostic& mistake) {
        mistake.at(failed < items.size() ? command.items[failed].place : command.model_place);
        throw;
    }
}

void run(Session& session, const lang::FindContacts&) { find_contacts(session.model, session.joints); }

void add_handlers(HandlerTable& table, lang::NewContactCommands list) { fill(table, list); }

} // namespace kaya
