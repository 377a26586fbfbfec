#include "lang/script/values/field_index.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::script {

void MemberMap::add(const Member& member) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    std::size_t i = position(member.address);
    while (slots_[i].address && slots_[i].address != member.address) i = (i + 1) & (slots_.size() - 1);
    if (!slots_[i].address) ++used_;
    slots_[i] = member;
}

void MemberMap::grow() {
    const std::vector<Member> old = std::move(slots_);
    const std::size_t size = old.empty() ? 16 : 2 * old.size();
    slots_.assign(size, {});
    used_ = 0;
    shift_ = 64;
    for (std::size_t n = size; n > 1; n /= 2) --shift_;
    for (const auto& member : old)
        if (member.address) add(member);
}

std::int32_t find_table(const World& world, std::string_view name) {
    const auto& tables = world.tables();
    for (std::size_t i = 0; i < tables.size(); ++i)
        if (tables[i].name == name) return static_cast<std::int32_t>(i);
    return -1;
}

std::ptrdiff_t find_relation(const World& world, RelationInfo::Form form, std::int32_t from, std::int32_t to) {
    const auto& relations = world.relations();
    for (std::size_t i = 0; i < relations.size(); ++i)
        if (relations[i].form == form && relations[i].from == from && relations[i].to == to)
            return static_cast<std::ptrdiff_t>(i);
    return -1;
}

std::size_t list_of_parts(const World& world, std::int32_t from, std::int32_t to) {
    const auto relation = find_relation(world, RelationInfo::Form::first, from, to);
    if (relation >= 0) return static_cast<std::size_t>(relation);
    const auto name = [&](std::int32_t table) { return world.tables()[static_cast<std::size_t>(table)].name; };
    throw Diagnostic(fmt::format("a {} has no list of {}s", name(from), name(to)), {}, Fault::run);
}

std::ptrdiff_t find_field(const std::vector<FieldInfo>& fields, std::string_view name) {
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].name == name || (!name.empty() && fields[i].classic == name))
            return static_cast<std::ptrdiff_t>(i);
    return -1;
}

namespace {

struct OtherName {
    std::string_view other, name;
};

/// What other programs call a field, where the words are not alike.
constexpr OtherName other_names[] = {
    {"centroid", "position"}, {"centre", "position"},
    {"center", "position"},   {"pos", "position"},
    {"location", "position"}, {"id", "number"},
    {"name", "group"},        {"disp", "displacement"},
    {"vel", "velocity"},      {"unbalanced_force", "force"},
};

} // namespace

void fail_unknown_field(std::string_view owner, const std::vector<FieldInfo>& fields, std::string_view name) {
    std::vector<std::string_view> names;
    for (const auto& field : fields) names.push_back(field.name);
    for (const auto& field : fields)
        if (!field.classic.empty() && field.classic == name)
            throw Diagnostic(fmt::format("{} has no field '{}'", owner, name),
                             fmt::format("in Lua it is called '{}'", field.name), Fault::run);
    std::string_view meant = did_you_mean(name, names);
    for (const auto& [other, ours] : other_names)
        if (other == name && std::find(names.begin(), names.end(), ours) != names.end()) meant = ours;
    throw Diagnostic(fmt::format("{} has no field '{}'", owner, name),
                     meant.empty() ? std::string() : fmt::format("did you mean '{}'?", meant), Fault::run);
}

} // namespace kaya::script
