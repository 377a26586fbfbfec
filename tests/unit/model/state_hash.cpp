#include "model/whole/state_hash.hpp"

#include "model/fields/sampling.hpp"
#include "tests/unit/model/hand_made.hpp"
#include "tests/unit/model/other_walk.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <set>

using namespace kaya;
using kaya::test::hand_made_model;

namespace {

/// The hash after one change of a new model.
std::uint64_t hash_with(const std::function<void(Model&)>& change) {
    Model model = hand_made_model();
    add_history(model, {HistorySource::Kind::global, "time"});
    change(model);
    return state_hash(model);
}

/// Adds one to the n-th scalar of the walk; false if there are fewer.
class ScalarChanger final : public Archive {
public:
    explicit ScalarChanger(std::size_t target) : target_(target) {}

    void numbers(std::string_view, const Numbers& value) override {
        const std::size_t n = value.count();
        if (target_ >= count_ && target_ < count_ + n) {
            auto* byte = static_cast<unsigned char*>(value.first) + (target_ - count_) * size_of(value.type);
            *byte ^= 1; // one bit, also of a NaN
        }
        count_ += n;
    }
    void text(std::string_view, std::string& text) override {
        if (count_++ == target_) text += "x";
    }
    void number_list(std::string_view name, NumberList& list) override { numbers(name, list.numbers()); }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers&) override {
        numbers(name, column);
    }
    void rows(TableRows&) override {}
    void record_list(std::string_view, RecordList& records) override {
        for (std::size_t k = 0; k < records.size(); ++k) records.visit(k);
    }
    void group(std::string_view, const Visit& visit) override { visit(); }
    void outside(const Visit&) override {}

    bool changed() const { return count_ > target_; }

private:
    std::size_t target_, count_ = 0;
};

} // namespace

TEST(StateHash, EqualStatesHaveEqualHashes) {
    EXPECT_EQ(hash_with([](Model&) {}), hash_with([](Model&) {}));
    Model model = hand_made_model();
    const auto first = state_hash(model);
    EXPECT_EQ(state_hash(model), first);
    Model copy = model;
    EXPECT_EQ(state_hash(copy), first);
}

TEST(StateHash, EverySingleBitOfTheStateCounts) {
    const auto original = hash_with([](Model&) {});
    std::set<std::uint64_t> seen{original};
    std::size_t target = 0;
    for (bool more = true; more; ++target) {
        Model model = hand_made_model();
        add_history(model, {HistorySource::Kind::global, "time"});
        ScalarChanger changer(target);
        visit_state(changer, model);
        more = changer.changed();
        if (more) { EXPECT_TRUE(seen.insert(state_hash(model)).second) << "scalar " << target; }
    }
    EXPECT_GT(target, 600u);
}

TEST(StateHash, ValuesWithoutEffectOnTheRunAreExcluded) {
    const auto original = hash_with([](Model&) {});
    EXPECT_EQ(hash_with([](Model& m) { m.joint_properties[0].place = "elsewhere.3dd:7"; }), original);
    EXPECT_EQ(hash_with([](Model& m) { ModelEdit(m, Change::rows); }), original);
    EXPECT_EQ(hash_with([](Model& m) { m.stale.properties_computed(); }), original);
}

TEST(StateHash, ThePaddingOfAttachmentsIsLeftOut) {
    Model model = hand_made_model();
    const auto original = state_hash(model);
    static_assert(sizeof(Attachment) > 3 * sizeof(Row) + 3 * sizeof(double), "there is a gap to test");
    // The padding is between the rows and the weights.
    auto* bytes = reinterpret_cast<unsigned char*>(&model.sub_contacts.side1[0]);
    std::memset(bytes + 3 * sizeof(Row), 0xAB, offsetof(Attachment, weights) - 3 * sizeof(Row));
    EXPECT_EQ(state_hash(model), original);
}

TEST(StateHash, AddedAndRemovedThingsCount) {
    const auto original = hash_with([](Model&) {});
    EXPECT_NE(hash_with([](Model& m) { m.blocks.resize(3); }), original);
    EXPECT_NE(hash_with([](Model& m) { m.materials.erase(3); }), original);
    EXPECT_NE(hash_with([](Model& m) { m.materials[3].joint.erase("jfric"); }), original);
    EXPECT_NE(hash_with([](Model& m) { m.group_names.push_back("more"); }), original);
    EXPECT_NE(hash_with([](Model& m) { m.joint_constitutive[2] = "elastic"; }), original);
    EXPECT_NE(hash_with([](Model& m) { m.blocks.ids.destroy(m.blocks.id[0]); }), original);
    EXPECT_NE(hash_with([](Model& m) { sample_histories(m, 1, {}); }), original);
}

TEST(StateHash, HashingChangesNothing) {
    Model model = hand_made_model();
    model.blocks.ids.destroy(model.blocks.id[1]);
    state_hash(model);
    EXPECT_EQ(model.blocks.ids.slots().size(), 2u);
    EXPECT_EQ(model.blocks.ids.row(model.blocks.id[0]), 0);
    EXPECT_EQ(model.blocks.ids.row(model.blocks.id[1]), no_row);
    EXPECT_EQ(model.materials.at(3).joint.at("jfric"), 30);
    EXPECT_EQ(model.sub_contacts.side1[1].gridpoints[2], 6);
}

namespace {

/// The hash of a program with one name less, or one more column.
std::uint64_t other_hash(Model& model, const std::string& without, const std::string& with = {}, double more = 0) {
    HashArchive hash;
    test::OtherWalk other(hash);
    other.without = without;
    other.with = with;
    other.more.assign(model.gridpoints.size(), more);
    visit_state(other, model);
    return hash.digest();
}

} // namespace

TEST(StateHash, NoNameOfANewModelCounts) {
    Model model;
    const auto names = test::names_of(model);
    EXPECT_GT(names.all.size(), 250u);
    EXPECT_TRUE(names.holding.empty());
    for (const auto& name : names.all) EXPECT_EQ(other_hash(model, name), state_hash(model)) << name;
}

TEST(StateHash, AColumnCountsWhenItHoldsMoreThanItsInitialValue) {
    Model model = hand_made_model();
    const auto whole = state_hash(model);
    const auto names = test::names_of(model);
    EXPECT_GT(names.holding.size(), 30u);
    EXPECT_GT(names.columns.size() - names.holding.size(), 30u);
    for (const auto& name : names.columns)
        EXPECT_EQ(other_hash(model, name) != whole, names.holding.contains(name)) << name;
}

TEST(StateHash, AColumnThatIsAddedChangesNothingUntilItIsUsed) {
    Model model = hand_made_model();
    EXPECT_EQ(other_hash(model, {}, "gridpoints/temperature", 0.0), state_hash(model));
    EXPECT_NE(other_hash(model, {}, "gridpoints/temperature", 20.0), state_hash(model));
    EXPECT_NE(other_hash(model, {}, "gridpoints/temperature", -0.0), state_hash(model)) << "bits count";
}
