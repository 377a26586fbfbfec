#include "mechanics/common/sub_contact_order.hpp"

#include "mechanics/contact/batches.hpp"
#include "model/whole/consistency.hpp"
#include "two_bricks.hpp"

#include <gtest/gtest.h>

#include <map>

namespace kaya {
namespace {

/// Eight bricks on a plate; every second joint has a different friction.
struct Crossed : test::Bench {
    Crossed() {
        brick({-1, -1, -1}, {9, 2, 0});
        for (int i = 0; i < 8; ++i) brick({1.1 * i, 0, 0}, {1.1 * i + 1, 1, 1});
        elastic(1, 2000, 1e9, 1e9);
        joint("mohr", {{"stiffness-normal", 1e9}, {"stiffness-shear", 1e9}, {"friction", 30}});
        std::vector<Row> odd;
        for (const Row c : all_contacts())
            if (c % 2 == 1) odd.push_back(c);
        set_joint_properties(model, joints, odd, {{"friction", 20}}, "");
    }
};

TEST(SubContactOrder, OnePropertySetIsOneBatch) {
    Crossed crossed;
    ASSERT_EQ(crossed.model.contacts.size(), 8U);
    EXPECT_EQ(make_batches(crossed.model, crossed.joints).size(), 8U);
    order_sub_contacts(crossed.model);
    const auto batches = make_batches(crossed.model, crossed.joints);
    ASSERT_EQ(batches.size(), 2U);
    EXPECT_EQ(batches[0].contacts, (std::vector<Row>{0, 2, 4, 6}));
    EXPECT_EQ(batches[1].contacts, (std::vector<Row>{1, 3, 5, 7}));
    EXPECT_EQ(inconsistency(crossed.model), "");
}

TEST(SubContactOrder, EachKeepsItsIdentity) {
    Crossed crossed;
    auto& model = crossed.model;
    std::map<std::int32_t, std::pair<std::int32_t, double>> before;
    const auto& subs = model.sub_contacts;
    const auto place = [&](std::size_t s) { return subs.position[s].x() + 100 * subs.position[s].y(); };
    for (std::size_t s = 0; s < subs.size(); ++s)
        before[subs.number[s]] = {model.contacts.number[subs.contact[s]], place(s)};
    order_sub_contacts(model);
    for (std::size_t s = 0; s < subs.size(); ++s) {
        const auto& [contact, x] = before.at(subs.number[s]);
        EXPECT_EQ(model.contacts.number[subs.contact[s]], contact);
        EXPECT_EQ(place(s), x);
        EXPECT_EQ(subs.ids.row(subs.id[s]), static_cast<Row>(s));
    }
}

TEST(SubContactOrder, SortedOnesStay) {
    Crossed crossed;
    order_sub_contacts(crossed.model);
    const auto numbers = crossed.model.sub_contacts.number;
    order_sub_contacts(crossed.model);
    EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), crossed.model.sub_contacts.number.begin()));
}

} // namespace
} // namespace kaya
