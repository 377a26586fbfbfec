// Words that several commands of fractures share.
#pragma once

#include "lang/commands/builder.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/slots.hpp"

namespace kaya::lang {

/// The name of a group, and its slot if it follows. `group(struct)` is the name.
template <class Command, class Group> Parts<Command> group_of(Group group) {
    const auto name = Parts<std::string>()
                          .then(
                              text("name"), [](std::string & whole) -> auto& { return whole; })
                          .words(slot_words());
    const Lens<Command, std::string> lens{[group](Command& c) -> std::string& { return group(c); },
                                          [group](const Command& wanted, const Command&) {
                                              const std::string& there = group(const_cast<Command&>(wanted));
                                              return there.empty() ? nullptr : &there;
                                          }};
    return Parts<Command>().in(lens, name);
}

/// The words by which `fracture` commands choose fractures.
template <class Command> void add_choice(Entry<Command>& entry) {
    entry.keyword(
        {"dfn"}, text("name"), [](Command & c) -> auto& { return c.choice.network; },
        "fractures of this network; of all networks if not given");
    using Ids = std::array<std::int64_t, 2>;
    const auto first = integer("n").at_least(1), last = integer("m").at_least(1).optional();
    const auto one = [](Ids& ids, std::int64_t n) { ids = {n, n}; };
    const auto choice = [](auto part) {
        return [part](Command & c) -> auto& { return c.choice.*part; };
    };
    entry.keyword(
        {"ids"},
        Parts<Command>().in(made_at<Command, Ids>(choice(&FractureChoice::ids)),
                            Parts<Ids>()
                                .then(first, Through{one, [](const Ids& ids) { return std::optional(ids[0]); }})
                                .maybe(
                                    last, [](Ids & ids) -> auto& { return ids[1]; })),
        "fractures of this number, or from the first to the last");
    entry.keyword({"sizes"}, pair("diameter diameter").unit("length").at_least(0), choice(&FractureChoice::sizes),
                  "fractures whose diameter is between two limits; of a polygon that of the disc of its area");
    entry.keyword({"of-group"}, group_of<Command>(choice(&FractureChoice::group)),
                  "members of a group: name, slot=name, or name slot s");
}

/// The group and the rank of new fractures.
template <class Command> void add_group(Entry<Command>& entry) {
    entry.keyword({"group"}, group_of<Command>([](Command & c) -> auto& { return c.group; }),
                  "group of the fractures: name, slot=name, or name slot s");
    entry.keyword({"dominance", "dfn-dominance"}, integer("n").at_least(0).at_most(1e6), &Command::dominance,
                  "rank: fractures of a lower one are cut first; 0 if not given");
}

template <class Command> void add_box(Entry<Command>& entry, std::vector<Spelling> words, const char* help) {
    entry.keyword(std::move(words), tensor("x1 x2 y1 y2 z1 z2").unit("length"), &Command::box, help);
}

/// The line of p10.
template <class Command> void add_line(Entry<Command>& entry) {
    entry.keyword(
        {"begin"}, vector("x y z").unit("length"), [](Command & c) -> auto& { return c.line[0]; },
        "of the line of p10");
    entry.keyword(
        {"end"}, vector("x y z").unit("length"), [](Command & c) -> auto& { return c.line[1]; }, "of the line of p10");
}

template <class Command> void check_line(const Reader& reader, const Command& command, bool needed) {
    if (needed && !reader.wildcards() && command.line[0] == command.line[1])
        incomplete_line(reader, "p10 needs a line", "write: begin x y z end x y z");
}

} // namespace kaya::lang
