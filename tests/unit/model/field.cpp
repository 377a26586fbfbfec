#include "model/fields/field.hpp"
#include "model/structures/members.hpp"

#include "base/diagnostic.hpp"
#include "model/measure/measure.hpp"
#include "model/whole/state_hash.hpp"
#include "tests/unit/model/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>

using namespace kaya;
using kaya::test::hand_made_model;

namespace {

FieldValue value(const Model& model, std::string_view classic, Row row) {
    const Field* field = find_classic_field(classic);
    if (!field) throw std::runtime_error("no field " + std::string(classic));
    return field->get(model, row);
}
double number(const Model& model, std::string_view classic, Row row) {
    const FieldValue v = value(model, classic, row);
    if (const auto* whole = std::get_if<std::int64_t>(&v)) return static_cast<double>(*whole);
    return std::get<double>(v);
}
double named(const Model& model, ObjectKind table, std::string_view name, Row row) {
    return std::get<double>(find_field(table, name)->get(model, row));
}
void set(Model& model, std::string_view classic, Row row, const FieldValue& v) {
    find_classic_field(classic)->set(model, row, v);
}

} // namespace

TEST(Fields, NamesAreUniqueWithinATable) {
    std::set<std::pair<ObjectKind, std::string_view>> names;
    std::set<std::string_view> classics;
    for (const auto& field : fields()) {
        EXPECT_TRUE(names.insert({field.kind, field.name}).second) << field.name;
        if (!field.classic.empty()) { EXPECT_TRUE(classics.insert(field.classic).second) << field.classic; }
    }
}

TEST(Fields, EveryFieldHasNameUnitAndHelpAndIsFoundByItsWords) {
    for (const auto& field : fields()) {
        EXPECT_FALSE(field.name.empty() || field.unit.empty() || field.help.empty()) << field.name;
        for (const char c : field.name)
            EXPECT_TRUE(std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) ||
                        c == '_')
                << field.name;
        EXPECT_EQ(find_field(field.kind, field.name), &field);
        if (!field.classic.empty()) { EXPECT_EQ(find_classic_field(field.classic), &field); }
    }
}

TEST(Fields, UnknownWordsFindNothing) {
    EXPECT_EQ(find_field(ObjectKind::zone, "normal_force"), nullptr);
    EXPECT_EQ(find_field(ObjectKind::block, ""), nullptr);
    EXPECT_EQ(find_classic_field("cx_nforces"), nullptr);
    EXPECT_EQ(find_classic_field(""), nullptr);
}

TEST(Fields, EveryFieldOfEveryRowCanBeReadAndLinksStayInsideTheModel) {
    const Model model = hand_made_model();
    std::size_t read = 0;
    for (const auto& field : fields())
        for (std::size_t row = 0; row < count_of(model, field.kind); ++row) {
            const FieldValue v = field.get(model, static_cast<Row>(row));
            ++read;
            if (const auto* link = std::get_if<Link>(&v)) {
                EXPECT_GE(link->row, no_row) << field.name;
                EXPECT_LT(link->row, static_cast<Row>(count_of(model, link->kind))) << field.name;
            }
        }
    EXPECT_GT(read, 300u);
}

TEST(Fields, WrittenValuesAreRead) {
    Model model = hand_made_model();
    make_beam(model, {.places = {Vec3(0, 0, 0), Vec3(1, 0, 0)}});
    std::size_t written = 0;
    for (const auto& field : fields()) {
        if (!field.set) continue;
        // Row 0 is deformable, and only rigid blocks accept a load as a whole.
        const Row row = field.kind == ObjectKind::block ? 1 : 0;
        const FieldValue before = field.get(model, row);
        FieldValue given;
        if (std::holds_alternative<double>(before)) given = 0.75; // also valid as a fraction of a time step
        else if (std::holds_alternative<std::int64_t>(before)) given = std::int64_t{5};
        else if (std::holds_alternative<Vec3>(before)) given = Vec3(1.5, -2.5, 3.5);
        else given = std::string("roof");
        field.set(model, row, given);
        const FieldValue after = field.get(model, row);
        ASSERT_EQ(after.index(), given.index()) << field.name;
        if (const auto* real = std::get_if<double>(&given)) { EXPECT_EQ(std::get<double>(after), *real) << field.name; }
        if (const auto* whole = std::get_if<std::int64_t>(&given)) {
            EXPECT_EQ(std::get<std::int64_t>(after), *whole) << field.name;
        }
        if (const auto* v = std::get_if<Vec3>(&given)) { EXPECT_EQ(std::get<Vec3>(after), *v) << field.name; }
        if (const auto* name = std::get_if<std::string>(&given)) {
            EXPECT_EQ(std::get<std::string>(after), *name) << field.name;
        }
        ++written;
    }
    EXPECT_GT(written, 40u);
}

