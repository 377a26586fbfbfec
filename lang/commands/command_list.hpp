// Lists of the structs of commands. The index of a struct in the list of all commands identifies the command.
#pragma once

#include <any>
#include <cstddef>
#include <type_traits>
#include <typeinfo>

namespace kaya::lang {

template <class... Command> struct CommandList { static constexpr std::size_t size = sizeof...(Command); };
template <class... List> struct CommandLists {};

/// A list and the commands of several CommandLists as one list.
template <class First, class Rest> struct JoinedLists;
template <class... A> struct JoinedLists<CommandList<A...>, CommandLists<>> { using All = CommandList<A...>; };
template <class... A, class... B, class... List>
struct JoinedLists<CommandList<A...>, CommandLists<CommandList<B...>, List...>>
    : JoinedLists<CommandList<A..., B...>, CommandLists<List...>> {};

template <class Command, class... Listed> constexpr bool is_in(CommandList<Listed...>) {
    return (std::is_same_v<Command, Listed> || ...);
}

template <class... Listed> bool is_one_of(const std::any& command, CommandList<Listed...>) {
    return ((command.type() == typeid(Listed)) || ...);
}

/// The place of a command in a list.
template <class Command, class... Listed> constexpr std::size_t index_in(CommandList<Listed...>) {
    static_assert((std::size_t{std::is_same_v<Command, Listed>} + ...) == 1,
                  "the struct of a command stands in one of the lists at the end of lang/commands/commands.hpp");
    std::size_t index = 0;
    (void)((std::is_same_v<Command, Listed> || (++index, false)) || ...);
    return index;
}

} // namespace kaya::lang
