#include "lang/script/value_text.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

struct Text {
    const World* world;

    std::string operator()(std::monostate) const { return "nil"; }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{:g}", number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const Vec3& v) const { return fmt::format("({:g},{:g},{:g})", v[0], v[1], v[2]); }
    std::string operator()(const Handle& handle) const {
        if (handle.generation == 0) return "null";
        const bool known =
            world && handle.table >= 0 && handle.table < static_cast<std::int32_t>(world->tables().size());
        return fmt::format("{} #{}", known ? world->tables()[handle.table].name : "object", handle.slot);
    }
};

} // namespace

std::string to_text(const Value& value, const World* world) { return std::visit(Text{world}, value); }

std::string_view type_name(const Value& value) {
    static constexpr std::array<std::string_view, 7> names{"nothing", "truth",  "integer", "number",
                                                           "text",    "vector", "pointer"};
    return names[value.index()];
}

} // namespace kaya::script
