#include "model/kinds/groups.hpp"

#include "base/lower_case.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Between the parts of an entry of Model::group_names: the name in the default slot, then `slot=name` of other slots in the order of their
/// slots. An entry with one part is a group of the default slot.
constexpr char separator = '\x1f';

bool is_default(std::string_view slot) { return equal_ignoring_case(slot, default_slot); }

GroupName split(std::string_view text) {
    const auto equals = text.find('=');
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

std::vector<GroupName> groups_of_entry(std::string_view entry) {
    std::vector<GroupName> groups;
    auto end = std::min(entry.find(separator), entry.size());
    if (end > 0) groups.push_back({std::string(default_slot), std::string(entry.substr(0, end))});
    while (end < entry.size()) {
        const auto begin = end + 1;
        end = std::min(entry.find(separator, begin), entry.size());
        groups.push_back(split(entry.substr(begin, end - begin)));
    }
    return groups;
}

std::string entry_of_groups(const std::vector<GroupName>& groups) {
    std::string entry;
    for (const GroupName& group : groups) {
        if (is_default(group.slot)) entry = group.name;
        else entry += fmt::format("{}{}={}", separator, group.slot, group.name);
    }
    return entry;
}

/// Index of an entry, ignoring case; a new one is added.
std::int32_t number_of_entry(Model& model, const std::string& entry) {
    auto& names = model.group_names;
    const auto found =
        std::ranges::find_if(names, [&](const std::string& other) { return equal_ignoring_case(entry, other); });
    const auto number = static_cast<std::int32_t>(found - names.begin());
    if (found == names.end()) names.push_back(entry);
    return number;
}

} // namespace

GroupName group_name(std::string_view text) {
    const auto equals = text.find('=');
    const bool has_slot = equals != text.npos && equals > 0 && equals + 1 < text.size();
    if (!has_slot) return {std::string(default_slot), std::string(text)};
    GroupName group = split(text);
    if (is_default(group.slot)) group.slot = default_slot;
    return group;
}

std::vector<GroupName> groups_of_number(const Model& model, std::int32_t number) {
    return groups_of_entry(model.group_names[static_cast<std::size_t>(number)]);
}

std::string_view default_group(const Model& model, std::int32_t number) {
    const std::string_view entry = model.group_names[static_cast<std::size_t>(number)];
    return entry.substr(0, entry.find(separator));
}

std::int32_t default_group_number(const Model& model, std::int32_t number) {
    const std::string_view name = default_group(model, number);
    std::int32_t first = 0;
    while (!equal_ignoring_case(default_group(model, first), name)) ++first;
    return first;
}

std::int32_t with_group(Model& model, std::int32_t number, const GroupName& group) {
    auto groups = groups_of_number(model, number);
    std::erase_if(groups, [&](const GroupName& other) { return equal_ignoring_case(other.slot, group.slot); });
    if (!group.name.empty()) {
        // The default slot stands before the others.
        const auto key = [](const GroupName& g) { return is_default(g.slot) ? std::string() : lower_case(g.slot); };
        groups.insert(std::ranges::upper_bound(groups, key(group), {}, key), group);
    }
    return number_of_entry(model, entry_of_groups(groups));
}

std::int32_t with_group(Model& model, std::int32_t number, std::string_view text) {
    return with_group(model, number, group_name(text));
}

std::int32_t without_group(Model& model, std::int32_t number, std::string_view text) {
    if (!GroupMembers(model, text).contains(number)) return number;
    const GroupName group = group_name(text);
    const bool has_slot = group.name.size() < text.size();
    auto groups = groups_of_number(model, number);
    std::erase_if(groups, [&](const GroupName& other) {
        return equal_ignoring_case(other.name, group.name) &&
               (!has_slot || equal_ignoring_case(other.slot, group.slot));
    });
    return number_of_entry(model, entry_of_groups(groups));
}

GroupMembers::GroupMembers(const Model& model, std::string_view text) : member_(model.group_names.size(), 0) {
    const GroupName wanted = group_name(text);
    const auto mark = [&](bool all_slots) {
        for (std::size_t number = 0; number < member_.size(); ++number)
            for (const GroupName& group : groups_of_entry(model.group_names[number]))
                if (equal_ignoring_case(group.name, wanted.name) &&
                    (all_slots || equal_ignoring_case(group.slot, wanted.slot)))
                    member_[number] = any_ = true;
    };
    const bool has_slot = wanted.name.size() < text.size();
    const bool all_slots = has_slot && equal_ignoring_case(wanted.slot, "any");
    mark(all_slots);
    if (!any_ && !has_slot) mark(true);
}

std::vector<std::string> all_groups(const Model& model) {
    std::vector<std::string> all;
    for (const std::string& entry : model.group_names)
        for (const GroupName& group : groups_of_entry(entry)) {
            std::string text = is_default(group.slot) ? group.name : fmt::format("{}={}", group.slot, group.name);
            const bool known =
                std::ranges::any_of(all, [&](const std::string& other) { return equal_ignoring_case(text, other); });
            if (!known) all.push_back(std::move(text));
        }
    return all;
}

Column<std::int32_t>* own_groups(Model& model, ObjectKind kind) {
    const auto groups = info_of(kind).groups;
    return groups == nullptr ? nullptr : &groups(model);
}

const Column<std::int32_t>* own_groups(const Model& model, ObjectKind kind) {
    return own_groups(const_cast<Model&>(model), kind);
}

std::int32_t group_of(const Model& model, ObjectKind kind, Row row) {
    if (kind == ObjectKind::contact) return model.contacts.group[row];
    if (kind == ObjectKind::sub_contact) {
        const std::int32_t own = model.sub_contacts.group[row];
        return own != 0 ? own : model.contacts.group[model.sub_contacts.contact[row]];
    }
    if (kind == ObjectKind::triangle) return group_of(model, ObjectKind::face, model.triangles.face[row]);
    const auto* own = own_groups(model, kind);
    if (own != nullptr && (*own)[row] != 0) return (*own)[row];
    const Row block = block_of(model, kind, row);
    return block == no_row ? 0 : model.blocks.group[block];
}

std::string_view default_group_of(const Model& model, ObjectKind kind, Row row) {
    const std::string_view own = default_group(model, group_of(model, kind, row));
    if (!own.empty() || kind == ObjectKind::contact) return own;
    if (kind == ObjectKind::sub_contact)
        return default_group(model, model.contacts.group[model.sub_contacts.contact[row]]);
    const Row block = block_of(model, kind, row);
    return block == no_row ? own : default_group(model, model.blocks.group[block]);
}

} // namespace kaya
