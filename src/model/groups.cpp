#include "model/groups.hpp"

#include "base/lower_case.hpp"

#include <algorithm>

namespace kaya {

std::int32_t find_group(const Model& model, std::string_view name) {
    const auto& names = model.group_names;
    const auto found = std::find_if(names.begin(), names.end(),
                                    [name](const std::string& other) { return equal_ignoring_case(name, other); });
    return found == names.end() ? -1 : static_cast<std::int32_t>(found - names.begin());
}

std::int32_t make_group(Model& model, std::string_view name) {
    const std::int32_t group = find_group(model, name);
    if (group >= 0) return group;
    model.group_names.emplace_back(name);
    return static_cast<std::int32_t>(model.group_names.size() - 1);
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
    if (kind == ObjectKind::sub_contact) return model.contacts.group[model.sub_contacts.contact[row]];
    if (kind == ObjectKind::triangle) return group_of(model, ObjectKind::face, model.triangles.face[row]);
    const auto* own = own_groups(model, kind);
    if (own != nullptr && (*own)[row] != 0) return (*own)[row];
    const Row block = block_of(model, kind, row);
    return block == no_row ? 0 : model.blocks.group[block];
}

} // namespace kaya
