// The same joint model three times: native, in the dialect of 3DEC 9, in Lua; and errors of Lua files.
#include "base/diagnostic.hpp"
#include "commands/world/lua_joint_models.hpp"
#include "laws/batch.hpp"
#include "laws/stiffness_trial.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <thread>

namespace kaya {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Rows of one model with the same motion, scaled differently.
struct Rows {
    Rows(const JointModel& of, const std::map<std::string, double>& given, std::size_t n)
        : model(of), object(of.keeps_objects() ? n : 0) {
        for (const auto& property : of.properties) values.push_back(property.initial);
        for (const auto& [word, value] : given) values[of.find_property(word).value()] = value;
        for (auto& column : columns) column.assign(n, 0);
        columns[area].assign(n, 0.25);
        state.assign(n, 0);
        history.assign(of.history.size(), std::vector<double>(n, 0));
        auto b = batch();
        EXPECT_FALSE(initialise_batch(model, b)) << b.message;
    }

    kaya_jbatch batch() {
        pointers.clear();
        for (auto& column : history) pointers.push_back(column.data());
        kaya_jbatch b{};
        b.n = state.size();
        b.properties = values.data();
        b.time_step = 1e-4;
        b.area = columns[area].data();
        b.normal_disp = columns[opening].data();
        b.normal_disp_inc = columns[opening_inc].data();
        for (int k = 0; k < 3; ++k) {
            b.shear_disp[k] = columns[slip + k].data();
            b.shear_disp_inc[k] = columns[slip_inc + k].data();
            b.shear_force[k] = columns[shear + k].data();
        }
        b.pore_pressure = columns[pressure].data();
        b.normal_force = columns[normal].data();
        b.normal_stiffness = columns[kn].data();
        b.shear_stiffness = columns[ks].data();
        b.frictional_work = columns[work].data();
        b.state = state.data();
        b.history = pointers.data();
        b.object = object.empty() ? nullptr : object[0].address();
        b.tables = model.tables;
        return b;
    }

    std::optional<BatchFailure> step(double open, double x, double y) {
        for (std::size_t i = 0; i < state.size(); ++i) {
            const double part = 1 + 0.01 * static_cast<double>(i);
            columns[opening_inc][i] = open * part;
            columns[slip_inc][i] = x * part;
            columns[slip_inc + 1][i] = y;
        }
        auto b = batch();
        auto failure = run_batch(model, b);
        for (std::size_t i = 0; i < state.size(); ++i) {
            columns[opening][i] += columns[opening_inc][i];
            for (int k = 0; k < 3; ++k) columns[slip + k][i] += columns[slip_inc + k][i];
        }
        return failure;
    }

