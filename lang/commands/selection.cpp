// Commands that name and number objects, and commands that excavate blocks and fill them in.
#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/slots.hpp"

namespace kaya::lang {

namespace {

Entry<Group> group(std::vector<Spelling> form, ObjectKind kind) {
    Entry<Group> entry({"group"}, std::move(form));
    entry.start([kind](const Statement&, Group& command) { command.kind = kind; });
    entry.argument(text("name").help("name of the group; `slot=name` names its slot as well"), &Group::name);
    add_slot(
        entry, [](Group & command) -> auto& { return command.name; });
    entry.action(
        {Spelling{"remove", 3}}, [](Group& command) { command.remove = true; },
        "takes the objects out of the group; without a slot out of all groups of this name");
    entry.range(&Group::range);
    return entry;
}

CommandSpec mark() {
    Entry<Mark> entry({"mark"}, {"region"});
    entry.help("gives blocks a region number");
    entry.argument(integer("n").at_least(0).help("region number"), &Mark::region);
    entry.range(&Mark::range);
    entry.right("mark region 2 range z 0 10");
    entry.wrong("mark 2", "expected a kind of mark, found '2'");
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

CommandSpec copy() {
    Entry<Copy> entry({"copy"});
    entry.help("makes copies of blocks: moved, or mirrored at a plane, or both");
    entry.keyword({"offset"}, vector("dx dy dz").unit("length"), &Copy::offset, "how far a copy is moved");
    entry.action(
        {"mirror"}, [](Copy& command) { command.mirror = true; },
        "copies are mirrored at a plane, given by normal or dip and dd, and origin");
    entry.keyword({"dip"}, real("dip").unit("degrees"), &Copy::dip, "of the mirror: angle below the horizontal");
    entry.keyword({"dd", "dip-direction"}, real("dd").unit("degrees"), &Copy::dip_direction,
                  "of the mirror: direction of dip, clockwise from +y seen from above");
    entry.keyword({"normal"}, vector("nx ny nz"), &Copy::normal, "of the mirror, in place of dip and dd");
    entry.keyword({"origin", "org"}, vector("x y z").unit("length"), &Copy::origin, "a point of the mirror");
    entry.keyword({"number"}, integer("n").at_least(1).at_most(1e6), &Copy::number,
                  "of copies, each one offset farther; 1 if not given");
    entry.keyword({"region"}, integer("n").at_least(0).at_most(2000000000), &Copy::region,
                  "region number of the copies; that of the block if not given");
    entry.keyword({"group"}, text("name"), &Copy::group, "group of the copies; that of the block if not given");
    entry.range(&Copy::range, true); // region and group apply to the copies; the range needs its word
    entry.place(&Copy::place);
    entry.finish([](const Reader& reader, Copy& command) {
        if (!command.offset && !command.mirror)
            incomplete_line(reader, "copy has neither an offset nor a mirror",
                            "give offset dx dy dz, or mirror normal nx ny nz origin x y z");
        if (reader.wildcards()) return;
        if (command.number > 1 && (!command.offset || command.mirror))
            throw Diagnostic("several copies need an offset and no mirror", "give one copy command for each")
                .at(command.place);
        if (command.normal && !command.mirror)
            throw Diagnostic("the normal is that of a mirror", "write: copy mirror normal nx ny nz origin x y z")
                .at(command.place);
        if (command.normal && command.normal->norm() == 0)
            throw Diagnostic("the normal of the mirror is zero", "it must have a direction").at(command.place);
    });
    entry.right("copy offset 0 2 0 number 5 range region 1");
    entry.right("copy mirror normal 1 0 0 origin 4 0 0 group right");
    entry.right("copy mirror dip 90 dd 0 origin 0 0 0 offset 0 0 3");
    entry.wrong("copy", "copy has neither an offset nor a mirror");
    entry.wrong("copy offset 1 0", "a number is missing after '0'");
    entry.wrong("copy mirror normal 1 0 0 number 3", "several copies need an offset and no mirror");
    entry.wrong("copy offset 1 0 0 normal 1 0 0", "the normal is that of a mirror");
    entry.wrong("copy mirror normal 0 0 0", "the normal of the mirror is zero");
    return entry;
}

} // namespace

std::vector<CommandSpec> selection_commands() {
    return {
        copy(),
        Entry<Excavate>({"excavate", "remove"})
            .help("removes blocks and stores them; fill restores them")
            .range(&Excavate::range)
            .right("excavate range group tunnel")
            .right("remove region 3")
            .wrong("remove reigon 3", "'reigon' is not a keyword of excavate"),
        Entry<Fill>({Spelling{"fill", 3}})
            .help("restores excavated blocks in their places, with their material, at rest and without stress")
            .range(&Fill::range)
            .right("fill")
            .right("fill range group tunnel z 0 2")
            .wrong("fill tunnel", "'tunnel' is not a keyword of fill"),
        group({"block"}, ObjectKind::block)
            .help("gives blocks a name by which a range finds them")
            .right("group block wall range z 0 3")
            .right("group block 'left wall' range x -1 0 y 0 1")
            .right("group block thin slot shape range edge-length 0 0.1")
            .right("group block thin slot shape remove")
            .wrong("group", "a word is missing after 'group'")
            .wrong("group wall", "'wall' is not a kind of group")
            .wrong("group block wall slot", "a word is missing after 'slot'")
            .wrong("group block", "a word is missing after 'block'"),
        group({"face"}, ObjectKind::face)
            .help("gives faces a name by which a range finds them")
            .right("group face top range z 1")
            .wrong("group face", "a word is missing after 'face'"),
        group({"joint", "contact"}, ObjectKind::contact)
            .help("gives contacts a name by which range jgroup finds them")
            .right("group joint bed range plane dip 0 dd 0 org 0 0 1 distance 0.01")
            .right("group joint sides range jset 2")
            .wrong("group joint", "a word is missing after 'joint'"),
        group({"subcontact", "sub-contact"}, ObjectKind::sub_contact)
            .help(
                "gives sub-contacts a name by which range jgroup finds them; those without one have that of their contact")
            .right("group subcontact edge range x 1")
            .wrong("group subcontact", "a word is missing after 'subcontact'"),
        group({"zone"}, ObjectKind::zone)
            .help("gives zones a name by which a range finds them")
            .right("group zone core range cyl end1 0 0 0 end2 0 0 9 radius 1")
            .wrong("group zone", "a word is missing after 'zone'"),
        mark(),
        mark_joint(),
    };
}

} // namespace kaya::lang
