// A small world of artificial rows for the tests of scripts: contacts with sub-contacts, and blocks.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/script/scripts/scripts.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kaya::script::test {

struct FakeCommand {
    std::string text, chunk;
    int line;
};

class FakeWorld : public World {
public:
    static constexpr std::int32_t block = 0, contact = 1, sub_contact = 2;

    explicit FakeWorld(std::size_t contacts = 2, std::size_t per_contact = 4) : per_contact_(per_contact) {
        tables_ = {
            {"block",
             {{"id", "b_id", "-", "number of the block", false},
              {"velocity", "b_vel", "velocity", "of the centroid", true},
              {"volume", "b_vol", "volume", "", false}},
             "b",
             "block",
             false,
             true},
            {"contact",
             {{"id", "c_id", "-", "", false},
              {"block", "c_b1", "-", "first block", false},
              {"normal", "c_n", "-", "unit normal", false}},
             "c",
             "block.contact",
             true,
             true},
            {"sub_contact",
             {{"normal_force", "cx_nforce", "force", "compression positive", true},
              {"x_shear_force", "cx_xsforce", "force", "", false},
              {"normal_displacement", "cx_ndis", "length", "", false},
              {"x_shear_displacement", "cx_xsdis", "length", "", false},
              {"model", "cx_model", "-", "", false}},
             "cx",
             "block.subcontact",
             true,
             true},
        };
        using enum RelationInfo::Form;
        relations_ = {{first, -1, block, "block_head", "block.head", "block.list"},
                      {first, -1, contact, "contact_head", "block.contact.head", "block.contact.list"},
                      {first, contact, sub_contact, "c_cx", "", "block.contact.subcontactlist"},
                      {next, block, block, "b_next", "block.next"},
                      {next, contact, contact, "c_next", "block.contact.next"},
                      {next, sub_contact, sub_contact, "cx_next", "block.subcontact.next"},
                      {other, contact, contact, "c_link1", ""},
                      {nearest, -1, block},
                      {nearest, -1, contact},
                      {nearest, -1, sub_contact}};
        globals_ = {{"time", "time", "time", "", false},
                    {"cycle", "cycle", "-", "", false},
                    {"damping", "damp_local", "-", "", true},
                    {"unbalanced_force", "unbal", "force", "", false}};
        contacts_ = contacts;
        for (std::size_t i = 0; i < contacts * per_contact; ++i) {
            const double t = 0.1 * static_cast<double>(i + 1);
            normal_force.push_back(std::sin(t) + 2);
            shear_force.push_back(std::cos(3 * t));
            normal_displacement.push_back(-1e-4 * t / 3);
            shear_displacement.push_back(1e-3 * t / 7);
        }
    }

    const std::vector<TableInfo>& tables() const override { return tables_; }
    const std::vector<FieldInfo>& globals() const override { return globals_; }

    const std::vector<RelationInfo>& relations() const override { return relations_; }

    Value get(const Handle& object, std::size_t field) override {
        if (object.table == whole_model.table) return global(field);
        check(object);
        const std::size_t row = object.slot;
        if (object.table == block) {
            if (field == 0) return static_cast<std::int64_t>(row + 1);
            if (field == 1) return velocity;
            return 2.5;
        }
        if (object.table == contact) {
            if (field == 0) return static_cast<std::int64_t>(row + 1);
            if (field == 1) return row == 0 ? Handle{block, 0, 1} : Handle{block, 0, 0};
            return Vec3(0, 0, 1);
        }
        switch (field) {
        case 0: return normal_force[row];
        case 1: return shear_force[row];
        case 2: return normal_displacement[row];
        case 3: return shear_displacement[row];
        default: return std::string("mohr");
        }
    }

    void set(const Handle& object, std::size_t field, const Value& value) override {
        if (object.table == whole_model.table) {
            damping = number(value);
            return;
        }
        check(object);
        if (object.table == block) {
            velocity = taken<Vec3>(value);
            return;
        }
        require_field(field == 0);
        normal_force[object.slot] = number(value);
    }

