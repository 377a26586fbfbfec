// The view that script languages have of a model: tables of named fields. Implemented in src/commands, so that the language never sees a
// contact and the engine never sees Lua.
#pragma once

#include "base/vector.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kaya::script {

/// A handle that survives changes of the table: access to a deleted object raises an error and never crashes.
struct Handle {
    std::int32_t table = 0;
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; ///< 0: null
    std::uint8_t model = 0;       ///< World::model_number when it was given out
    bool operator==(const Handle&) const = default;
};

struct Compound;

/// nil, truth, integer, real, text, vector, handle; list, map, tensor, matrix, structure.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3, Handle,
                           std::shared_ptr<const Compound>>;

/// A value of FISH that holds others.
struct Compound {
    std::string kind;           ///< "list", "map", "tensor", "matrix", "structure"
    std::vector<Value> keys;    ///< of a map; of a matrix the number of its columns
    std::vector<Value> members; ///< of a tensor xx, yy, zz, xy, xz, yz
    std::string text;           ///< as FISH prints it
};

struct FieldInfo {
    std::string_view name;    ///< "normal_force"
    std::string_view classic; ///< "cx_nforce", or ""
    std::string_view unit;
    std::string_view help;
    bool writable = false;
    std::string_view modern = {}; ///< "block.subcontact.force.norm", or ""
};

struct TableInfo {
    std::string_view name; ///< "contact": Lua sees contact.normal_force, and iterates contacts()
    std::vector<FieldInfo> fields;
    /// First part of the FISH names that any kind of object has: "cx" in cx_near, cx_extra; "" when there are none.
    std::string_view classic = {}, modern = {};
    bool has_properties = false; ///< cx_prop
    bool has_spares = false;     ///< cx_ispare, cx_rspare
};

/// From an object, or from the whole model, to another object.
struct RelationInfo {
    enum class Form {
        first,    ///< of a list of objects
        next,     ///< in the list of the object
        other,    ///< of one object to another
        numbered, ///< one of several, by a number from 0
        nearest   ///< to a place
    };
    Form form = Form::first;
    std::int32_t from = -1; ///< number of a table; -1: of the whole model
    std::int32_t to = -1;
    std::string_view classic = {}, modern = {}; ///< names in FISH; "" when there is none
    std::string_view array = {};                ///< of `first`: the name of all objects of the list at once
};

/// Tables of objects with named fields, and relations between them.
class World {
public:
    virtual ~World() = default;

    virtual const std::vector<TableInfo>& tables() const = 0;
    /// Quantities of the whole model: time, cycle, unbalanced force, ... by name or classic FISH name.
    virtual const std::vector<FieldInfo>& globals() const = 0;
    virtual const std::vector<RelationInfo>& relations() const = 0;

    /// The table of whole_model has the fields of globals().
    static constexpr Handle whole_model{.table = -1};

    /// Field number is the index into TableInfo::fields. Throws Diagnostic (object deleted, wrong type).
    virtual Value get(const Handle& object, std::size_t field) = 0;
    virtual void set(const Handle& object, std::size_t field, const Value& value) = 0;

    /// The argument of `numbered` and `nearest`.
    using At = std::variant<std::monostate, std::size_t, Vec3>;
    /// The relation is the index into relations(); null where there is no object. Throws Diagnostic (object deleted, no such number).
    virtual Handle relate(std::size_t relation, const Handle& object, const At& at = {}) = 0;

    /// Number of objects, and the i-th (from 0) in the order of FISH's next links.
    virtual std::size_t count(std::int32_t table) = 0;
    virtual Handle at(std::int32_t table, std::size_t index) = 0;
    virtual bool alive(const Handle& object) = 0;

    /// Whether there is a range of that name.
    virtual bool has_range(const std::string& name) = 0;
    /// Whether an object, or a place, is in a named range. Throws Diagnostic when there is no such range, or when the range needs more than
    /// a place.
    virtual bool in_range(const std::string& name, const std::variant<Handle, Vec3>& what) = 0;

    /// Whether an object is in a group, itself or through its block: `name`, or `slot=name`.
    virtual bool in_group(const Handle&, const std::string&) { return false; }

    /// The material of that number, by the words of the command `prop`.
    struct Material {
        std::int64_t number;
    };
    using Owner = std::variant<Handle, Material>;
    /// A property by its name: of the joint model of a contact or sub-contact, of the material of a zone. For a sub-contact also the
    /// history variables of its joint model. 0 for a material whose property has not been given.
    virtual Value property(const Owner& owner, const std::string& name) = 0;
    /// Sets a history variable of a sub-contact, or a property of a material. Throws Diagnostic for anything else.
    virtual void set_property(const Owner& owner, const std::string& name, double value) = 0;

    /// Sum, minimum, maximum, mean of one numeric field over all rows, without a script loop.
    virtual double reduce(std::int32_t table, std::size_t field, std::string_view how) = 0;

    /// Samples of a history, by its label or number; nothing when there is none.
    struct Samples {
        std::span<const double> values, times; ///< valid until a cycle runs or a history is added or removed
    };
    virtual std::optional<Samples> history(const std::string& name) = 0;

    /// Runs command lines (`command ... endcommand`, Lua's command[[...]]). Their output goes to the user, or is returned when it is
    /// `caught`.
    virtual std::string command(const std::string& text, const std::string& chunk, int line, bool caught) = 0;

    std::string stopped_by; ///< reason, in words, why the last command that cycled ended; "" before the first

    /// Counts models that were replaced while a script ran, modulo the range of a handle: handles of other models are stale.
    std::uint8_t model_number = 0;
    static constexpr unsigned model_numbers = 128;
};

} // namespace kaya::script
