// docs/fields.md, the page with every field of every kind of object, is generated from the tables. KAYA_BLESS=1 in the environment writes
// it again.
#include "running.hpp"

#include "model/fields/field.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <sstream>

namespace kaya {
namespace {

struct Section {
    ObjectKind table;
    const char* title;
};
constexpr Section sections[] = {{ObjectKind::global, "The whole model"},
                                {ObjectKind::block, "Blocks"},
                                {ObjectKind::gridpoint, "Gridpoints"},
                                {ObjectKind::zone, "Zones"},
                                {ObjectKind::face, "Faces"},
                                {ObjectKind::contact, "Contacts"},
                                {ObjectKind::sub_contact, "Sub-contacts"},
                                {ObjectKind::corner, "Corners of faces"},
                                {ObjectKind::cable_node, "Nodes of cables"},
                                {ObjectKind::structure_node, "Nodes of beams and liners"},
                                {ObjectKind::beam_element, "Elements of beams"},
                                {ObjectKind::liner_element, "Elements of liners"}};

constexpr const char* head =
    "# Fields of objects\n\n"
    "Every quantity that FISH and Lua can read, made from the tables of the program. Lua takes the first name (`b.volume`, `s.normal_force`;\n"
    "of the whole model `model.time`), FISH the classic one (`b_vol(b)`) or the newer one (`block.vol(b)`). A name with `*` can be set.\n"
    "Kinds: number, whole (number), vector, text, pointer. Units follow from those of the deck.\n";

const char* kind_of(const FieldValue& value) {
    constexpr const char* kinds[] = {"number", "whole", "vector", "text", "pointer"};
    return kinds[value.index()];
}

class FieldsPage : public Running {
protected:
    /// Two adjacent blocks, one with zones, with a structure of each kind.
    void make_model() {
        session().engine.joints.set_path({KAYA_TEST_JOINTS});
        run("poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\ngen edge 2 range z 1 2\nprop mat 1 dens 2000 k 1e9 g 1e9\n"
            "prop jmat 1 jkn 1e9 jks 1e9\nstructure property 1 area 1e-4 young 2e11\nstructure cable 0.2 0.5 0.5 0.8 0.5 0.5\n"
            "structure property 2 area 1e-4 young 2e11 density 7800 moi-y 1e-9 moi-z 1e-9\nstructure beam 0.2 0.5 0 0.8 0.5 0 property 2\n"
            "structure property 3 thickness 0.01 young 2e10 density 2400\nstructure liner property 3 range x 1\ncycle 1\n");
    }

    std::string row(const Field& field, const std::map<std::string, std::string>& newer) {
        const auto modern = newer.find(std::string(field.classic));
        const auto code = [](std::string_view word) {
            return word.empty() ? std::string() : fmt::format("`{}`", word);
        };
        const bool other = field.modern.empty() && !field.classic.empty() && modern != newer.end();
        return fmt::format("| `{}`{} | {} | {} | {} | {} | {} |\n", field.name, field.set ? "*" : "",
                           code(field.classic), code(other ? std::string_view(modern->second) : field.modern),
                           kind_of(field.get(model(), 0)), field.unit, field.help);
    }

    std::string page() {
        make_model();
        std::map<std::string, std::string> newer;
        for (const auto& [modern, classic] : session().engine.scripts->newer_names()) newer.emplace(classic, modern);
        std::string text = head;
        for (const auto& section : sections) {
            text += fmt::format("\n## {}\n\n| Lua | FISH | newer FISH | kind | unit | |\n|---|---|---|---|---|---|\n",
                                section.title);
            for (const auto& field : fields())
                if (field.kind == section.table) text += row(field, newer);
        }
        return text;
    }
};

TEST_F(FieldsPage, ListsEveryField) {
    const std::string wanted = page();
    if (std::getenv("KAYA_BLESS") != nullptr) std::ofstream(KAYA_FIELDS_PAGE) << wanted;
    std::ifstream stream(KAYA_FIELDS_PAGE);
    std::ostringstream text;
    text << stream.rdbuf();
    EXPECT_EQ(text.str(), wanted) << "run this test with KAYA_BLESS=1";
}

TEST_F(FieldsPage, FishSeesTheKindsThatThePageNames) {
    make_model();
    // type(): 1 integer, 2 real, 3 text, 4 pointer, 6 vector
    run("def f\n  local p = c_cx(contact_head)\n  a = type(cx_sforce(p)) * 100 + type(cx_sdis(p)) * 10 + type(cx_nforce(p))\n"
        "  b = mag(block.subcontact.force.shear(p)) + mag(block.subcontact.disp.shear(p))\n  cx_sforce(p) = vector(3,4,0)\n"
        "  c = mag(cx_sforce(p))\nend\n@f\nprint @a @b @c\n");
    EXPECT_THAT(printed(), testing::HasSubstr("a = 662"));
    EXPECT_THAT(printed(), testing::HasSubstr("c = 5"));
}

} // namespace
} // namespace kaya
