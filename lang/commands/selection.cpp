// Commands that give objects names and numbers, and those that take blocks out and put them back.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"

namespace kaya::lang {

namespace {

Entry<Group> group(std::vector<Spelling> form, Group::Kind kind) {
    Entry<Group> entry({"group"}, std::move(form));
    entry.start([kind](const Statement&, Group& command) { command.kind = kind; });
    entry.argument(text("name").help("name of the group"), &Group::name);
    entry.range(&Group::range);
    return entry;
}

CommandSpec mark() {
    Entry<Mark> entry({"mark"}, {"region"});
    entry.help("gives blocks a region number");
    entry.argument(integer("n").at_least(0).help("region number"), &Mark::region);
    entry.range(&Mark::range);
    entry.right("mark region 2 range z 0 10");
    entry.wrong("mark 2", "'2' stands where a kind of mark must be");
    entry.wrong("mark region", "a number is missing after 'region'");
    return entry;
}

CommandSpec mark_joint() {
    Entry<MarkJoint> entry({"mark"}, {"joint"});
    entry.help("gives faces, and the contacts on them, the number of a joint set");
    entry.argument(integer("n").at_least(0).at_most(2000000000).help("number of the joint set, 0 for none"),
                   &MarkJoint::joint_set);
    entry.range(&MarkJoint::range);
    entry.right("mark joint 5 range plane dip 0 dd 0 org 0 0 1 distance 0.01");
    entry.wrong("mark joint", "a number is missing after 'joint'");
    entry.wrong("mark joint -1", "joint must be at least 0, not -1");
    return entry;
}

} // namespace

std::vector<CommandSpec> selection_commands() {
    return {
        Entry<Excavate>({"excavate", "remove"})
            .help("takes blocks out of the model and keeps them; fill puts them back")
            .range(&Excavate::range)
            .right("excavate range group tunnel")
            .right("remove region 3")
            .wrong("remove reigon 3", "'reigon' is not a keyword of excavate"),
        Entry<Fill>({Spelling{"fill", 3}})
            .help("puts excavated blocks back where they were, with their material, at rest and without stress")
            .range(&Fill::range)
            .right("fill")
            .right("fill range group tunnel z 0 2")
            .wrong("fill tunnel", "'tunnel' is not a keyword of fill"),
        group({"block"}, Group::Kind::block)
            .help("gives blocks a name by which a range finds them")
            .right("group block wall range z 0 3")
            .right("group block 'left wall' range x -1 0 y 0 1")
            .wrong("group", "a word is missing after 'group'")
            .wrong("group wall", "'wall' is not a kind of group")
            .wrong("group block", "a word is missing after 'block'"),
        group({"face"}, Group::Kind::face)
            .help("gives faces a name by which a range finds them")
            .right("group face top range z 1")
            .wrong("group face", "a word is missing after 'face'"),
        group({"joint", "contact"}, Group::Kind::joint)
            .help("gives contacts a name by which range jgroup finds them")
            .right("group joint bed range plane dip 0 dd 0 org 0 0 1 distance 0.01")
            .right("group joint sides range jset 2")
            .wrong("group joint", "a word is missing after 'joint'"),
        group({"zone"}, Group::Kind::zone)
            .help("gives zones a name by which a range finds them")
            .right("group zone core range cyl end1 0 0 0 end2 0 0 9 radius 1")
            .wrong("group zone", "a word is missing after 'zone'"),
        mark(),
        mark_joint(),
    };
}

} // namespace kaya::lang
