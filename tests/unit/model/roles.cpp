// Columns are treated by their roles.
#include "model/edit/links.hpp"

#include "model/edit/build.hpp"
#include "model/whole/consistency.hpp"
#include "model/edit/copy_blocks.hpp"
#include "model/edit/excavation.hpp"
#include "model/edit/plain.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>

using namespace kaya;
using kaya::test::hand_made_model;

namespace {

/// Sets every number of the columns of these roles to a different, nonzero value.
template <class TableType> void mark(TableType& table, std::initializer_list<Role> roles) {
    int count = 0;
    table.columns([&]<class T>(const std::string&, Column<T>& column, Role role) {
        if constexpr (requires { Plain<T>::count; })
            for (const Role wanted : roles)
                if (role == wanted)
                    for (std::size_t k = 0; k < column.size() * Plain<T>::count; ++k)
                        scalars(column)[k] = static_cast<typename Plain<T>::scalar>(1 + ++count % 100);
    });
}

/// The bytes of a row's columns, by name, for accepted roles.
template <class TableType>
std::map<std::string, std::string> bytes_of(TableType& table, Row row, const std::function<bool(Role)>& passes) {
    std::map<std::string, std::string> all;
    table.columns([&]<class T>(const std::string& name, Column<T>& column, Role role) {
        if constexpr (requires { Plain<T>::count; })
            if (passes(role))
                all[name] = std::string(reinterpret_cast<const char*>(scalars(column[static_cast<std::size_t>(row)])),
                                        sizeof(T));
    });
    return all;
}

bool is_zero(const std::string& bytes) { return bytes.find_first_not_of('\0') == std::string::npos; }

bool of_the_run(Role role) {
    return role == Role::load || role == Role::motion || role == Role::displacement || role == Role::state;
}

} // namespace

TEST(Roles, RefilledBlocksLoseValuesOfTheRunAndKeepTheRest) {
    Model model = hand_made_model();
    model.zones.keep_history(3);
    const auto marked = {Role::load, Role::motion, Role::displacement, Role::state, Role::condition};
    mark(model.blocks, marked);
    mark(model.zones, marked);
    mark(model.gridpoints, {Role::load, Role::motion, Role::displacement, Role::state});
    mark(model.triangles, marked);
    const auto rest = [](Role role) {
        return role == Role::condition || role == Role::setting || role == Role::geometry;
    };
    const auto block = bytes_of(model.blocks, 0, rest), zone = bytes_of(model.zones, 0, rest),
               triangle = bytes_of(model.triangles, 3, rest);
    excavate_blocks(model, {0});
    fill_blocks(model, {0});
    ASSERT_EQ(model.blocks.number[0], 1);
    for (const auto& [name, bytes] : bytes_of(model.blocks, 0, of_the_run)) EXPECT_TRUE(is_zero(bytes)) << name;
    for (const auto& [name, bytes] : bytes_of(model.zones, 0, of_the_run)) EXPECT_TRUE(is_zero(bytes)) << name;
    for (const auto& [name, bytes] : bytes_of(model.gridpoints, 2, of_the_run)) EXPECT_TRUE(is_zero(bytes)) << name;
    EXPECT_EQ(bytes_of(model.blocks, 0, rest), block);
    EXPECT_EQ(bytes_of(model.zones, 0, rest), zone);
    EXPECT_EQ(bytes_of(model.triangles, 3, rest), triangle);
    // The other block is unchanged.
    for (const auto& [name, bytes] : bytes_of(model.blocks, 1, of_the_run)) EXPECT_FALSE(is_zero(bytes)) << name;
}

