// A model with objects of every kind, and hostile changes of its state one by one: for tests and fuzzers of saves.
#pragma once

#include "commands/session/session.hpp"
#include "model/whole/state.hpp"

#include <array>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <string>

namespace kaya::test {

/// Passed along the state of a model it counts the columns and values that hold numbers, or changes one number of one of them.
class Mutation final : public Archive {
public:
    using Choose = std::function<std::uint64_t()>;

    /// Only counts.
    Mutation() = default;
    Mutation(std::size_t place, Choose choose) : place_(place), choose_(std::move(choose)) {}

    std::size_t count() const { return seen_; }
    const std::string& what() const { return what_; }

    void numbers(std::string_view name, const Numbers& value) override {
        with_type(value, [&](auto* first, std::size_t count) { change(name, first, count); });
    }
    void text(std::string_view, std::string&) override {}
    void number_list(std::string_view name, NumberList& list) override { numbers(name, list.numbers()); }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers&) override {
        numbers(name, column);
    }
    void rows(TableRows&) override {}
    void record_list(std::string_view name, RecordList& records) override {
        section(name, [&] {
            for (std::size_t k = 0; k < records.size(); ++k) records.visit(k);
        });
    }
    void group(std::string_view name, const Visit& visit) override {
        const std::string before = path_;
        path_.append(name).append("/");
        visit();
        path_ = before;
    }
    void outside(const Visit& visit) override { visit(); }

private:
    template <class Number> void change(std::string_view name, Number* first, std::size_t count) {
        if (count == 0 || seen_++ != place_ || !choose_) return;
        const std::size_t at = choose_() % count;
        if constexpr (std::is_same_v<Number, bool>) first[at] = !first[at];
        else first[at] = hostile<Number>();
        what_ = fmt::format("{}{}[{}] = {}", path_, name, at, first[at]);
    }

    template <class Number> Number hostile() {
        using Limits = std::numeric_limits<Number>;
        const std::uint64_t pick = choose_();
        if constexpr (std::is_floating_point_v<Number>) {
            constexpr std::array<Number, 9> all{
                0, -1, 1e300, -1e300, 1e-300, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), 3};
            return all[pick % all.size()];
        } else {
            const std::array<Number, 8> all{
                0, 1, 2, 7, static_cast<Number>(-1), Limits::max(), Limits::min(), static_cast<Number>(pick >> 8)};
            return all[pick % all.size()];
        }
    }

    std::size_t place_ = std::numeric_limits<std::size_t>::max(), seen_ = 0;
    Choose choose_;
    std::string path_, what_;
};

class Scene {
public:
    Scene() : results_(std::tmpfile()), messages_(std::tmpfile()) {
        Options options;
        options.threads = 1;
        options.joint_folders = {KAYA_TEST_JOINTS};
        session_ = std::make_unique<Session>(options, results_, messages_);
    }
    ~Scene() {
        session_.reset();
        std::fclose(results_);
        std::fclose(messages_);
    }
    void run(const std::string& lines) { session_->deck.interpreter.run_text(lines, "hostile.3dd"); }
    Session& session() { return *session_; }

private:
    std::FILE *results_, *messages_;
    std::unique_ptr<Session> session_;
};

inline constexpr const char* hostile_deck = R"(
poly brick 0 1 0 1 0 1
poly brick 0 1 0 1 1 2
poly brick 1 2 0 1 0 1
poly tet 0 0 2  1 0 2  0 1 2  0 0 3
gen edge 0.6 range z 0 1
prop mat 1 dens 2000 k 1e8 g 6e7
jmodel model mohr
jmodel jkn 1e8 jks 1e8 jfric 20
grav 0 0 -10
bound zvel 0 range z -0.01 0.01
bound stress 0 0 -1e3 0 0 0 range x 1.9 2.1
table 1 0 0 1 1
bound xload 1 hist table 1 range z 2.9 3.1
structure property 1 area 1e-4 young 2e11 kbond 1e7 sbond 1e4
structure cable 0.5 0.5 1.8 0.5 0.5 0.2 segments 6
structure property 2 area 1e-3 young 2e11 density 7800 moi-y 1e-7 moi-z 1e-7 plastic-moment 1e3
structure beam 0.2 0.5 1.8 0.5 0.5 0.2 3 0.5 0.2 segments 4 property 2 anchor all
structure property 3 thickness 0.05 young 2e10 density 2400 kn 1e9 ks 1e8 tension 1e3
structure liner property 3 edge 0.6 range y -0.01 0.01
hist unbal
hist zdis 0 0 2
hist cforce 0.5 0.5 1
cycle 20
)";

} // namespace kaya::test
