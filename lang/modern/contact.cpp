// block contact ...: joints.
#include "lang/commands/property_items.hpp"
#include "lang/modern/components.hpp"
#include "lang/modern/groups.hpp"
#include "lang/modern/language.hpp"

namespace kaya::lang {

namespace {

/// Names of properties and their values up to the range.
template <class Command> void property_values(Leaf<Command>& leaf) {
    leaf.otherwise({real("property value").optional().spec},
                   [](Reader& reader, Command& command) { return read_property_item(reader, command.items); });
}

CommandSpec contact_assign(std::string_view words, std::string_view example) {
    Leaf<JointModelCommand> leaf(words);
    leaf.help("assigns a joint model to contacts");
    leaf.argument(text("name").help("name of the joint model"), [](JointModelCommand& command, std::string name) {
        command.action = JointModelCommand::Action::assign;
        command.model = std::move(name);
    });
    const std::size_t name_at = tree_words(words).size();
    leaf.start([name_at](const Statement& statement, JointModelCommand& command) {
        if (statement.words.size() > name_at) command.model_place = statement.words[name_at].place;
    });
    leaf.ranged(&JointModelCommand::range);
    leaf.right(example, "jmodel model mohr range group wall");
    return leaf;
}

CommandSpec contact_assign_word() {
    CommandSpec spec =
        contact_assign("block contact jmodel assign", "block contact jmodel assign mohr range group 'wall'");
    spec.wrong = {
        {"block contact jmodel assign", "a word is missing after 'assign'"},
        {"block contact jmodel assign mohr rnage id 1", "'rnage' is not a keyword of block contact jmodel assign"}};
    return spec;
}

CommandSpec contact_assign_name() {
    CommandSpec spec = contact_assign("block contact jmodel", "block contact jmodel mohr range group 'wall'");
    spec.wrong = {{"block contact jmodel", "a word is missing after 'jmodel'"}};
    return spec;
}

CommandSpec contact_load() {
    Leaf<JointModelCommand> leaf("block contact jmodel load", "jmodel load");
    leaf.arguments_of_meaning().checks_of_meaning();
    leaf.right("block contact jmodel load 'barton-bandis'", "jmodel load barton-bandis");
    leaf.wrong("block contact jmodel load", "a word is missing after 'load'");
    return leaf;
}

CommandSpec contact_property() {
    Leaf<JointModelCommand> leaf("block contact property");
    leaf.help("sets properties of the joint model that contacts have; a later line overrides an earlier one");
    property_values(leaf);
    leaf.ranged(&JointModelCommand::range);
    leaf.finish([](const Reader& reader, JointModelCommand& command) {
        if (command.items.empty())
            incomplete_line(reader, "no property is given", "write: block contact property stiffness-normal 1e9 ...");
    });
    leaf.right("block contact property stiffness-normal=1e9 stiffness-shear=1e9 friction 35 range group 'wall'",
               "jmodel stiffness-normal 1e9 stiffness-shear 1e9 friction 35 range group wall");
    leaf.right("block contact prop stiffness-norm 1e9", "jmodel stiffness-norm 1e9");
    leaf.wrong("block contact property", "no property is given");
    leaf.wrong("block contact property friction", "a number is missing after 'friction'");
    leaf.wrong("block contact property rnage group 'a'", "'rnage' is not a keyword of block contact property");
    return leaf;
}

CommandSpec contact_defaults() {
    Leaf<NewContacts> leaf("block contact material-table default");
    leaf.help("joint model and properties of contacts that are found from now on");
    const ArgumentSpec name = text("name").spec;
    leaf.special(
        {"jmodel"}, {name},
        [name](Reader& reader, NewContacts& command) {
            command.model_place = reader.peek() ? reader.peek()->place : Place{};
            command.model = reader.text(name);
        },
        "the joint model; unchanged, or mohr, if not given");
    leaf.action(
        {"property"}, [](NewContacts&) {}, "names of properties and their values follow");
    property_values(leaf);
    leaf.finish([](const Reader& reader, NewContacts& command) {
        if (command.items.empty() && command.model.empty())
            incomplete_line(reader, "no property is given",
                            "write: block contact material-table default property stiffness-normal 1e9 ...");
    });
    leaf.right("block contact material-table default property stiffness-normal 1e9 stiffness-shear 1e9");
    leaf.right("block contact mat-tab default jmodel mohr prop stiffness-normal 1e9 friction 30");
    leaf.wrong("block contact material-table default", "no property is given");
    leaf.wrong("block contact material-table default property friction", "a number is missing after 'friction'");
    leaf.wrong("block contact material-table defualt property friction 30",
               "'defualt' is not a kind of block contact material-table");
    return leaf;
}

CommandSpec generate_subcontacts() {
    Leaf<FindContacts> leaf("block contact generate-subcontacts");
    leaf.help("finds the contacts now, with the joint model and properties that new contacts have");
    leaf.right("block contact generate-subcontacts").right("bl cont gen-sub");
    leaf.wrong("block contact generate-subcontact now", "unexpected 'now' after the end of the command");
    return leaf;
}

CommandSpec contact_group() {
    Leaf<Group> leaf("block contact group", "group joint");
    leaf.arguments_of_meaning().ranged(&Group::range);
    leaf.special(
        {"slot"}, slot_word().arguments,
        [read = slot_word().read](Reader& reader, Group&) {
            char nothing = 0;
            read(reader, &nothing);
        },
        slot_word().help);
    leaf.not_yet({"remove"}, "groups that are taken away: give the objects another group");
    leaf.right("block contact group 'bed' range position-z 1", "group joint bed range z 1");
    leaf.right("block contact group 'all'", "group joint all");
    leaf.wrong("block contact group", "a word is missing after 'group'");
    return leaf;
}

CommandSpec contact_join() {
    Leaf<JoinContact> leaf("block contact join", "join_contact");
    leaf.action(
        {"on", "true", "yes"}, [](JoinContact&) {}, "joins the two blocks of each contact");
    leaf.not_yet({"off"}, "contacts that are separated: write block join off");
    leaf.ranged(&JoinContact::range);
    leaf.right("block contact join on range joint-set 2", "join_contact range jset 2");
    leaf.wrong("block contact join oon", "'oon' is not a keyword of block contact join");
    return leaf;
}

CommandSpec contact_reset() {
    Leaf<Reset> leaf("block contact reset", "reset");
    leaf.word("displacement", "jdisp");
    leaf.not_yet({"energy", "pore-pressure", "state", "stress"}, "other values of joints");
    leaf.finish([](const Reader& reader, Reset& command) {
        if (command.what.empty())
            incomplete_line(reader, "block contact reset does not say what to reset", "expected: displacement");
    });
    leaf.right("block contact reset displacement", "reset jdisp");
    leaf.wrong("block contact reset", "block contact reset does not say what to reset");
    return leaf;
}

} // namespace

Family contact_family() {
    constexpr const char* own = "kaya needs no such setting";
    return {"block contact",
            "joints",
            {
                contact_assign_word(),
                contact_assign_name(),
                contact_load(),
                contact_property(),
                contact_defaults(),
                generate_subcontacts(),
                contact_group(),
                contact_join(),
                contact_reset(),
                list_line("block contact list", List::What::contacts, "contacts: blocks, normal, area",
                          "block contact list range position-z 0 1", "list contacts range z 0 1"),
                list_line("block contact list subcontacts", List::What::sub_contacts,
                          "sub-contacts: displacements, forces, state", "block contact list subcontacts",
                          "list subcontacts"),
                list_line("block contact list state", List::What::states, "joints by joint model and state",
                          "block contact list state", "list state"),
                ignored_line("block contact tolerance", "lengths of the search for contacts", own,
                             "block contact tolerance 1e-4"),
                ignored_line("block contact local-stiffness", "stiffness for the time step",
                             "the time step of kaya always uses it", "block contact local-stiffness on"),
                ignored_line("block contact record-shear", "the largest shear displacement", own,
                             "block contact record-shear on"),
                ignored_line("block contact use-actual", "gaps in the first step", own, "block contact use-actual on"),
            }};
}

} // namespace kaya::lang