TEST(Fields, WritingTheWrongTypeNamesTheRightOne) {
    Model model = hand_made_model();
    for (const auto& field : fields()) {
        if (!field.set) continue;
        const bool takes_text = field.name == "group";
        const FieldValue wrong = takes_text ? FieldValue(1.0) : FieldValue(std::string("much"));
        const std::uint64_t before = state_hash(model);
        const Row row = field.kind == ObjectKind::block ? 1 : 0;
        EXPECT_THROW(field.set(model, row, wrong), Diagnostic) << field.name;
        EXPECT_EQ(state_hash(model), before) << field.name;
    }
    try {
        set(model, "gp_xvel", 0, Vec3(1, 2, 3));
        FAIL();
    } catch (const Diagnostic& d) { EXPECT_EQ(d.message, "a number is needed here, and this is a vector"); }
}

TEST(Fields, WholeNumbersAreNotRounded) {
    Model model = hand_made_model();
    EXPECT_THROW(set(model, "b_region", 0, 1.5), Diagnostic);
    EXPECT_THROW(set(model, "b_region", 0, 1e12), Diagnostic);
    set(model, "b_region", 0, 3.0);
    EXPECT_EQ(model.blocks.region[0], 3);
}

TEST(Fields, JointSignsAndSizes) {
    const Model model = hand_made_model();
    EXPECT_EQ(number(model, "cx_nforce", 1), 20);
    EXPECT_EQ(number(model, "cx_ndis", 1), -0.002);
    EXPECT_EQ(std::get<Vec3>(value(model, "cx_sforce", 0)), Vec3(-3, -4, 0)); // vectors, as in 3DEC
    EXPECT_EQ(std::get<Vec3>(value(model, "cx_sdis", 0)), Vec3(3e-3, 4e-3, 0));
    EXPECT_DOUBLE_EQ(named(model, ObjectKind::sub_contact, "shear_force", 0), 5);
    EXPECT_DOUBLE_EQ(named(model, ObjectKind::sub_contact, "shear_displacement", 0), 5e-3);
    EXPECT_EQ(number(model, "cx_xsforce", 0), -3);
    EXPECT_EQ(number(model, "cx_ysdis", 0), 4e-3);
    EXPECT_DOUBLE_EQ(named(model, ObjectKind::sub_contact, "normal_stress", 1), 80);
    EXPECT_DOUBLE_EQ(named(model, ObjectKind::sub_contact, "shear_stress", 0), 20);
    EXPECT_EQ(std::get<std::string>(value(model, "cx_model", 0)), "mohr");
}

TEST(Fields, ASubContactWithoutAreaCarriesNoStress) {
    Model model = hand_made_model();
    model.sub_contacts.area[0] = 0;
    EXPECT_EQ(named(model, ObjectKind::sub_contact, "normal_stress", 0), 0);
    EXPECT_EQ(named(model, ObjectKind::sub_contact, "shear_stress", 0), 0);
}

TEST(Fields, ContactsSumTheirSubContacts) {
    Model model = hand_made_model();
    EXPECT_EQ(number(model, "c_nforce", 0), 30);
    EXPECT_DOUBLE_EQ(number(model, "c_ndis", 0), -0.0015);
    model.sub_contacts.area = {0.75, 0.25};
    EXPECT_DOUBLE_EQ(number(model, "c_ndis", 0), -0.00125);
    model.sub_contacts.area = {0, 0};
    EXPECT_DOUBLE_EQ(number(model, "c_ndis", 0), -0.0015);
    model.contacts.sub_contacts[0] = {0, 0};
    EXPECT_EQ(number(model, "c_ndis", 0), 0);
    EXPECT_EQ(std::get<Link>(value(model, "c_cx", 0)).row, no_row);
}

