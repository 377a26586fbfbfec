// Groups: names by which ranges find objects. Blocks, faces, zones and contacts may each be in one group of every slot. A number in a column
// stands for all groups of an object: an index into Model::group_names.
#pragma once

#include "model/kinds/selection.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// The slot of groups that are given without one.
inline constexpr std::string_view default_slot = "Default";

/// A group: its name, and the slot that it is in.
struct GroupName {
    std::string slot{default_slot}, name;
};
/// The group that a user writes as `name` or `slot=name`.
GroupName group_name(std::string_view text);

/// The groups that a number stands for; the one of the default slot is first.
std::vector<GroupName> groups_of_number(const Model& model, std::int32_t number);
/// The name in the default slot; empty: none.
std::string_view default_group(const Model& model, std::int32_t number);
/// The lowest number with the same name in the default slot.
std::int32_t default_group_number(const Model& model, std::int32_t number);

/// The number of an object that has the groups of another number and this group as well, in place of another one in its slot. An empty name
/// takes the group of the slot away. New groups are added to the model.
std::int32_t with_group(Model& model, std::int32_t number, const GroupName& group);
/// The same for a group as a user writes it. The empty text stands for none.
std::int32_t with_group(Model& model, std::int32_t number, std::string_view text);
/// The number without the group of that name, in whatever slot, or in the slot that the text names.
std::int32_t without_group(Model& model, std::int32_t number, std::string_view text);

/// Which numbers have a group, ignoring case. A text without a slot, or with the slot `any`, finds the name in the default slot, and in all
/// slots when that has no such group. Empty when there is no such group.
class GroupMembers {
public:
    GroupMembers(const Model& model, std::string_view text);
    bool empty() const { return !any_; }
    bool contains(std::int32_t number) const { return member_[static_cast<std::size_t>(number)] != 0; }

private:
    std::vector<char> member_;
    bool any_ = false;
};

/// All groups of the model, each once, in the order in which they were made; `slot=name` outside of the default slot.
std::vector<std::string> all_groups(const Model& model);

/// The column with the groups of objects of that kind; null when the kind has none.
Column<std::int32_t>* own_groups(Model& model, ObjectKind kind);
const Column<std::int32_t>* own_groups(const Model& model, ObjectKind kind);

/// The groups of an object itself, else those of its block. Of a contact only its own; of a sub-contact without groups those of its
/// contact.
std::int32_t group_of(const Model& model, ObjectKind kind, Row row);
/// The name of that group in the default slot, else that of the block; empty: none.
std::string_view default_group_of(const Model& model, ObjectKind kind, Row row);

} // namespace kaya
