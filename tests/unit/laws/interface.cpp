// The layout of the structs shared by a library and the program. Existing libraries must remain compatible: if this test fails, increase
// KAYA_JMODEL_INTERFACE and record the new layout under it.
#include "kaya/jmodel.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <type_traits>

namespace {

struct Member {
    const char* name;
    std::size_t offset, recorded;
};

#define KAYA_MEMBER(type, member, recorded) \
    Member { #type "." #member, offsetof(type, member), recorded }

// Layout of interface version 4, 64 bits; members of versions 2 and 3 are unchanged.
const Member members[] = {
    KAYA_MEMBER(kaya_jproperty, name, 0),
    KAYA_MEMBER(kaya_jproperty, aliases, 8),
    KAYA_MEMBER(kaya_jproperty, unit, 16),
    KAYA_MEMBER(kaya_jproperty, help, 24),
    KAYA_MEMBER(kaya_jproperty, initial, 32),
    KAYA_MEMBER(kaya_jproperty, minimum, 40),
    KAYA_MEMBER(kaya_jproperty, maximum, 48),
    KAYA_MEMBER(kaya_jproperty, optional, 56),
    KAYA_MEMBER(kaya_jproperty, role, 60), // padding before version 4
    KAYA_MEMBER(kaya_jhistory, name, 0),
    KAYA_MEMBER(kaya_jhistory, unit, 8),
    KAYA_MEMBER(kaya_jhistory, help, 16),
    KAYA_MEMBER(kaya_jobject, functions, 0),
    KAYA_MEMBER(kaya_jobject_functions, clone, 0),
    KAYA_MEMBER(kaya_jobject_functions, destroy, 8),
    KAYA_MEMBER(kaya_jobject_functions, save, 16),
    KAYA_MEMBER(kaya_jtables, find, 0),
    KAYA_MEMBER(kaya_jtables, value, 8),
    KAYA_MEMBER(kaya_jtables, slope, 16),
    KAYA_MEMBER(kaya_jbatch, n, 0),
    KAYA_MEMBER(kaya_jbatch, properties, 8),
    KAYA_MEMBER(kaya_jbatch, time_step, 16),
    KAYA_MEMBER(kaya_jbatch, area, 24),
    KAYA_MEMBER(kaya_jbatch, normal_disp, 32),
    KAYA_MEMBER(kaya_jbatch, normal_disp_inc, 40),
    KAYA_MEMBER(kaya_jbatch, shear_disp, 48),
    KAYA_MEMBER(kaya_jbatch, shear_disp_inc, 72),
    KAYA_MEMBER(kaya_jbatch, pore_pressure, 96),
    KAYA_MEMBER(kaya_jbatch, normal_force, 104),
    KAYA_MEMBER(kaya_jbatch, shear_force, 112),
    KAYA_MEMBER(kaya_jbatch, normal_stiffness, 136),
    KAYA_MEMBER(kaya_jbatch, shear_stiffness, 144),
    KAYA_MEMBER(kaya_jbatch, stiffness_changed, 152),
    KAYA_MEMBER(kaya_jbatch, frictional_work, 160),
    KAYA_MEMBER(kaya_jbatch, state, 168),
    KAYA_MEMBER(kaya_jbatch, history, 176),
    KAYA_MEMBER(kaya_jbatch, message, 184),
    KAYA_MEMBER(kaya_jbatch, object, 440),
    KAYA_MEMBER(kaya_jbatch, tables, 448),
    KAYA_MEMBER(kaya_jbatch, row, 456),
    KAYA_MEMBER(kaya_jbatch, field, 464),
    KAYA_MEMBER(kaya_jbatch, position, 472),
    KAYA_MEMBER(kaya_jbatch, normal, 496),
    KAYA_MEMBER(kaya_jbatch, block, 520),
    KAYA_MEMBER(kaya_jfield, name, 0),
    KAYA_MEMBER(kaya_jfield, unit, 8),
    KAYA_MEMBER(kaya_jfield, help, 16),
    KAYA_MEMBER(kaya_jfield, initial, 24),
    KAYA_MEMBER(kaya_jmodel, interface_version, 0),
    KAYA_MEMBER(kaya_jmodel, size, 4),
    KAYA_MEMBER(kaya_jmodel, name, 8),
    KAYA_MEMBER(kaya_jmodel, title, 16),
    KAYA_MEMBER(kaya_jmodel, version, 24),
    KAYA_MEMBER(kaya_jmodel, properties, 32),
    KAYA_MEMBER(kaya_jmodel, property_count, 40),
    KAYA_MEMBER(kaya_jmodel, history, 48),
    KAYA_MEMBER(kaya_jmodel, history_count, 56),
    KAYA_MEMBER(kaya_jmodel, state_names, 64),
    KAYA_MEMBER(kaya_jmodel, initialise, 72),
    KAYA_MEMBER(kaya_jmodel, run, 80),
    KAYA_MEMBER(kaya_jmodel, check, 88),
    KAYA_MEMBER(kaya_jmodel, max_stiffness, 96),
    KAYA_MEMBER(kaya_jmodel, restore, 104),
    KAYA_MEMBER(kaya_jmodel, fields, 112),
    KAYA_MEMBER(kaya_jmodel, field_count, 120),
    KAYA_MEMBER(kaya_jmodel, needs, 128),
    KAYA_MEMBER(kaya_jmodel, object_value, 136),
    KAYA_MEMBER(kaya_jmodel, set_object_value, 144),
};

TEST(JointInterface, LaysItsStructsOutAsRecorded) {
    EXPECT_EQ(KAYA_JMODEL_INTERFACE, 4);
    EXPECT_EQ(KAYA_JMODEL_OLDEST, 2);
    for (const auto& member : members) EXPECT_EQ(member.offset, member.recorded) << member.name;
    EXPECT_EQ(sizeof(kaya_jproperty), 64u);
    EXPECT_EQ(sizeof(kaya_jhistory), 24u);
    EXPECT_EQ(sizeof(kaya_jobject), 8u);
    EXPECT_EQ(sizeof(kaya_jobject_functions), 24u);
    EXPECT_EQ(sizeof(kaya_jtables), 24u);
    EXPECT_EQ(sizeof(kaya_jbatch), 536u);
    EXPECT_EQ(sizeof(kaya_jmodel), 152u);
    EXPECT_EQ(KAYA_JMODEL_MAX_PROPERTIES, 256);
    EXPECT_EQ(KAYA_JMODEL_MAX_HISTORY, 64);
    EXPECT_EQ(KAYA_JMODEL_MAX_STATES, 32);
    EXPECT_EQ(KAYA_JMODEL_MAX_FIELDS, 8);
    EXPECT_EQ(KAYA_JMODEL_MESSAGE, 256);
}

TEST(JointInterface, IsPlainC) {
    EXPECT_TRUE(std::is_standard_layout_v<kaya_jmodel>);
    EXPECT_TRUE(std::is_standard_layout_v<kaya_jbatch>);
    EXPECT_TRUE(std::is_trivially_copyable_v<kaya_jmodel>);
}

} // namespace