TEST(Fields, AContactWithoutJointModelSaysSoByAnEmptyName) {
    Model model = hand_made_model();
    model.contacts.properties[0] = no_row;
    EXPECT_EQ(std::get<std::string>(value(model, "c_model", 0)), "");
}

TEST(Fields, PrincipalStressesAreInOrderMostCompressiveFirst) {
    Model model = hand_made_model();
    model.zones.stress[0] << 5, -7, 1, 0, 0, 0;
    EXPECT_NEAR(number(model, "z_sig1", 0), -7, 1e-12);
    EXPECT_NEAR(number(model, "z_sig2", 0), 1, 1e-12);
    EXPECT_NEAR(number(model, "z_sig3", 0), 5, 1e-12);
    // Pure shear in xz of 2: principal stresses -2, 0, 2.
    model.zones.stress[0] << 0, 0, 0, 0, 2, 0;
    EXPECT_NEAR(number(model, "z_sig1", 0), -2, 1e-12);
    EXPECT_NEAR(number(model, "z_sig3", 0), 2, 1e-12);
    EXPECT_EQ(number(model, "z_sxz", 0), 2);
}

TEST(Fields, ZonesAndFacesAreMeasuredAsTheyAreNow) {
    Model model = hand_made_model();
    EXPECT_DOUBLE_EQ(number(model, "z_vol", 0), 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(number(model, "z_mass", 0), 2000.0 / 6.0);
    EXPECT_DOUBLE_EQ(number(model, "z_z", 0), 0.25);
    EXPECT_DOUBLE_EQ(number(model, "face_area", 0), 0.5);
    EXPECT_EQ(std::get<Vec3>(value(model, "face_n", 0)), Vec3(0, 0, -1));
    EXPECT_NEAR(number(model, "face_x", 0), 1.0 / 3.0, 1e-15);
    model.gridpoints.position[3] = Vec3(0, 0, 2);
    EXPECT_DOUBLE_EQ(number(model, "z_vol", 0), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(number(model, "z_mass", 0), 2000.0 / 6.0); // the mass is constant
}

TEST(Fields, ZonesOfAMaterialWithoutPropertiesHaveNaN) {
    Model model = hand_made_model();
    model.blocks.material[0] = 99;
    EXPECT_TRUE(std::isnan(number(model, "z_bulk", 0)));
    EXPECT_TRUE(std::isnan(number(model, "z_mass", 0)));
    EXPECT_EQ(number(model, "z_mat", 0), 99);
}

TEST(Fields, DeformableBlocksMoveWithTheMassOfTheirGridpoints) {
    Model model = hand_made_model();
    // Masses 1 2 3 4, x velocities 0 0.5 1 1.5: (0 + 1 + 3 + 6) / 10.
    EXPECT_DOUBLE_EQ(number(model, "b_xvel", 0), 1.0);
    EXPECT_DOUBLE_EQ(number(model, "b_zforce", 0), 6);
    EXPECT_EQ(number(model, "b_yvel", 1), 2);
    EXPECT_EQ(number(model, "b_zforce", 1), 6);
    for (Row i = 0; i < 4; ++i) model.gridpoints.mass[i] = 0;
    EXPECT_DOUBLE_EQ(number(model, "b_xvel", 0), 0.75);
}

TEST(Fields, VelocityOfADeformableBlockIsGivenToItsGridpoints) {
    Model model = hand_made_model();
    set(model, "b_yvel", 0, 4.0);
    for (Row i = 0; i < 4; ++i) EXPECT_EQ(model.gridpoints.velocity[i], Vec3(0.5 * i, 4, 0));
    set(model, "b_vel", 0, Vec3(1, 1, 1));
    for (Row i = 0; i < 4; ++i) EXPECT_EQ(model.gridpoints.velocity[i], Vec3(1, 1, 1));
    EXPECT_EQ(model.gridpoints.velocity[4], Vec3(0, 0, 0));
}

TEST(Fields, AVertexHasNoVelocityAndADeformableBlockNoLoad) {
    Model model = hand_made_model();
    EXPECT_THROW(set(model, "gp_xvel", 4, 1.0), Diagnostic);
    EXPECT_THROW(set(model, "b_xload", 0, 1.0), Diagnostic);
}

TEST(Fields, FixedMeansAllComponents) {
    Model model = hand_made_model();
    EXPECT_EQ(number(model, "b_fix", 1), 0);
    model.blocks.fixed[1] = fix_all;
    EXPECT_EQ(number(model, "b_fix", 1), 1);
    for (Row i = 0; i < 4; ++i) model.gridpoints.fixed[i] = fix_x | fix_y | fix_z;
    EXPECT_EQ(number(model, "b_fix", 0), 1);
    model.gridpoints.fixed[2] = fix_x;
    EXPECT_EQ(number(model, "b_fix", 0), 0);
}

TEST(Fields, GroupsAreFoundWithoutCaseAndMadeWhenNew) {
    Model model = hand_made_model();
    EXPECT_EQ(std::get<std::string>(value(model, "b_group", 0)), "");
    set(model, "b_group", 0, std::string("BASE"));
    EXPECT_EQ(model.blocks.group[0], 1);
    set(model, "b_group", 0, std::string("roof"));
    EXPECT_THAT(model.group_names, testing::ElementsAre("", "base", "roof"));
    EXPECT_EQ(std::get<std::string>(value(model, "b_group", 0)), "roof");
}

TEST(Fields, ListHeadsAreNullInAnEmptyModel) {
    const Model empty;
    EXPECT_EQ(std::get<Link>(value(empty, "block_head", no_row)).row, no_row);
    EXPECT_EQ(std::get<Link>(value(empty, "contact_head", no_row)).row, no_row);
    EXPECT_EQ(number(empty, "nblock", no_row), 0);
    const Model model = hand_made_model();
    EXPECT_EQ(std::get<Link>(value(model, "contact_head", no_row)).row, 0);
    EXPECT_EQ(number(model, "cycle", no_row), 42);
    EXPECT_EQ(number(model, "unbal", no_row), 12.5);
    EXPECT_EQ(number(model, "zgrav", no_row), -9.81);
}

TEST(Fields, InertiaTurnsWithTheBlock) {
    Model model = hand_made_model();
    model.blocks.inertia[1] = Vec3(1, 2, 3).asDiagonal(); // of unit density
    model.blocks.mass[1] = 5 * model.blocks.volume[1];
    const double half = std::sqrt(0.5); // a quarter turn about z
    model.blocks.orientation[1] = Quaternion(half, 0, 0, half);
    EXPECT_NEAR(number(model, "b_xmoi", 1), 10, 1e-12);
    EXPECT_NEAR(number(model, "b_ymoi", 1), 5, 1e-12);
    EXPECT_NEAR(number(model, "b_zmoi", 1), 15, 1e-12);
}

TEST(Fields, ARotationIsGivenWithItsAngularMomentum) {
    Model model = hand_made_model();
    model.blocks.inertia[1] = Vec3(1, 2, 3).asDiagonal();
    set(model, "b_rvel", 1, Vec3(0, 0.5, 0)); // before the first cycle: density 2000 of the material
    EXPECT_EQ(model.blocks.angular_momentum[1], Vec3(0, 2000, 0));
    model.blocks.mass[1] = model.blocks.inertial_mass[1] = 10 * model.blocks.volume[1];
    set(model, "b_rzvel", 1, 2.0);
    EXPECT_LT((model.blocks.angular_momentum[1] - Vec3(0, 10, 60)).norm(), 1e-12);
    EXPECT_EQ(model.blocks.rotational_velocity[1], Vec3(0, 0.5, 2));
    model.blocks.mass[1] = model.blocks.inertial_mass[1] = 0;
    model.blocks.material[1] = 3; // has no density
    EXPECT_THROW(set(model, "b_rxvel", 1, 1.0), Diagnostic);
    EXPECT_EQ(model.blocks.rotational_velocity[1], Vec3(0, 0.5, 2));
}
