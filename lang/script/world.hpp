// What the script languages see of a model: tables of named fields. Implemented in src/commands,
// so that the language never sees a contact and the engine never sees Lua.
#pragma once

#include "base/vector.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kaya::script {

/// A handle that survives changes of the table: of a deleted object it says so, it never crashes.
struct Handle {
    std::int32_t table = 0;
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; ///< 0: null
    std::uint8_t model = 0;       ///< World::model_number when it was given out
    bool operator==(const Handle&) const = default;
};

/// nil, truth, integer, real, text, vector, handle.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3, Handle>;

struct FieldInfo {
    std::string_view name;    ///< "normal_force"
    std::string_view classic; ///< "cx_nforce", or ""
    std::string_view unit;
    std::string_view help;
    bool writable = false;
};

struct TableInfo {
    std::string_view name; ///< "contact": Lua sees contact.normal_force, and iterates contacts()
    std::vector<FieldInfo> fields;
};

/// A list that FISH walks: block_head / b_next, contact_head / c_next, c_cx / cx_next, gp_next, z_next.
class World {
public:
    virtual ~World() = default;

    virtual const std::vector<TableInfo>& tables() const = 0;

    /// Field number is the index into TableInfo::fields. Throws Diagnostic (object deleted, wrong type).
    virtual Value get(Handle object, std::size_t field) = 0;
    virtual void set(Handle object, std::size_t field, const Value& value) = 0;

    /// Number of objects, and the i-th (from 0) in the order of FISH's next links.
    virtual std::size_t count(std::int32_t table) = 0;
    virtual Handle at(std::int32_t table, std::size_t index) = 0;
    virtual bool alive(Handle object) = 0;
    /// Next object in the list that the handle walks in (null at the end).
    virtual Handle next(Handle object) = 0;
    /// First child: the sub-contacts of a contact, gridpoints and zones of a block.
    virtual Handle first_child(Handle parent, std::int32_t child_table) = 0;
    virtual Handle nearest(std::int32_t table, const Vec3& place) = 0;
    /// The i-th gridpoint (from 0) of a zone or a face. Throws Diagnostic when there is none.
    virtual Handle gridpoint_of(Handle object, std::size_t index) = 0;

    /// The next contact of the same block in the list of contacts: of its first (1) or second (2) block.
    virtual Handle next_of_block(Handle contact, int side) = 0;

    /// Whether there is a range of that name.
    virtual bool has_range(const std::string& name) = 0;
    /// Whether an object, or a place, is in a named range. Throws Diagnostic when there is no such range, or when the
    /// range asks for more than a place.
    virtual bool in_range(const std::string& name, Handle object) = 0;
    virtual bool in_range(const std::string& name, const Vec3& place) = 0;

    /// A property by its name: of the joint model of a contact or sub-contact, of the material of a zone.
    /// Of a sub-contact also what its joint model remembers (history variables).
    virtual Value property(Handle object, const std::string& name) = 0;
    /// A history variable of a sub-contact. Throws Diagnostic for anything else.
    virtual void set_property(Handle object, const std::string& name, double value) = 0;
    /// What the command `prop` has given to the material of that number, by the word of `prop`; 0 when nothing.
    virtual double material_value(std::int64_t number, const std::string& word) = 0;
    virtual void set_material_value(std::int64_t number, const std::string& word, double value) = 0;

    /// Quantities of the whole model: time, cycle, unbalanced force, ... by name or classic FISH name.
    virtual const std::vector<FieldInfo>& globals() const = 0;
    virtual Value get_global(std::size_t index) = 0;
    virtual void set_global(std::size_t index, const Value& value) = 0;

    /// Sum, minimum, maximum, mean of one numeric field over all rows, without a script loop.
    virtual double reduce(std::int32_t table, std::size_t field, std::string_view how) = 0;

    /// Samples of a history, by its label or number; nothing when there is none.
    struct Samples {
        std::span<const double> values, times; ///< as long as nothing cycles and no history comes or goes
    };
    virtual std::optional<Samples> history(const std::string& name) = 0;

    /// Runs command lines (`command ... endcommand`, Lua's command[[...]]). What they print goes to the user, or comes back
    /// when it is `caught`.
    virtual std::string command(const std::string& text, const std::string& chunk, int line, bool caught) = 0;

    std::string stopped_by; ///< why the last command that cycled came to its end, in words; "" before the first

    /// Counts models that were thrown away while a script ran, modulo what a handle can hold: handles of others are dead.
    std::uint8_t model_number = 0;
    static constexpr unsigned model_numbers = 128;
};

} // namespace kaya::script