TEST(Roles, CopiesHaveTheSettingsAndNothingOfTheRun) {
    Model model;
    Polyhedron cube;
    for (int k = 0; k < 8; ++k) cube.vertices.push_back(Vec3(k & 1, (k >> 1) & 1, k >> 2));
    for (const auto& loop :
         {std::vector{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        cube.faces.push_back({loop, 3});
    for (const bool zoned : {false, true}) {
        const Row block = add_block(model, cube, {});
        if (zoned) generate_zones(model, {block}, 0.6);
        mark(model.blocks, {Role::load, Role::motion, Role::displacement, Role::state, Role::condition});
        model.blocks.material[block] = 4;
        model.blocks.region[block] = 9;
        for (const Span span : {model.blocks.faces[block]})
            for (Row f = span.first; f < span.end(); ++f) model.faces.joint_set[f] = f + 2;
        const auto wanted = bytes_of(model.blocks, block, [](Role role) { return role == Role::setting; });
        const Row copy = copy_blocks(model, {block}, {Placement{Mat3::Identity(), Vec3(5, 0, 0)}});
        EXPECT_EQ(bytes_of(model.blocks, copy, [](Role role) { return role == Role::setting; }), wanted);
        for (const auto& [name, bytes] :
             bytes_of(model.blocks, copy, [](Role role) { return of_the_run(role) || role == Role::condition; }))
            EXPECT_TRUE(is_zero(bytes)) << name;
        for (Row f = 0; f < 6; ++f)
            EXPECT_EQ(model.faces.joint_set[model.blocks.faces[copy].first + f],
                      model.faces.joint_set[model.blocks.faces[block].first + f]);
        EXPECT_EQ(inconsistency(model), "");
        mark(model.blocks, {Role::load}); // the next round starts with other values
    }
}

TEST(Roles, LinksFollowRowsThatMove) {
    Model model = hand_made_model();
    // References to the second block, its faces and its contact are updated.
    delete_blocks(model, {0});
    EXPECT_EQ(inconsistency(model), "");
    EXPECT_TRUE(model.contacts.empty());
    model = hand_made_model();
    excavate_blocks(model, {0});
    EXPECT_EQ(inconsistency(model), "");
    fill_blocks(model, {0});
    EXPECT_EQ(inconsistency(model), "");
    EXPECT_EQ(model.blocks.number, (Column<std::int32_t>{1, 2}));
}

TEST(Roles, ExcavatedBlocksMayHaveAZoneModelAndBeHeldAlongADirection) {
    Model model = hand_made_model();
    model.zone_properties.emplace_back();
    model.rollers.emplace_back();
    model.blocks.zone_properties[0] = 1;
    model.gridpoints.roller[0] = 1;
    excavate_blocks(model, {0});
    EXPECT_EQ(inconsistency(model), "");
}

TEST(ModelEdit, SetsDirtyFlagsWhenItEnds) {
    struct Case {
        Change change;
        bool contacts, properties, lists, rows;
    };
    for (const auto& [change, contacts, properties, lists, rows] :
         {Case{Change::blocks, true, true, false, false}, Case{Change::rows, true, true, false, true},
          Case{Change::surfaces, true, false, false, false}, Case{Change::contacts, false, true, true, false},
          Case{Change::properties, false, true, false, false}, Case{Change::lists, false, false, true, false}}) {
        Model model;
        model.stale.contacts_found();
        model.stale.properties_computed();
        model.stale.lists_made();
        const auto before = model.stale.rows_revision();
        try {
            const ModelEdit edit(model, change);
            EXPECT_FALSE(model.stale.contacts() || model.stale.properties() || model.stale.lists());
            throw 1; // not complete
        } catch (int) {}
        EXPECT_EQ(model.stale.contacts(), contacts);
        EXPECT_EQ(model.stale.properties(), properties);
        EXPECT_EQ(model.stale.lists(), lists);
        EXPECT_EQ(model.stale.rows_revision() != before, rows);
    }
}

TEST(ModelEdit, AnotherModelInTheSameMemoryHasANewRevision) {
    Model model;
    const Model saved = model;
    ModelEdit(model, Change::rows);
    const auto seen = model.stale.rows_revision();
    model = saved;
    EXPECT_NE(model.stale.rows_revision(), seen);
    EXPECT_NE(model.stale.rows_revision(), saved.stale.rows_revision());
    ModelEdit(model, Change::rows);
    EXPECT_NE(model.stale.rows_revision(), seen);
}