    std::size_t count(std::int32_t table) override {
        return table == block ? 1 : table == contact ? contacts_ : normal_force.size();
    }
    Handle at(std::int32_t table, std::size_t index) override {
        return {table, static_cast<std::uint32_t>(index), generation, model_number};
    }
    bool alive(const Handle& object) override {
        return object.generation == generation && object.model == model_number;
    }
    Handle relate(std::size_t relation, const Handle& object, const At& at) override {
        const RelationInfo& info = relations_[relation];
        if (info.form == RelationInfo::Form::nearest) {
            asked = std::get<Vec3>(at);
            return {info.to, 0, generation};
        }
        if (info.from < 0) return count(info.to) > 0 ? this->at(info.to, 0) : Handle{info.to};
        check(object);
        if (info.form == RelationInfo::Form::first)
            return {info.to, static_cast<std::uint32_t>(object.slot * per_contact_), generation};
        if (info.form == RelationInfo::Form::other) return {info.to, 1, generation};
        const std::size_t row = object.slot + 1;
        const bool ends = object.table == sub_contact ? row % per_contact_ == 0 : row >= count(object.table);
        return {object.table, static_cast<std::uint32_t>(row), ends ? 0 : generation};
    }
    bool has_range(const std::string& name) override { return name == "box"; }
    bool in_range(const std::string&, const std::variant<Handle, Vec3>& what) override {
        const auto* object = std::get_if<Handle>(&what);
        return object != nullptr ? object->slot == 0 : std::get<Vec3>(what)[0] < 1;
    }
    void set_property(const Owner& owner, const std::string& name, double value) override {
        if (const auto* material = std::get_if<Material>(&owner)) materials[{material->number, name}] = value;
        else properties_set.emplace_back(name, value);
    }
    std::vector<std::pair<std::string, double>> properties_set;
    std::optional<Samples> history(const std::string& name) override {
        if (name != "tau") return std::nullopt;
        return Samples{tau, tau_times};
    }
    Value property(const Owner& owner, const std::string& name) override {
        if (const auto* material = std::get_if<Material>(&owner)) return materials[{material->number, name}];
        check(std::get<Handle>(owner));
        return name + " of it";
    }
    double reduce(std::int32_t, std::size_t, std::string_view how) override {
        double sum = 0;
        for (const double force : normal_force) sum += force;
        return how == "sum" ? sum : sum / static_cast<double>(normal_force.size());
    }
    std::string command(const std::string& text, const std::string& chunk, int line, bool caught) override {
        commands.push_back({text, chunk, line});
        if (text.starts_with("solve")) stopped_by = "100 cycles";
        if (on_command) on_command(text);
        return caught ? "printed\n" : "";
    }
    std::vector<double> tau{1, 5, 3}, tau_times{0.1, 0.2, 0.3};

    std::uint32_t generation = 1;
    Vec3 velocity = Vec3::Zero(), asked = Vec3::Zero();
    double damping = 0.8;
    std::vector<double> normal_force, shear_force, normal_displacement, shear_displacement;
    std::vector<FakeCommand> commands;
    std::map<std::pair<std::int64_t, std::string>, double> materials;
    std::function<void(const std::string&)> on_command;

private:
    Value global(std::size_t index) const {
        if (index == 0) return 0.25;
        if (index == 1) return std::int64_t{100};
        return index == 2 ? damping : 1.5;
    }
    static void require_field(bool right) {
        if (!right) throw Diagnostic("the test world has only one writable field", {}, Fault::own);
    }
    template <class T> static const T& taken(const Value& value) {
        if (const T* given = std::get_if<T>(&value)) return *given;
        throw Diagnostic("the field cannot take a value of this kind", {}, Fault::run);
    }
    static double number(const Value& value) {
        if (const auto* truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
        if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
        return taken<double>(value);
    }
    void check(const Handle& object) const {
        if (object.generation != generation) throw Diagnostic("this object no longer exists", {}, Fault::run);
    }

    std::vector<TableInfo> tables_;
    std::vector<FieldInfo> globals_;
    std::vector<RelationInfo> relations_;
    std::size_t contacts_, per_contact_;
};

/// The text as a deck, and the place of one of its lines.
inline Place deck(const std::string& text, int line = 1) {
    auto source = std::make_shared<SourceText>();
    source->name = "test.3ddat";
    std::string rest;
    for (const char c : text) {
        if (c == '\n') {
            source->lines.push_back(rest);
            rest.clear();
        } else {
            rest += c;
        }
    }
    if (!rest.empty()) source->lines.push_back(rest);
    return {source, line, 1, 1};
}

/// Scripts with a separate world; their output is stored.
struct Stage {
    explicit Stage(std::size_t contacts = 2, std::size_t per_contact = 4, Options options = {})
        : world(contacts, per_contact), scripts(world, std::move(options)) {
        scripts.on_print([this](const std::string& line) { printed.push_back(line); });
    }

    void fish(const std::string& text) { scripts.define_fish(text, deck(text)); }
    void lua(const std::string& text) { scripts.run_lua(text, deck(text)); }
    Value value(const std::string& expression) { return scripts.value(expression); }
    double number(const std::string& expression) { return scripts.number(expression); }
    std::string text(const std::string& expression) { return std::get<std::string>(scripts.value(expression)); }

    FakeWorld world;
    Scripts scripts;
    std::vector<std::string> printed;
};

/// The message of the failure of `action`; "no error" if it does not fail.
template <class Action> std::string message_of(Action action) {
    try {
        action();
    } catch (const Diagnostic& diagnostic) { return render(diagnostic); }
    return "no error";
}

} // namespace kaya::script::test
