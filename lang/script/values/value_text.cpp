#include "lang/script/values/value_text.hpp"

#include "lang/script/values/field_index.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

struct Text {
    World* world;

    std::string operator()(std::monostate) const { return "nil"; }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{:g}", number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const Vec3& v) const { return fmt::format("({:g},{:g},{:g})", v[0], v[1], v[2]); }
    std::string operator()(const Handle& handle) const {
        if (handle.generation == 0) return "null";
        return world ? handle_text(*world, handle) : "object";
    }
    std::string operator()(const std::shared_ptr<const Compound>& compound) const { return compound->text; }
};

bool is_known(const World& world, const Handle& handle) {
    return handle.table >= 0 && handle.table < static_cast<std::int32_t>(world.tables().size());
}

} // namespace

std::int64_t handle_number(World& world, const Handle& handle) {
    if (handle.generation == 0 || !is_known(world, handle) || !world.alive(handle)) return 0;
    const auto id = find_field(world.tables()[static_cast<std::size_t>(handle.table)].fields, "id");
    if (id < 0) return static_cast<std::int64_t>(handle.slot) + 1; // corners have no numbers
    const Value number = world.get(handle, static_cast<std::size_t>(id));
    const auto* whole = std::get_if<std::int64_t>(&number);
    return whole ? *whole : 0;
}

std::string handle_text(World& world, const Handle& handle) {
    if (handle.generation == 0) return "null";
    if (!is_known(world, handle)) return "object";
    const auto name = world.tables()[static_cast<std::size_t>(handle.table)].name;
    const auto number = handle_number(world, handle);
    return number > 0 ? fmt::format("{} {}", name, number) : fmt::format("{} (deleted)", name);
}

std::string to_text(const Value& value, World* world) { return std::visit(Text{world}, value); }

std::string_view type_name(const Value& value) {
    static constexpr std::array<std::string_view, 7> names{"nothing", "truth",  "integer", "number",
                                                           "text",    "vector", "pointer"};
    if (const auto* compound = std::get_if<std::shared_ptr<const Compound>>(&value)) return (*compound)->kind;
    return names[value.index()];
}

} // namespace kaya::script
