// Names of modern FISH: each reads and writes the field that the classic name and Lua read and write.
#include "running.hpp"

#include "lang/script/values/value_text.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace kaya {
namespace {

using script::Handle;
using script::Value;

bool same(const Value& a, const Value& b) {
    const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    if (x != nullptr && y != nullptr) return *x == *y || (std::isnan(*x) && std::isnan(*y));
    const auto is_null = [](const Value& v) {
        const auto* handle = std::get_if<Handle>(&v);
        return v == Value(std::int64_t{0}) || (handle != nullptr && handle->generation == 0);
    };
    return a == b || (is_null(a) && is_null(b));
}

/// Another value of the same kind.
Value other(const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return std::isnan(*number) ? 1.0 : *number + 0.5;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole + 1;
    if (const auto* vector = std::get_if<Vec3>(&value)) return Vec3(*vector + Vec3(0.25, -0.5, 0.75));
    return std::string("elsewhere");
}

Options with_joint_models() {
    Options options;
    options.joint_folders = {KAYA_TEST_JOINTS};
    return options;
}

class ModernIntrinsics : public Running {
protected:
    /// A rigid block below one with zones.
    ModernIntrinsics() : Running(with_joint_models()) {
        run("poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\ngen edge 2 range z 1 2\nprop mat 1 dens 2000 k 1e9 g 1e9\n"
            "prop jmat 1 jkn 1e9 jks 1e9 jfric 30\ngroup block Low range z 0 1\ngravity 0 0 -10\nfix range z 0 1\ncycle 5\n");
    }

    /// The message of an expression that is refused.
    std::string refused(const std::string& expression) {
        try {
            value(expression);
        } catch (const Diagnostic& mistake) { return mistake.message + ": " + mistake.hint; }
        return "accepted";
    }

    Value value(const std::string& expression) { return session().engine.scripts->value("[" + expression + "]"); }
    std::string shown(const std::string& expression) {
        return script::to_text(value("string(" + expression + ")"), &session().engine.world);
    }

