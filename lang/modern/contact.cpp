// block contact ...: joints.
#include "lang/commands/property_items.hpp"
#include "lang/modern/components.hpp"
#include "lang/modern/language.hpp"

namespace kaya::lang {

namespace {

/// The name of a joint model, and its place.
template <class Command> Parts<Command> joint_model() {
    const auto place = [](Reader& reader, Command& command) {
        command.model_place = reader.peek() ? reader.peek()->place : Place{};
    };
    return Parts<Command>().check(place).then(text("name"), &Command::model);
}

CommandSpec contact_assign(std::string_view words, std::string_view example) {
    Leaf<JointModelCommand> leaf(words);
    leaf.means("jmodel model").help("assigns a joint model to contacts");
    leaf.argument(text("name").help("name of the joint model"), named_model(JointModelCommand::Action::assign));
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
    leaf.means("jmodel");
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
    leaf.keyword({"jmodel"}, joint_model<NewContacts>(), "the joint model; unchanged, or mohr, if not given");
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

/// The joint model and the properties of an entry of the material table.
void entry_words(Leaf<JointRuleCommand>& leaf) {
    leaf.keyword(
        {"jmodel"}, joint_model<JointRuleCommand>(),
        "the joint model; with it, values that are not given are those of the model, else those of the default");
    leaf.action(
        {"property"}, [](JointRuleCommand&) {}, "names of properties and their values follow");
    property_values(leaf);
}

template <JointRuleCommand::Action action> Leaf<JointRuleCommand> entry_leaf(std::string_view words) {
    Leaf<JointRuleCommand> leaf(words);
    leaf.start([](const Statement& statement, JointRuleCommand& command) {
        command.action = action;
        command.place = command.model_place = statement.words.front().place;
    });
    return leaf;
}

Argument<std::int64_t> entry_number() { return integer("i").at_least(1).help("number of the entry"); }

CommandSpec table_add() {
    auto leaf = entry_leaf<JointRuleCommand::Action::add>("block contact material-table add");
    leaf.help("joint model and properties of new contacts in a range; the first entry that picks a contact counts");
    entry_words(leaf);
    leaf.ranged(&JointRuleCommand::range);
    leaf.finish([](const Reader& reader, JointRuleCommand& command) {
        if (command.items.empty() && command.model.empty())
            incomplete_line(reader, "no property is given",
                            "write: block contact material-table add property friction 30 range ...");
        needs_range(reader, command);
    });
    leaf.right("block contact material-table add jmodel mohr property stiffness-normal 1e9 stiffness-shear 1e9 "
               "friction 30 range group-intersection 'wall' 'vault'");
    leaf.right("block contact mat-tab add prop friction 30 range group 'wall'");
    leaf.wrong("block contact material-table add property friction 30", "a range must be given");
    leaf.wrong("block contact material-table add range group 'a'", "no property is given");
    return leaf;
}

CommandSpec table_modify() {
    auto leaf = entry_leaf<JointRuleCommand::Action::modify>("block contact material-table modify");
    leaf.help("changes an entry of the material table");
    leaf.argument(entry_number(), &JointRuleCommand::number);
    entry_words(leaf);
    leaf.right("block contact material-table modify 1 property friction 20");
    leaf.wrong("block contact material-table modify", "a number is missing after 'modify'");
    leaf.wrong("block contact material-table modify 0 property friction 20", "modify must be at least 1, not 0");
    return leaf;
}

CommandSpec table_remove() {
    auto leaf = entry_leaf<JointRuleCommand::Action::remove>("block contact material-table remove");
    leaf.help("removes one entry of the material table, or all of them");
    leaf.action(
        {"all"}, [](JointRuleCommand& command) { command.number.reset(); }, "all entries, as without a number");
    leaf.values(Parts<JointRuleCommand>().then(entry_number(), &JointRuleCommand::number),
                [](Reader& reader, JointRuleCommand& command) { return reader.at_number() && !command.number; });
    leaf.right("block contact material-table remove").right("block contact material-table remove all");
    leaf.right("block contact material-table remove 1");
    leaf.wrong("block contact material-table remove al1",
               "'al1' is not a keyword of block contact material-table remove");
    return leaf;
}

CommandSpec table_list() {
    auto leaf = entry_leaf<JointRuleCommand::Action::list>("block contact material-table list");
    leaf.help("shows the entries of the material table");
    leaf.right("block contact material-table list");
    return leaf;
}

CommandSpec table_apply() {
    auto leaf = entry_leaf<JointRuleCommand::Action::apply>("block contact material-table apply");
    leaf.help("gives the entries of the material table to the contacts that are there");
    leaf.right("block contact material-table apply");
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
    auto leaf = group_leaf("block contact group", "group joint");
    leaf.right("block contact group 'bed' range position-z 1", "group joint bed range z 1");
    leaf.right("block contact group 'all'", "group joint all");
    leaf.wrong("block contact group", "a word is missing after 'group'");
    return leaf;
}

CommandSpec subcontact_group() {
    auto leaf = group_leaf("block contact group-subcontact", "group subcontact");
    leaf.right("block contact group-subcontact 'edge' range position-x 1", "group subcontact edge range x 1");
    leaf.wrong("block contact group-subcontact", "a word is missing after 'group-subcontact'");
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

/// A list of sub-contacts whose first subject is the word of the line.
CommandSpec sub_contact_list(std::string_view words, std::string_view subject, std::string_view example,
                             std::string_view classic, Example wrong) {
    Leaf<List> leaf(words);
    leaf.means(classic).help("sub-contacts: the values that the words name");
    leaf.start([subject](const Statement&, List& command) {
        command.what = List::What::sub_contacts;
        command.subjects = {std::string(subject)};
    });
    add_subjects(leaf, List::What::sub_contacts);
    leaf.ranged(&List::range);
    return leaf.right(example, classic).wrong(wrong.text, wrong.message);
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
                table_add(),
                table_modify(),
                table_remove(),
                table_list(),
                table_apply(),
                generate_subcontacts(),
                contact_group(),
                subcontact_group(),
                contact_join(),
                contact_reset(),
                list_line("block contact list", List::What::contacts, "contacts: blocks, normal, area",
                          "block contact list orientation range position-z 0 1",
                          "list contacts show orientation range z 0 1",
                          {"block contact list orientaton", "'orientaton' is not a keyword of block contact list"}),
                list_line("block contact list subcontacts", List::What::sub_contacts,
                          "sub-contacts: displacements, forces, state", "block contact list subcontacts",
                          "list subcontacts",
                          {"block contact list subcontacts strses",
                           "'strses' is not a keyword of block contact list subcontacts"}),
                sub_contact_list(
                    "block contact list force", "force", "block contact list force", "list subcontacts show force",
                    {"block contact list force strss", "'strss' is not a keyword of block contact list force"}),
                sub_contact_list(
                    "block contact list stress", "stress", "block contact list stress", "list subcontacts show stress",
                    {"block contact list stress strss", "'strss' is not a keyword of block contact list stress"}),
                sub_contact_list("block contact list displacement-normal", "displacement-normal",
                                 "block contact list displacement-normal", "list subcontacts show displacement-normal",
                                 {"block contact list displacement-normal strss",
                                  "'strss' is not a keyword of block contact list displacement-normal"}),
                sub_contact_list("block contact list displacement-shear", "displacement-shear",
                                 "block contact list displacement-shear", "list subcontacts show displacement-shear",
                                 {"block contact list displacement-shear strss",
                                  "'strss' is not a keyword of block contact list displacement-shear"}),
                sub_contact_list("block contact list pore-pressure|pressure", "pore-pressure",
                                 "block contact list pore-pressure", "list subcontacts show pore-pressure",
                                 {"block contact list pore-pressure strss",
                                  "'strss' is not a keyword of block contact list pore-pressure"}),
                list_line("block contact jmodel list", List::What::joint_models,
                          "joint models that are loaded, with their properties", "block contact jmodel list",
                          "list jmodel"),
                list_line("block contact list state", List::What::states, "joints by joint model and state",
                          "block contact list state", "list state"),
                ignored_line("block contact tolerance", "lengths of the search for contacts", own,
                             "block contact tolerance 1e-4"),
                ignored_line("block contact delete-open", "open sub-contacts in the first cycle",
                             "an open sub-contact has no force", "block contact delete-open on"),
                ignored_line("block contact local-stiffness", "stiffness for the time step",
                             "the time step of kaya always uses it", "block contact local-stiffness on"),
                ignored_line("block contact record-shear", "the largest shear displacement", own,
                             "block contact record-shear on"),
                ignored_line("block contact use-actual", "gaps in the first step", own, "block contact use-actual on"),
            }};
}

} // namespace kaya::lang
