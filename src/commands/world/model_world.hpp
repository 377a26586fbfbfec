// The model as scripts see it: tables of named fields, and handles that know when their object was deleted.
#pragma once

#include "laws/joint_model.hpp"
#include "lang/commands/range.hpp"
#include "lang/script/values/world.hpp"
#include "model/fields/field.hpp"
#include "model/kinds/selection.hpp"

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace kaya {

/// The number of a kind among ModelWorld::tables(); of the whole model that of World::whole_model.
constexpr std::int32_t script_table(ObjectKind kind) {
    return kind == ObjectKind::global ? script::World::whole_model.table : static_cast<std::int32_t>(kind);
}

/// Services of the session for scripts, beyond the model.
class WorldHost {
public:
    virtual ~WorldHost() = default;
    /// Runs `command`; returns the printed text if it is to be captured.
    virtual std::string run_text(const std::string& text, const std::string& chunk, int line, bool caught) = 0;
    virtual void note(const std::string& message) = 0;   ///< said once
    virtual void warn_once_here(Diagnostic warning) = 0; ///< once for the command that runs
    /// The phrase of a named range and its test; null when there is none.
    virtual const lang::RangePhrase* range_phrase(const std::string& name) = 0;
    virtual RangeTest range_test_of(ObjectKind kind, const lang::RangePhrase& range) = 0;
    virtual bool asks_for_objects(const lang::RangePhrase& range) = 0; ///< for more than a place
};

class ModelWorld : public script::World {
public:
    ModelWorld(Model& model, JointRegistry& joints, WorldHost& host);

    const std::vector<script::TableInfo>& tables() const override { return infos_; }
    const std::vector<script::FieldInfo>& globals() const override { return global_infos_; }
    const std::vector<script::RelationInfo>& relations() const override { return relation_infos_; }
    script::Value get(const script::Handle& object, std::size_t field) override;
    void set(const script::Handle& object, std::size_t field, const script::Value& value) override;
    script::Handle relate(std::size_t relation, const script::Handle& object, const At& at) override;
    std::size_t count(std::int32_t table) override { return count_of(model_, static_cast<ObjectKind>(table)); }
    script::Handle at(std::int32_t table, std::size_t index) override;
    bool alive(const script::Handle& object) override { return row_of(object) != no_row; }
    bool has_range(const std::string& name) override { return host_.range_phrase(name) != nullptr; }
    bool in_range(const std::string& name, const std::variant<script::Handle, Vec3>& what) override;
    bool in_group(const script::Handle& object, const std::string& group) override;
    script::Value property(const Owner& owner, const std::string& name) override;
    void set_property(const Owner& owner, const std::string& name, double value) override;
    double reduce(std::int32_t table, std::size_t field, std::string_view how) override;
    std::optional<Samples> history(const std::string& name) override;
    std::string command(const std::string& text, const std::string& chunk, int line, bool caught) override;

    /// Tests of named ranges are cached until a command or a cycle has run.
    void forget_ranges() { range_tests_.clear(); }

    /// The row of an object; throws Diagnostic when it was deleted.
    Row living_row(const script::Handle& object) const;
    /// The object nearest to a place, null when there is none; warns where it is far away.
    script::Handle nearest(ObjectKind kind, const Vec3& place);

private:
    /// The history variable of that name, of the joint model of a sub-contact; null when there is none.
    double* history_value(Row sub_contact, const std::string& name);
    /// An own value of a sub-contact by name: history, a field, a property of its object.
    std::optional<double> own_value(Row sub_contact, const std::string& name);
    /// False when it has nothing of that name that can be set.
    bool set_own_value(Row sub_contact, const std::string& name, double value);
    Row row_of(const script::Handle& object) const; ///< no_row when it was deleted
    /// Parts of a block are identified by the number of the block's shape and an index in it: changes of other blocks do not matter.
    Row block_of_shape(std::uint32_t shape) const;
    script::Handle handle(ObjectKind kind, Row row) const;
    script::Value script_value(const FieldValue& value) const;
    script::Value object_property(const script::Handle& object, const std::string& name);
    void add_relations();

    const RangeTest& test_of(const std::string& range, ObjectKind kind);

    Model& model_;
    JointRegistry& joints_;
    WorldHost& host_;
    std::map<std::pair<std::string, ObjectKind>, RangeTest> range_tests_;
    std::int64_t cycle_of_tests_ = 0;
    std::uint64_t rows_of_tests_ = 0;                              ///< Stale::rows_revision
    mutable std::unordered_map<std::int32_t, Row> block_of_shape_; ///< of shapes below this number
    mutable std::int32_t next_known_shape_ = 0;
    mutable std::uint64_t known_rows_ = 0; ///< Stale::rows_revision
    std::vector<script::TableInfo> infos_;
    std::vector<std::vector<const Field*>> fields_; ///< of each table, in the order of its FieldInfo
    std::vector<script::FieldInfo> global_infos_;
    std::vector<const Field*> global_fields_;
    std::vector<script::RelationInfo> relation_infos_;
    std::vector<const Relation*> relations_; ///< of each RelationInfo; null: to the nearest
};

} // namespace kaya