    enum {
        area,
        opening,
        opening_inc,
        slip,
        slip_inc = slip + 3,
        shear = slip_inc + 3,
        pressure = shear + 3,
        normal,
        kn,
        ks,
        work,
        count
    };
    const JointModel& model;
    std::vector<double> values;
    std::array<std::vector<double>, count> columns;
    std::vector<std::uint32_t> state;
    std::vector<std::vector<double>> history;
    std::vector<double*> pointers;
    std::vector<JointObject> object;
};

JointRegistry& registry() {
    static JointRegistry joints = [] {
        JointRegistry made;
        add_lua_loader(made);
        made.set_path({KAYA_TEST_COMPAT, KAYA_TEST_COMPAT_SOURCES});
        return made;
    }();
    return joints;
}

const std::map<std::string, double> values = {
    {"kn", 3e9},       {"ks", 1.3e9},    {"friction", 34.5}, {"friction-residual", 27.25},
    {"cohesion", 2e4}, {"tension", 5e3}, {"dilation", 4}};

TEST(JointTwins, NativeDialectAndLuaGiveTheSameCurve) {
    const char* const names[] = {"slip-native", "slip9", "slip-lua"};
    std::vector<std::unique_ptr<Rows>> twins;
    for (const char* name : names) twins.push_back(std::make_unique<Rows>(registry().get(name), values, 5));
    double largest_shear = 0;
    bool opened = false;
    for (int i = 0; i < 3000; ++i) {
        // Closing, alternating shear with a drift, opened at the end of each 1000 and closed again.
        const double open = i % 1000 < 100 ? -2e-6 : i % 1000 > 900 ? 4e-6 : 1e-8 * std::sin(0.1 * i);
        for (auto& twin : twins)
            ASSERT_FALSE(twin->step(open, 1e-6 * std::cos(0.01 * i) + 1e-7, 3e-7 * std::sin(0.013 * i)));
        const Rows& native = *twins[0];
        opened = opened || native.columns[Rows::normal][0] == 0;
        largest_shear = std::max(largest_shear, std::abs(native.columns[Rows::shear][0]));
        for (std::size_t t = 1; t < twins.size(); ++t)
            for (const int c :
                 {int(Rows::normal), int(Rows::shear), Rows::shear + 1, Rows::shear + 2, int(Rows::kn), int(Rows::ks)})
                for (std::size_t row = 0; row < 5; ++row)
                    ASSERT_NEAR(twins[t]->columns[c][row], native.columns[c][row],
                                1e-12 * std::max(largest_shear, std::abs(native.columns[c][row])))
                        << names[t] << ", column " << c << ", step " << i;
        for (std::size_t t = 1; t < twins.size(); ++t)
            ASSERT_EQ(twins[t]->state, native.state) << names[t] << ", step " << i;
    }
    EXPECT_TRUE(opened);
    EXPECT_GT(largest_shear, 1e4);
}

TEST(JointTwins, LuaInManyThreadsGivesTheSameBits) {
    const JointModel& model = registry().get("slip-lua");
    std::vector<std::unique_ptr<Rows>> each;
    for (int t = 0; t < 4; ++t) each.push_back(std::make_unique<Rows>(model, values, 3));
    std::vector<std::thread> threads;
    for (auto& rows : each)
        threads.emplace_back([&rows] {
            for (int i = 0; i < 200; ++i) rows->step(i < 100 ? -1e-6 : 0, 1e-6, 0);
        });
    for (auto& thread : threads) thread.join();
    EXPECT_GT(each[0]->columns[Rows::normal][0], 0);
    for (const auto& rows : each) EXPECT_EQ(rows->columns, each[0]->columns);
}

/// A Lua file for one test.
class Written {
public:
    explicit Written(const std::string& text) : file_(folder_ / "kaya-joint.lua") { test::put(file_, text); }
    const JointModel& load() {
        add_lua_loader(joints_);
        return joints_.get(file_);
    }
    std::string refusal() {
        try {
            load();
        } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
        return "it was loaded";
    }

private:
    test::ScratchFolder folder_;
    std::string file_;
    JointRegistry joints_;
};

std::string model_text(const std::string& run, const std::string& more = "") {
    return "return {\n  name = 'trial',\n  properties = {{'stiffness', 'k'}},\n  history = {'wear-depth'},\n" + more +
           "  stiffness = function(p) return p.stiffness, p.stiffness end,\n  run = function(s, p, h)\n    " + run +
           "\n  end,\n}\n";
}

TEST(JointInLua, KeepsItsHistory) {
    Written file(model_text("h.wear_depth = h.wear_depth + 1",
                            "  check = function(p) return p.stiffness > 5 and 'too stiff' or nil end,\n"));
    const auto& model = file.load();
    EXPECT_EQ(model.history.at(0).name, "wear-depth");
    EXPECT_EQ(model.check({6}), "too stiff");
    EXPECT_EQ(model.check({4}), "");
    EXPECT_EQ(initial_stiffness(model, {4}).shear, 4);
    EXPECT_THAT(model.missing({std::nan("")}), testing::ElementsAre("stiffness"));
}

struct Wrong {
    const char* text;
    const char* message;
};

TEST(JointInLua, AWrongFileIsRefusedWithItsLine) {
    const Wrong cases[] = {
        {"return {", "kaya-joint.lua:1: unexpected symbol near <eof>"},
        {"return 5", "the file must return a table"},
        {"return {title = 'no name'}", "'name' is missing"},
        {"return {name = 5}", "'name' must be a text"},
        {"return {name = 'a'}", "'run' must be a function"},
        {"return {name = 'a', run = print, stiffness = print, check = 7}", "'check' must be a function"},
        {"return {name = 'A B', run = print, stiffness = print}", "'A B' cannot be typed"},
        {"return {name = 'a', run = print, stiffness = print, properties = {7}}",
         "an entry of 'properties' must be a name or a table"},
        {"return {name = 'a', run = print, stiffness = print, properties = {{'x', initial = 2, maximum = 1}}}",
         "outside its limits"},
        {"\nos.exit(0)", "kaya-joint.lua:2: attempt to index a nil value (global 'os')"},
        {"local many = {} for k = 1, 65 do many[k] = 'h' .. k end return {name = 'a', run = print, stiffness = print, history = many}",
         "it has 65 history variables, 64 at most"},
        {"return {name = 'a', run = print, stifness = print}",
         "the table of the model has no 'stifness'; did you mean 'stiffness'?"},
        {"return {name = 'a', run = print, stiffness = print, properties = {{'x', initail = 2}}}",
         "the entry of property 'x' has no 'initail'; did you mean 'initial'?"},
        {"return {name = 'a', run = print, stiffness = print, history = {{'x', unti = 'm'}}}",
         "the entry of history 'x' has no 'unti'; did you mean 'unit'?"},
    };
    for (const auto& wrong : cases) EXPECT_THAT(Written(wrong.text).refusal(), HasSubstr(wrong.message)) << wrong.text;
}

TEST(JointInLua, AMistakeInARowIsTheRows) {
    const Wrong cases[] = {
        {"if s.area > 0.2 then error('worn out') end", "kaya-joint.lua:7: worn out"},
        {"s.normal_force = nil", "it left 'normal_force' as something that is not a number"},
        {"s.normal_force = 0/0", "returned normal force"},
        {"h.wear_depth = 'deep'", "it left 'wear_depth' as something that is not a number"},
        {"memory = 1", "'memory' is not local"},
        {"s.state = -1", "it left 'state' out of range"},
        {"s.normal_forse = 1", "kaya-joint.lua:7: the row has no 'normal_forse'; did you mean 'normal_force'?"},
        {"s.normal_force = s.normal_dsp", "the row has no 'normal_dsp'; did you mean 'normal_disp'?"},
        {"s.normal_force = p.stifness", "the list of properties has no 'stifness'; did you mean 'stiffness'?"},
        {"p.k = 2", "the list of properties can only be read"},
        {"p.kk = 2", "the list of properties has no 'kk'"},
        {"h.wear_dept = 1", "the history has no 'wear_dept'; did you mean 'wear_depth'?"},
        {"s[1] = 1", "the row has names, not numbers"},
        {"math.pie = 3", "'pie' is set in a library"},
        {"setmetatable(p, nil)", "cannot change a protected metatable"},
        {"rawset(s, 'x', 1)", "attempt to call a nil value (global 'rawset')"},
        {"s.normal_force = math.random()", "attempt to call a nil value (field 'random')"},
    };
    for (const auto& wrong : cases) {
        Written file(model_text(wrong.text));
        Rows rows(file.load(), {{"k", 1}}, 3);
        const auto failure = rows.step(-1e-6, 0, 0);
        ASSERT_TRUE(failure) << wrong.text;
        EXPECT_EQ(failure->row, 0u);
        EXPECT_THAT(failure->message, HasSubstr(wrong.message)) << wrong.text;
    }
}

TEST(JointInLua, TakesOtherWordsOfProperties) {
    Written file(model_text("s.normal_force = p.k + p.stiffness"));
    Rows rows(file.load(), {{"k", 3}}, 1);
    EXPECT_FALSE(rows.step(-1e-6, 0, 0));
    EXPECT_EQ(rows.columns[Rows::normal][0], 6);
}

TEST(JointInLua, NothingIsKeptInLocalVariablesOutsideOfItsFunctions) {
    const Wrong cases[] = {
        {"@math.pi = 3", "'pi' is changed by the functions of the model"},
        {"@print = 5", "'print' is changed by the functions of the model"},
        {"more = {1}\n@more[2] = 2", "'2' is set in a table that is kept from call to call"},
        {"local count = 0\n@count = count + 1", "'count' is changed by the functions of the model"},
        {"local kept = {n = 0}\n@kept.n = kept.n + 1", "'n' is set in a table that is kept from call to call"},
        {"local kept = {deep = {1, 2}}\n@kept.deep[3] = 1", "'3' is set in a table that is kept from call to call"},
        {"local list = {}\n@table.insert(list, 1)", "'1' is set in a table that is kept from call to call"},
        {"local n = 0\nlocal function more() n = n + 1 return n end\n@s.normal_force = more()",
         "'n' is changed by the functions of the model"},
    };
    for (const auto& wrong : cases) {
        const std::string text = wrong.text;
        const auto run = text.find('@');
        Written file(text.substr(0, run) + model_text(text.substr(run + 1)));
        Rows rows(file.load(), {{"k", 1}}, 2);
        const auto failure = rows.step(-1e-6, 0, 0);
        ASSERT_TRUE(failure) << wrong.text;
        EXPECT_THAT(failure->message, HasSubstr(wrong.message)) << wrong.text;
    }
}

TEST(JointInLua, ReadsLocalVariablesAndTablesOutsideOfItsFunctions) {
    Written file(
        "local list, none = {3, 4, name = {deep = 5}}, 0/0\nlocal function sum(t) local s = 0 for _, v in ipairs(t) do s = s + v end return s end\n" +
        model_text(
            "local n = 0 for _ in pairs(list) do n = n + 1 end "
            "s.normal_force = sum(list) + #list + list.name.deep + n + (none ~= none and 100 or 0) + math.floor(2.5)"));
    Rows rows(file.load(), {{"k", 1}}, 2);
    const auto failure = rows.step(-1e-6, 0, 0);
    ASSERT_FALSE(failure) << failure->message;
    EXPECT_EQ(rows.columns[Rows::normal][1], 7 + 2 + 5 + 3 + 100 + 2);
}

TEST(JointInLua, ReadsTheTablesOfTheDeck) {
    Written file(model_text("s.normal_force = table_value(3, 0.5); h.wear_depth = table_slope('3', 0.5); "
                            "if table_value(4, 0) then error('there is no table 4') end"));
    const auto& model = file.load();
    JointTables tables;
    tables.set_source([](const std::string& name) -> std::optional<JointTables::Points> {
        if (name == "3") return JointTables::Points{{0, 1}, {10, 20}};
        return std::nullopt;
    });
    Rows rows(model, {{"k", 1}}, 2);
    auto batch = rows.batch();
    batch.tables = tables.interface();
    EXPECT_FALSE(run_batch(model, batch)) << batch.message;
    EXPECT_EQ(rows.columns[Rows::normal][1], 15);
    EXPECT_EQ(rows.history[0][1], 10);
}

} // namespace
} // namespace kaya