    /// Visits each field with a modern name, of an object that has it: of gridpoints the last one, which belongs to zones.
    template <class Visit> int for_each_field(Visit visit) {
        script::World& world = session().engine.world;
        int count = 0;
        for (std::size_t t = 0; t < world.tables().size(); ++t) {
            const auto& table = world.tables()[t];
            const auto objects = world.count(static_cast<std::int32_t>(t));
            if (objects == 0) continue;
            const Handle object = world.at(static_cast<std::int32_t>(t), table.modern == "block.gp" ? objects - 1 : 0);
            for (std::size_t i = 0; i < table.fields.size(); ++i) {
                if (table.fields[i].modern.empty()) continue;
                session().engine.scripts->set("p", object);
                visit(table.fields[i], object, i);
                ++count;
            }
        }
        return count;
    }
};

TEST_F(ModernIntrinsics, EveryFieldReadsTheSameUnderEachName) {
    const int fields = for_each_field([&](const script::FieldInfo& field, const Handle& object, std::size_t i) {
        const std::string name(field.modern);
        const Value wanted = session().engine.world.get(object, i);
        EXPECT_TRUE(same(value(name + "(p)"), wanted)) << name;
        if (!field.classic.empty()) { EXPECT_TRUE(same(value(fmt::format("{}(p)", field.classic)), wanted)) << name; }
        const std::string member = name.substr(session().engine.world.tables()[object.table].modern.size() + 1);
        if (member.find('.') == member.npos) { EXPECT_TRUE(same(value("p->" + member), wanted)) << name; }
        const auto* vector = std::get_if<Vec3>(&wanted);
        if (vector == nullptr) {
            EXPECT_THROW(value(name + "(p,1)"), Diagnostic) << name;
            return;
        }
        for (int k = 0; k < 3; ++k) {
            EXPECT_TRUE(same(value(fmt::format("{}(p,{})", name, k + 1)), (*vector)[k])) << name;
            EXPECT_TRUE(same(value(fmt::format("{}(p)->{}", name, "xyz"[k])), (*vector)[k])) << name;
            EXPECT_TRUE(same(value(fmt::format("{}.{}(p)", name, "xyz"[k])), (*vector)[k])) << name;
        }
        EXPECT_THROW(value(name + "(p,4)"), Diagnostic) << name;
    });
    EXPECT_GT(fields, 100);
    const auto& globals = session().engine.world.globals();
    for (std::size_t i = 0; i < globals.size(); ++i) {
        if (globals[i].modern.empty()) continue;
        const Value wanted = session().engine.world.get(script::World::whole_model, i);
        EXPECT_TRUE(same(value(std::string(globals[i].modern)), wanted)) << globals[i].modern;
    }
}

TEST_F(ModernIntrinsics, EveryWritableFieldIsSetByItsModernName) {
    int written = 0;
    for_each_field([&](const script::FieldInfo& field, const Handle& object, std::size_t i) {
        const std::string name(field.modern);
        script::World& world = session().engine.world;
        const Value before = world.get(object, i), wanted = other(before);
        session().engine.scripts->set("v", wanted);
        if (!field.writable) {
            EXPECT_THROW(value(name + "(p) = v"), Diagnostic) << name;
            return;
        }
        world.set(object, i, wanted);
        const Value after = world.get(object, i);
        world.set(object, i, before);
        value(name + "(p) = v");
        EXPECT_TRUE(same(world.get(object, i), after)) << name;
        if (const auto* vector = std::get_if<Vec3>(&before)) {
            world.set(object, i, before);
            value(name + "(p)->y = 7.5");
            EXPECT_TRUE(same(world.get(object, i), Value(Vec3((*vector)[0], 7.5, (*vector)[2])))) << name;
            world.set(object, i, before);
            value(name + "(p,3) = 2.5");
            EXPECT_TRUE(same(world.get(object, i), Value(Vec3((*vector)[0], (*vector)[1], 2.5)))) << name;
        }
        ++written;
        world.set(object, i, before);
    });
    EXPECT_GT(written, 25);
}

TEST_F(ModernIntrinsics, OtherNamesAreThoseOfTheClassicFunctions) {
    for (const auto& [modern, classic] : session().engine.scripts->newer_names()) {
        const auto of_modern = session().engine.scripts->meaning_of(modern);
        EXPECT_EQ(of_modern.kind, fish::NameKind::built_in) << modern;
        const auto of_classic = session().engine.scripts->meaning_of(classic);
        if (of_classic.kind != fish::NameKind::built_in) continue; // a field without a classic name
        EXPECT_EQ(of_modern.least, of_classic.least) << modern;
        EXPECT_EQ(of_modern.writable, of_classic.writable) << modern;
    }
}

TEST_F(ModernIntrinsics, EveryKindOfObjectIsFoundCountedAndListed) {
    script::World& world = session().engine.world;
    for (std::size_t t = 0; t < world.tables().size(); ++t) {
        const std::string kind(world.tables()[t].modern);
        if (kind.empty()) continue;
        const auto count = static_cast<std::int64_t>(world.count(static_cast<std::int32_t>(t)));
        ASSERT_GT(count, 0) << kind;
        EXPECT_EQ(value(kind + ".num"), Value(count)) << kind;
        EXPECT_EQ(value(fmt::format("list.size({}.list)", kind)), Value(count)) << kind;
        EXPECT_EQ(value(kind + ".maxid"), value(fmt::format("{0}.id({0}.find({0}.maxid))", kind))) << kind;
        EXPECT_EQ(value(fmt::format("({0}.find({0}.id({0}.head)) = {0}.head)", kind)), Value(std::int64_t{1})) << kind;
        EXPECT_EQ(value(kind + ".find(1000000)"), Value(std::int64_t{0})) << kind;
        EXPECT_EQ(value(fmt::format("{0}.list->size - {0}.num", kind)), Value(std::int64_t{0})) << kind;
        EXPECT_NE(value(kind + ".near(0.5,0.5,1)"), Value(std::int64_t{0})) << kind;
        EXPECT_THROW(value(kind + ".find('a')"), Diagnostic) << kind;
    }
}

TEST_F(ModernIntrinsics, QuantitiesThatFollowFromOthers) {
    const std::pair<const char*, const char*> cases[] = {
        {"block.isrigid(block.find(1))", "1"},
        {"block.isrigid(block.find(2))", "0"},
        {"block.isgroup(block.find(1), 'LOW')", "1"},
        {"block.isgroup(block.find(2), 'low')", "0"},
        {"list.size(block.contactlist(block.find(1))) - block.contact.num", "0"},
        {"block.face.bface(block.face.head) = block.face.head", "1"},
        {"list.size(block.face.gplist(block.face.head)) - block.face.ngp(block.face.head)", "0"},
        {"mech.solve('ratio-local') = mech.ratio.local", "1"},
        {"mech.time.total = mech.time", "1"},
        {"block.zone.stress(block.zone.head)->zz = block.zone.stress.zz(block.zone.head)", "1"},
        {"block.zone.stress(block.zone.head,3) = block.zone.stress.zz(block.zone.head)", "1"},
        {"block.zone.stress(block.zone.head,1,3) = block.zone.stress.xz(block.zone.head)", "1"},
        {"block.subcontact.stress.norm(block.subcontact.head) * block.subcontact.area(block.subcontact.head) - "
         "block.subcontact.force.norm(block.subcontact.head) < 1e-6",
         "1"},
    };
    for (const auto& [expression, wanted] : cases) EXPECT_EQ(shown(expression), wanted) << expression;
    run("fish define set_stress\n  block.zone.stress(block.zone.head) = tensor(1,2,3,4,5,6)\n"
        "  block.zone.stress(block.zone.head)->xy = 40\nend\n[set_stress]\n");
    EXPECT_EQ(shown("block.zone.stress(block.zone.head)"), "(1,2,3,40,5,6)");
    EXPECT_EQ(value("z_sxy(block.zone.head)"), Value(40.0));
}

TEST_F(ModernIntrinsics, WrongPointersAreNamedAsTheDeckNamesThem) {
    const std::pair<const char*, const char*> cases[] = {
        {"block.gp.pos(0)", "'block.gp.pos' is given a null pointer"},
        {"block.gp.pos(block.head)", "'block.gp.pos' needs a pointer to a gridpoint"},
        {"block.zone.stress(block.head)", "'block.zone.stress' needs a pointer to a zone"},
        {"block.isgroup(1, 'a')", "'block.isgroup' needs a pointer to a block"},
        {"block.vol(block.head, 1)", "has no components"},
        {"block.head->poss", "has no 'poss'"},
        {"block.vol(block.head) = 3", "can be read, not set"},
    };
    for (const auto& [expression, message] : cases) {
        try {
            value(expression);
            ADD_FAILURE() << expression;
        } catch (const Diagnostic& problem) { EXPECT_THAT(problem.message, testing::HasSubstr(message)) << expression; }
    }
}

/// A deck of today and its classic twin leave the same model, to the last bit.
TEST_F(ModernIntrinsics, BothDialectsDriveTheSameRun) {
    run("def push_classic\n  local g = b_gp(b_near(0.5,0.5,1.5))\n  loop while g # 0\n    gp_xvel(g) = 0.01 * gp_z(g)\n"
        "    gp_zload(g) = gp_zload(g) - 100 * gp_x(g)\n    g = gp_next(g)\n  endloop\nend\n"
        "fish define push_modern\n  loop foreach local g block.gplist(block.near(0.5,0.5,1.5))\n"
        "    block.gp.vel(g)->x = 0.01 * g->pos->z\n    block.gp.force.app(g,3) -= 100 * block.gp.pos.x(g)\n  endloop\nend\n"
        "save start\n");
    const auto hash_after = [&](const char* line) {
        run(std::string("restore start\n") + line + "\ncycle 30\n");
        return shown("command_output('list hash')");
    };
    const std::string classic = hash_after("@push_classic");
    EXPECT_THAT(classic, testing::HasSubstr("hash"));
    EXPECT_EQ(hash_after("[push_modern]"), classic);
    EXPECT_NE(hash_after(""), classic);
}

/// Each name with points, with each of its parts shortened to the letters that no other name begins with.
TEST_F(ModernIntrinsics, NamesMayBeShortenedInEachPart) {
    std::vector<std::string> names;
    for (const auto& [name, writable] : session().engine.scripts->built_in_names())
        if (name.find('.') != name.npos) names.push_back(name);
    ASSERT_GT(names.size(), 150u);
    int unique = 0;
    for (const std::string& name : names) {
        std::string part = name.substr(0, name.size() - 1); // its last letter dropped
        if (part.ends_with('.')) continue;
        std::vector<std::string> fitting;
        for (const std::string& other : names)
            if (other.starts_with(part) && other.find('.', part.size()) == other.npos) fitting.push_back(other);
        const auto meaning = session().engine.scripts->meaning_of(part);
        if (std::ranges::find(names, part) != names.end()) continue; // a name itself
        if (fitting.size() == 1) {
            EXPECT_EQ(meaning.whole, name) << part;
            ++unique;
        } else {
            EXPECT_NE(meaning.kind, fish::NameKind::built_in) << part;
        }
    }
    EXPECT_GT(unique, 100);
    EXPECT_EQ(shown("bl.gp.di(block.gp.near(0,0,2))"), shown("block.gp.disp(block.gp.near(0,0,2))"));
    EXPECT_EQ(shown("block.z.str.xx(block.zone.head)"), shown("block.zone.stress.xx(block.zone.head)"));
    run("[block.gp.ve.x(block.gp.near(0,0,2)) = 0.25]\n[g = block.gp.near(0,0,2)]\n");
    EXPECT_EQ(value("block.gp.vel.x(g)"), Value(0.25));
    EXPECT_THAT(refused("block.gp.p(g)"),
                testing::StartsWith("'block.gp.p' shortens several names of FISH: one of: block.gp.pos"));
    EXPECT_THAT(refused("blok.gp.pos(g)"), testing::HasSubstr("there is no FISH variable or function 'blok.gp.pos'"));
}

TEST_F(ModernIntrinsics, FunctionsRunAtTheEventsOfASolve) {
    run("[n = 0]\n[m = 0]\nfish define begins\n  n += 1\nend\nfish define ends\n  m += 10\nend\n"
        "fish callback add begins event solve_start\nfish callback add ends event solve-complete\n"
        "fish callback add ends 10.0\nsolve cycles 3\ncycle 2\n");
    EXPECT_EQ(value("n"), Value(std::int64_t{1}));
    EXPECT_EQ(value("m"), Value(std::int64_t{60})) << "in five cycles, and at the end of the solve";
    run("fish callback remove ends 10.0\nsolve cycles 3\n");
    EXPECT_EQ(value("n"), Value(std::int64_t{2}));
    EXPECT_EQ(value("m"), Value(std::int64_t{70}));
    run("fish callback remove ends\nfish callback remove begins event solve_start\nsolve cycles 3\n");
    EXPECT_EQ(value("n"), Value(std::int64_t{2}));
    EXPECT_EQ(value("m"), Value(std::int64_t{70}));
}

TEST_F(ModernIntrinsics, BracketsOverSeveralLinesRunLineByLine) {
    run("[\n  global width = 3 ; as wide as two\n  area = width * ...\n    2\n]\n[x = width] [y = x + 1]\n");
    EXPECT_EQ(value("area"), Value(std::int64_t{6}));
    EXPECT_EQ(value("y"), Value(std::int64_t{4}));
    run("[\nhalf = 7 / 2\n]\n");
    EXPECT_EQ(value("half"), Value(3.5)) << "of the modern dialect";
}

TEST_F(ModernIntrinsics, YoungAndPoissonGiveTheModuliOfAZoneModel) {
    const auto sag = [&](const std::string& moduli) {
        run("new\npoly brick 0 1 0 1 0 1\ngen edge 1\nblock zone cmodel assign elastic\nblock zone property " + moduli +
            " density 2000\ngravity 0 0 -10\nbound zvel 0 range z 0\ncycle 40\n");
        return std::get<double>(value("block.gp.disp.z(block.gp.near(0,0,1))"));
    };
    const double by_young = sag("young 1e9 poisson 0.25");
    EXPECT_NE(by_young, 0);
    EXPECT_EQ(by_young, sag(fmt::format("bulk {:.17g} shear 4e8", 1e9 / 1.5)));
    EXPECT_NE(by_young, sag("bulk 1e9 shear 4e8"));
    const auto refused_line = [&](const std::string& line) {
        try {
            run(line);
        } catch (const Diagnostic& mistake) { return mistake.message; }
        return std::string("accepted");
    };
    EXPECT_EQ(refused_line("block zone property young 1e9\n"), "'young' and 'poisson' must stand on one line");
    EXPECT_EQ(refused_line("block zone property poisson 0.2 young 0\n"), "'young' must be above 0");
    EXPECT_EQ(refused_line("block zone property poisson 0.5 young 1\n"), "'poisson' must be above -1 and below 0.5");
}

} // namespace
} // namespace kaya
