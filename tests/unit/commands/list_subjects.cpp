// Every subject of a list has columns that the list, or its kind of object, knows.
#include "running.hpp"

#include "lang/commands/list_subjects.hpp"

#include <fmt/format.h>

namespace kaya {
namespace {

class ListSubjects : public Running {
protected:
    ListSubjects() { session().engine.joints.set_path({KAYA_TEST_JOINTS}); }
};

TEST_F(ListSubjects, HaveColumnsThatTheirListKnows) {
    run("poly brick 0,1 0,1 0,1\npoly brick 0,1 0,1 1,2\ngen edge 2 range z 1 2\nprop mat 1 dens 2000 bulk 1e9 shear 1e9\n"
        "prop jmat 1 jkn 1e9 jks 1e9 jfric 30\n");
    using enum lang::List::What;
    const std::pair<lang::List::What, const char*> lists[] = {{blocks, "blocks"},     {gridpoints, "gridpoints"},
                                                              {zones, "zones"},       {faces, "faces"},
                                                              {contacts, "contacts"}, {sub_contacts, "subcontacts"}};
    for (const auto& [what, name] : lists) {
        ASSERT_FALSE(lang::list_subjects(what).empty()) << name;
        for (const auto& subject : lang::list_subjects(what)) {
            EXPECT_FALSE(subject.columns.front().heading.empty()) << name << ' ' << subject.word;
            EXPECT_NO_THROW(run(fmt::format("list {} show {}", name, subject.word))) << name << ' ' << subject.word;
        }
    }
    EXPECT_EQ(lang::listed_objects(time), nullptr);
}

} // namespace
} // namespace kaya
