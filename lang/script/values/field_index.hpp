// Fast look-up of the number of a field by its name: Lua keeps one copy of each short string, so the address of the characters identifies
// it.
#pragma once

#include "lang/script/values/world.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::script {

enum class MemberKind : std::uint8_t { none, field, method, alive };

struct Member {
    const char* address = nullptr;
    MemberKind kind = MemberKind::none;
    std::uint32_t number = 0; ///< of the field, or of the child table
};

/// Members of one kind of object; open addressing over the addresses of their names.
class MemberMap {
public:
    void add(const Member& member);

    const Member* find(const char* address) const {
        if (slots_.empty()) return nullptr;
        for (std::size_t i = position(address);; i = (i + 1) & (slots_.size() - 1)) {
            if (slots_[i].address == address) return &slots_[i];
            if (!slots_[i].address) return nullptr;
        }
    }

private:
    std::size_t position(const char* address) const {
        return (reinterpret_cast<std::uintptr_t>(address) >> 4) * 0x9E3779B97F4A7C15u >> shift_;
    }
    void grow();

    std::vector<Member> slots_;
    std::size_t used_ = 0;
    int shift_ = 64;
};

struct FieldIndex {
    std::vector<MemberMap> tables; ///< by table number
    MemberMap globals;
};

/// Number of the table with this name; -1 when the world has none.
std::int32_t find_table(const World& world, std::string_view name);
/// Number of the first relation of that form between two tables; -1 when the world has none.
std::ptrdiff_t find_relation(const World& world, RelationInfo::Form form, std::int32_t from, std::int32_t to);
/// Number of the list of objects of one table that an object of another has. Throws Diagnostic when it has none.
std::size_t list_of_parts(const World& world, std::int32_t from, std::int32_t to);
/// Number of the field with this name, or its classic name; -1 when the list has none.
std::ptrdiff_t find_field(const std::vector<FieldInfo>& fields, std::string_view name);

/// "a contact has no field 'nforce'", with the nearest name as hint.
[[noreturn]] void fail_unknown_field(std::string_view owner, const std::vector<FieldInfo>& fields,
                                     std::string_view name);

} // namespace kaya::script
