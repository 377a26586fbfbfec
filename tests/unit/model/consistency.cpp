#include "model/whole/consistency.hpp"

#include "model/edit/excavation.hpp"

#include "model/fields/sampling.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace kaya;
using kaya::test::hand_made_model;

namespace {

struct Damage {
    const char* name;
    std::function<void(Model&)> change;
    const char* sentence;
};

const std::vector<Damage>& damages() {
    static const std::vector<Damage> all{
        {"zone corner", [](Model& m) { m.zones.gridpoints[0][2] = 99; },
         "row 0 of zones: gridpoint 99 is not one of its block"},
        {"zone corner of the other block", [](Model& m) { m.zones.gridpoints[0][2] = 5; },
         "row 0 of zones: gridpoint 5 is not one of its block"},
        {"triangle corner", [](Model& m) { m.triangles.gridpoints[7][0] = -1; },
         "row 7 of triangles: gridpoint -1 is not one of its block"},
        {"span outside",
         [](Model& m) {
             m.blocks.gridpoints[1] = {4, 5};
         },
         "row 1 of blocks: gridpoint 4 and the 5 after of 8"},
        {"span that overflows",
         [](Model& m) {
             m.blocks.faces[0] = {2147483647, 2147483647};
         },
         "row 0 of blocks: face 2147483647 and the 2147483647 after of 8"},
        {"span of negative length",
         [](Model& m) {
             m.blocks.zones[0] = {0, -1};
         },
         "row 0 of blocks: zone 0 and the -1 after of 1"},
        {"span over the rows of another block",
         [](Model& m) {
             m.blocks.gridpoints[1] = {3, 4};
         },
         "row 1 of blocks: gridpoint 3 belongs to another row"},
        {"rows without owner",
         [](Model& m) {
             m.blocks.zones[0] = {0, 0};
         },
         "some rows of zone belong to no row of blocks"},
        {"triangles of a block",
         [](Model& m) {
             m.blocks.triangles[0] = {0, 3};
         },
         "some rows of triangle belong to no row of blocks"},
        {"group", [](Model& m) { m.blocks.group[0] = 2; }, "row 0 of blocks: group 2 of 2"},
        {"group of a zone", [](Model& m) { m.zones.group[0] = -1; }, "row 0 of zones: group -1 of 2"},
        {"group of a face", [](Model& m) { m.faces.group[7] = 2; }, "row 7 of faces: group 2 of 2"},
        {"group of a contact", [](Model& m) { m.contacts.group[0] = 2; }, "row 0 of contacts: group 2 of 2"},
        {"excavated zone",
         [](Model& m) {
             excavate_blocks(m, {0});
             m.excavated.zones.gridpoints[0][2] = 99;
         },
         "row 0 of zones: gridpoint 99 is not one of its block"},
        {"excavated span",
         [](Model& m) {
             excavate_blocks(m, {1});
             m.excavated.blocks.faces[0].count = 3;
         },
         "some rows of face belong to no row of blocks"},
        {"block number", [](Model& m) { m.blocks.number[0] = 3; }, "row 0 of blocks: number 3 where 3 is the next"},
        {"block shape", [](Model& m) { m.blocks.shape[0] = 3; }, "row 0 of blocks: shape 3 where 3 is the next"},
        {"block id", [](Model& m) { m.blocks.id[0].generation = 9; }, "row 0 of blocks: its id belongs to another row"},
        {"id row", [](Model& m) { m.blocks.ids.slots()[0].row = 1; }, "row 0 of blocks: its id belongs to another row"},
        {"id more",
         [](Model& m) {
             m.blocks.ids.slots().push_back({1, 1});
         },
         "3 ids for 2 rows of blocks"},
        {"id free", [](Model& m) { m.contacts.ids.free_slots().push_back(0); },
         "the number of free ids of contacts is wrong"},
        {"id free outside",
         [](Model& m) {
             m.contacts.ids.slots().push_back({no_row, 1});
             m.contacts.ids.free_slots().push_back(77);
         },
         "free id 77 of contacts is in use"},
        {"block of a contact", [](Model& m) { m.contacts.block2[0] = 2; }, "row 0 of contacts: block 2 of 2"},
        {"contact with itself", [](Model& m) { m.contacts.block2[0] = 1; },
         "row 0 of contacts: a block is in contact with itself"},
        {"face of a contact", [](Model& m) { m.contacts.face1[0] = -2; }, "row 0 of contacts: face -2 of 8"},
        {"properties", [](Model& m) { m.contacts.properties[0] = 1; }, "row 0 of contacts: property set 1 of 1"},
        {"touch", [](Model& m) { m.contacts.type[0] = static_cast<ContactType>(0); },
         "row 0 of contacts: its type is unknown"},
        {"contact number", [](Model& m) { m.contacts.number[0] = 0; },
         "row 0 of contacts: number 0 where 2 is the next"},
        {"sub-contacts of a contact",
         [](Model& m) {
             m.contacts.sub_contacts[0] = {0, 1};
         },
         "some rows of sub-contact belong to no row of contacts"},
        {"weights of an attachment", [](Model& m) { m.sub_contacts.side2[1].weights[0] = -0.0; },
         "row 1 of sub_contacts: the weights of its corners do not sum to 1"},
        {"attachment", [](Model& m) { m.sub_contacts.side2[1].gridpoints[0] = 8; },
         "row 1 of sub_contacts: gridpoint 8 of 8"},
        {"meeting", [](Model& m) { m.sub_contacts.type[0] = static_cast<SubContactType>(5); },
         "row 0 of sub_contacts: its type is unknown"},
        {"sub-contact number", [](Model& m) { m.sub_contacts.number[1] = -5; },
         "row 1 of sub_contacts: number -5 where 3 is the next"},
        {"column too short", [](Model& m) { m.gridpoints.mass.pop_back(); },
         "column mass of gridpoints has 7 rows of 8"},
        {"group names", [](Model& m) { m.group_names.clear(); }, "group 0 has a name"},
        {"damping", [](Model& m) { m.settings.damping = static_cast<Damping>(-1); }, "the damping is unknown"},
        {"default properties", [](Model& m) { m.settings.default_properties = 1; },
         "the joint properties of new contacts are not there"},
        {"history interval", [](Model& m) { m.histories.interval = 0; }, "histories are sampled every 0 cycles"},
        {"history cycles", [](Model& m) { m.histories.cycle.pop_back(); },
         "histories have different numbers of cycles and times"},
        {"history values", [](Model& m) { m.histories.all[0].values.push_back(1); },
         "row 0 of histories: its number of values is not that of the samples"},
        {"history first sample", [](Model& m) { m.histories.all[0].first_sample = 5; },
         "row 0 of histories: its number of values is not that of the samples"},
        {"field columns",
         [](Model& m) {
             m.sub_contacts.keep_fields(KAYA_JMODEL_MAX_FIELDS);
             m.sub_contacts.field_columns = 100;
         },
         "the number of fields of sub-contacts is wrong"},
        {"field without rows", [](Model& m) { m.sub_contacts.field_columns = 1; },
         "column field_0 of sub_contacts has 0 rows of 2"},
        {"history kind", [](Model& m) { m.histories.all[0].source.kind = ObjectKind::none; },
         "row 0 of histories: its kind is unknown"},
        {"history number", [](Model& m) { m.histories.all[0].number = 0; },
         "row 0 of histories: its number is not above the one before"},
    };
    return all;
}

Model right_model() {
    Model model = hand_made_model();
    add_history(model, {HistorySource::Kind::global, "time"});
    sample_histories(model, 1, {});
    return model;
}

} // namespace

TEST(Consistency, ARightModelHasNothingToSay) {
    Model model = right_model();
    EXPECT_EQ(inconsistency(model), "");
    Model empty;
    EXPECT_EQ(inconsistency(empty), "");
}

TEST(Consistency, EveryDamageIsNamed) {
    for (const auto& damage : damages()) {
        Model model = right_model();
        damage.change(model);
        EXPECT_EQ(inconsistency(model), damage.sentence) << damage.name;
    }
}

TEST(Consistency, AModelWithDeletedObjectsIsRight) {
    Model model = right_model();
    auto& sub = model.sub_contacts;
    sub.ids.destroy(sub.id[0]);
    sub.gather({1});
    sub.ids.move(sub.id[0], 0);
    model.contacts.sub_contacts[0] = {0, 1};
    EXPECT_EQ(inconsistency(model), "");
}
