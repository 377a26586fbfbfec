#include "laws/property_roles.hpp"
#include "test_joint.hpp"

#include "base/diagnostic.hpp"
#include "laws/arithmetic.hpp"
#include "laws/stiffness_trial.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace kaya {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const fs::path shipped_folder = KAYA_SHIPPED_MODELS;
const fs::path plugin_folder = KAYA_TEST_PLUGINS;

/// The diagnostic of loading a model.
Diagnostic refusal(JointRegistry& registry, const std::string& name) {
    try {
        registry.get(name);
    } catch (const Diagnostic& diagnostic) { return diagnostic; }
    ADD_FAILURE() << name << " was loaded";
    return Diagnostic("");
}

Diagnostic refusal_of_plugin(const std::string& name) {
    JointRegistry registry;
    return refusal(registry, (plugin_folder / (name + ".so")).string());
}

TEST(JointRegistry, FindsAModelByKeywordInAnyCase) {
    JointRegistry registry;
    registry.set_path({plugin_folder / "no such folder", shipped_folder});
    const auto& mohr = registry.get("MOHR");
    EXPECT_EQ(mohr.name, "mohr");
    EXPECT_EQ(&registry.get("mohr"), &mohr);
    EXPECT_EQ(registry.find("mohr"), &mohr);
    EXPECT_EQ(registry.find("elastic"), nullptr);
    EXPECT_EQ(registry.loaded().size(), 1u);
}

TEST(JointRegistry, LoadsAFile) {
    JointRegistry registry;
    const auto& model = registry.get((plugin_folder / "works.so").string());
    EXPECT_EQ(model.name, "works");
    EXPECT_EQ(model.version, "1.0");
    EXPECT_THAT(model.states, ElementsAre("pushed"));
    EXPECT_EQ(&registry.get((plugin_folder / "." / "works.so").string()), &model);
    EXPECT_EQ(&registry.get("works"), &model);
}

TEST(JointRegistry, KnowsModelsByTheWordsOf3dec) {
    JointRegistry registry;
    registry.set_path({shipped_folder});
    EXPECT_EQ(registry.get("cyjm").name, "continuously-yielding");
    EXPECT_EQ(&registry.get("CYJM"), &registry.get("continuously-yielding"));
    EXPECT_EQ(JointRegistry::keyword_of("cyjm"), "continuously-yielding");
    EXPECT_EQ(JointRegistry::keyword_of("Mohr"), "mohr");
}

TEST(JointRegistry, FindsTheLibrariesOf3decByTheirContents) {
    const test::ScratchFolder scratch;
    const fs::path folder = scratch.path();
    fs::copy_file(plugin_folder / "works.so",
                  folder / "libjmodelsomething009.so"); // the file name differs from the model
    fs::copy_file(plugin_folder / "too-soft.so", folder / "jmodeltoo-soft007.so");
    fs::copy_file(plugin_folder / "no-entry.so", folder / "libjmodelbroken009.so");
    fs::copy_file(plugin_folder / "twin.so", folder / "jmodel-twin.so"); // not named like one
    JointRegistry registry;
    registry.set_path({folder});
    EXPECT_EQ(registry.get("works").file, folder / "libjmodelsomething009.so");
    EXPECT_EQ(registry.get("too-soft").file, folder / "jmodeltoo-soft007.so");
    EXPECT_EQ(&registry.get("works"), &registry.get((folder / "libjmodelsomething009.so").string()));
    EXPECT_EQ(refusal(registry, "something").message, "there is no joint model 'something'");
    EXPECT_THAT(refusal(registry, "broken").message, HasSubstr("is not a joint model"));
    EXPECT_THAT(registry.available(), testing::IsSupersetOf({"works", "too-soft", "something", "jmodel-twin"}));
}

TEST(JointRegistry, ListsAvailableModels) {
    JointRegistry registry;
    registry.set_path({shipped_folder});
    EXPECT_THAT(registry.available(), testing::IsSupersetOf({"barton-bandis", "elastic", "mohr"}));
    registry.get((plugin_folder / "works.so").string());
    EXPECT_THAT(registry.available(), testing::Contains("works"));
}

TEST(JointRegistry, ListsAvailableModelsWhenOneIsUnknown) {
    JointRegistry registry;
    registry.set_path({shipped_folder});
    const auto d = refusal(registry, "mohrr");
    EXPECT_EQ(d.message, "there is no joint model 'mohrr'");
    EXPECT_EQ(d.hint, "did you mean 'mohr'?");
    ASSERT_EQ(d.context.size(), 1u);
    EXPECT_THAT(d.context[0], HasSubstr("barton-bandis"));
    EXPECT_EQ(d.fault, Fault::deck);
}

TEST(JointRegistry, SaysThatNoModelsWereFoundAtAll) {
    JointRegistry registry;
    const auto d = refusal(registry, "mohr");
    ASSERT_EQ(d.context.size(), 1u);
    EXPECT_THAT(d.context[0], HasSubstr("no joint models were found"));
}

TEST(JointRegistry, RefusesAMissingFile) {
    JointRegistry registry;
    EXPECT_THAT(refusal(registry, "models/none.so").message, HasSubstr("there is no joint model file models/none.so"));
}

TEST(JointRegistry, RefusesATextFileAndAFolder) {
    const test::ScratchFolder scratch;
    const auto& folder = scratch.path();
    fs::create_directory(folder / "folder.so");
    std::ofstream(folder / "text.so") << "jmodel mohr\n";
    JointRegistry registry;
    EXPECT_THAT(refusal(registry, (folder / "text.so").string()).message, HasSubstr("text.so is not a shared library"));
    EXPECT_THAT(refusal(registry, (folder / "folder.so").string()).message,
                HasSubstr("folder.so is not a shared library"));
}

TEST(JointRegistry, RefusesATruncatedLibrary) {
    const test::ScratchFolder scratch;
    const auto file = scratch.path() / "truncated.so";
    for (const std::uintmax_t size : {20u, 100u, 1000u, 9000u}) {
        fs::copy_file(plugin_folder / "works.so", file, fs::copy_options::overwrite_existing);
        ASSERT_GT(fs::file_size(file), size);
        fs::resize_file(file, size);
        JointRegistry registry;
        EXPECT_THAT(refusal(registry, file.string()).message, HasSubstr("is cut off")) << size;
    }
}

TEST(JointRegistry, ReportsMissingSymbolsOfALibrary) {
    EXPECT_THAT(refusal_of_plugin("needs-more").hint, HasSubstr("function_that_nobody_has"));
}

TEST(JointRegistry, RefusesALibraryWithoutTheEntryPoint) {
    EXPECT_THAT(refusal_of_plugin("no-entry").message, HasSubstr("it has no function kaya_joint_model"));
}

TEST(JointRegistry, NamesBothInterfaceVersions) {
    const auto d = refusal_of_plugin("version-99");
    EXPECT_THAT(d.message, HasSubstr("was built for interface version 99, this program has version " +
                                     std::to_string(KAYA_JMODEL_INTERFACE)));
    EXPECT_EQ(d.code, "joint-model-version");
    EXPECT_THAT(d.hint, HasSubstr("use a newer program"));
    EXPECT_THAT(refusal_of_plugin("interface-1").hint, HasSubstr("build the model again"));
}

TEST(JointRegistry, LoadsALibraryOfAnOlderInterface) {
    JointRegistry registry;
    const auto& model = registry.get((plugin_folder / "interface-2.so").string());
    EXPECT_EQ(model.descriptor().interface_version, 2u);
    EXPECT_TRUE(model.fields.empty());
    EXPECT_FALSE(model.needs_place());
    const auto stiffness = initial_stiffness(model, {5});
    EXPECT_EQ(stiffness.normal, 5);
}

TEST(JointRegistry, ReadsNoRolesOfALibraryThatHasNone) {
    JointRegistry registry;
    const auto& model = registry.get((plugin_folder / "interface-3.so").string());
    EXPECT_EQ(model.descriptor().interface_version, 3u);
    EXPECT_EQ(model.properties[0].role, KAYA_JROLE_FRICTION) << "by its name";
    EXPECT_EQ(model.properties[1].role, KAYA_JROLE_NONE);
}

TEST(JointRegistry, ReadsRolesThatPropertiesState) {
    JointRegistry registry;
    const auto& model = registry.get((plugin_folder / "own-words.so").string());
    const std::vector<double> values{1e9, 5e8, 30, NAN, 45};
    EXPECT_EQ(find_role(model, KAYA_JROLE_FRICTION), 2u);
    EXPECT_EQ(value_of_role(model, values, KAYA_JROLE_FRICTION), 30);
    EXPECT_EQ(value_of_role(model, values, KAYA_JROLE_COHESION), std::nullopt) << "no value";
    EXPECT_EQ(value_of_role(model, values, KAYA_JROLE_TENSION), std::nullopt) << "no property";
    EXPECT_EQ(model.properties[4].role, KAYA_JROLE_NONE) << "stated against its name";
}

TEST(JointRegistry, KnowsTheRolesOfNames) {
    EXPECT_EQ(role_by_name("friction", "angle"), KAYA_JROLE_FRICTION);
    EXPECT_EQ(role_by_name("friction", "-"), KAYA_JROLE_NONE) << "a coefficient is no angle";
    EXPECT_EQ(role_by_name("friction-residual", "angle"), KAYA_JROLE_FRICTION_RESIDUAL);
    EXPECT_EQ(role_by_name("friction-static", "angle"), KAYA_JROLE_FRICTION_OTHER);
    EXPECT_EQ(role_by_name("cohesion-2", "stress"), KAYA_JROLE_STRENGTH_OTHER);
    EXPECT_EQ(role_by_name("tension", "stress"), KAYA_JROLE_TENSION);
    EXPECT_EQ(role_by_name("dilation", "angle"), KAYA_JROLE_DILATION);
    EXPECT_EQ(role_by_name("dilation", "-"), KAYA_JROLE_NONE);
    EXPECT_EQ(role_by_name("phi", "angle"), KAYA_JROLE_NONE);
    EXPECT_EQ(role_by_name("none", ""), KAYA_JROLE_NONE);
    EXPECT_EQ(role_by_name("strength-factor", "-"), KAYA_JROLE_STRENGTH_FACTOR);
}

TEST(JointRegistry, RefusesARoleThatMeansNothing) {
    EXPECT_THAT(refusal_of_plugin("wrong-role").message,
                HasSubstr("the role of property 'stiffness' is 99, which means nothing"));
}

TEST(JointRegistry, TakesAModelAsLargeAsTheHeaderSays) {
    JointRegistry registry;
    const auto& model = registry.get((plugin_folder / "many-properties.so").string());
    EXPECT_EQ(model.properties.size(), 256u);
    EXPECT_EQ(model.history.size(), 64u);
    EXPECT_EQ(model.states.size(), 32u);
    std::vector<double> values(256, 1);
    values.back() = 7;
    EXPECT_EQ(initial_stiffness(model, values).shear, 7);
}

TEST(JointRegistry, RestoresTheProcessorStateAfterALibraryIsLoaded) {
    JointRegistry registry;
    volatile double small = 1e-310;
    const auto& model = registry.get((plugin_folder / "cuts-at-load.so").string());
    EXPECT_GT(small * 1.0, 0); // it would be cut to 0
#if defined(__SSE2__)
    EXPECT_EQ(model.arithmetic(), unsigned{small_numbers_cut});
#endif
    EXPECT_EQ(registry.get((plugin_folder / "works.so").string()).arithmetic(), 0u);
}

TEST(JointRegistry, RefusesAModelThatWritesToReadOnlyColumnsBeforeItRuns) {
    JointRegistry registry;
    for (const auto& [name, sentence] : {std::pair{"writes-area", "wrote to 'area', which it may only read"},
                                         std::pair{"writes-behind", "wrote after the column 'shear_force'"}}) {
        const auto& model = registry.get((plugin_folder / (std::string(name) + ".so")).string());
        try {
            initial_stiffness(model, {5});
            ADD_FAILURE() << name;
        } catch (const Diagnostic& d) {
            EXPECT_THAT(d.message, HasSubstr(sentence));
            EXPECT_EQ(d.code, "joint-model-trespass");
        }
    }
}

TEST(JointRegistry, SurvivesAnExceptionWhileLoading) {
    EXPECT_THAT(refusal_of_plugin("throws-at-load").message, HasSubstr("cannot say what it is: "));
}

TEST(JointRegistry, SurvivesACrashWhileLoading) {
    for (const char* name : {"crashes-at-load", "crashes-when-asked"}) {
        const auto d = refusal_of_plugin(name);
        EXPECT_THAT(d.message, HasSubstr("crashes when it is loaded (signal")) << name;
        EXPECT_EQ(d.code, "joint-model-crashes");
    }
    EXPECT_THAT(refusal_of_plugin("exits-at-load").message, HasSubstr("ends the program when it is loaded"));
}

TEST(JointRegistry, StopsWaitingForALibraryThatNeverFinishesLoading) {
    const auto d = refusal_of_plugin("slow/loops-at-load");
    EXPECT_THAT(d.message, HasSubstr("does not come back within 30 seconds when it is loaded"));
    EXPECT_EQ(d.code, "joint-model-crashes");
}

TEST(JointRegistry, KeepsNothingOfARefusedLibrary) {
    JointRegistry registry;
    refusal(registry, (plugin_folder / "version-99.so").string());
    EXPECT_TRUE(registry.loaded().empty());
    EXPECT_EQ(registry.get((plugin_folder / "works.so").string()).name, "works");
}

struct WrongTable {
    const char* plugin;
    const char* sentence;
};

class JointTable : public testing::TestWithParam<WrongTable> {};

TEST_P(JointTable, IsRefusedWithItsReason) {
    const auto d = refusal_of_plugin(GetParam().plugin);
    EXPECT_THAT(d.message, HasSubstr(GetParam().sentence));
    EXPECT_FALSE(d.hint.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, JointTable,
    testing::Values(WrongTable{"no-descriptor", "kaya_joint_model() returned NULL"},
                    WrongTable{"other-size", "its size is 8 bytes, it must be "},
                    WrongTable{"null-name", "'name' is NULL"}, WrongTable{"null-run", "'run' is NULL"},
                    WrongTable{"null-initialise", "'initialise' is NULL"},
                    WrongTable{"null-stiffness", "'max_stiffness' is NULL"},
                    WrongTable{"empty-name", "'' cannot be typed"},
                    WrongTable{"negative-count", "it has 18446744073709551615 history variables, 64 at most"},
                    WrongTable{"untypable-name", "'My Model' cannot be typed"},
                    WrongTable{"missing-table", "it says 1 properties but gives no table"},
                    WrongTable{"too-many-properties", "it has 1000000 properties, 256 at most"},
                    WrongTable{"too-much-history", "it has 65 history variables, 64 at most"},
                    WrongTable{"too-many-states", "it has 33 states, 32 at most"},
                    WrongTable{"nameless-field", "field 1 has no name"},
                    WrongTable{"too-many-fields", "it has 100 fields, 8 at most"},
                    WrongTable{"two-of-a-name", "the word 'k' stands for 'stiffness' and for 'key'"},
                    WrongTable{"nameless-property", "property 1 has no name"},
                    WrongTable{"nan-limits", "the limits of property 'stiffness' are nan and 2"},
                    WrongTable{"initial-outside", "the initial value of property 'stiffness' is 5"}),
    [](const auto& parameter) {
        std::string name = parameter.param.plugin;
        std::erase(name, '-');
        return name;
    });

TEST(JointRegistry, AFileOfTheFoldersHasTheNameOfItsModel) {
    JointRegistry registry;
    registry.set_path({plugin_folder});
    const auto d = refusal(registry, "other-name");
    EXPECT_THAT(d.message, HasSubstr("holds a joint model named 'something-else'"));
    EXPECT_THAT(d.hint, HasSubstr("something-else.so"));
}

TEST(JointRegistry, AFileElsewhereMayHaveAnyName) {
    EXPECT_EQ(JointRegistry().get((plugin_folder / "other-name.so").string()).name, "something-else");
}

TEST(JointRegistry, ANameThatIsLoadedIsTaken) {
    JointRegistry registry;
    registry.get((shipped_folder / "mohr.so").string());
    EXPECT_THAT(refusal(registry, (plugin_folder / "twin.so").string()).message,
                HasSubstr("is named 'mohr', and that name belongs to"));
}

TEST(JointRegistry, ANameInTheFoldersIsTakenBeforeItIsLoaded) {
    JointRegistry registry;
    registry.set_path({shipped_folder});
    EXPECT_THAT(refusal(registry, (plugin_folder / "twin.so").string()).message, HasSubstr("that name belongs to"));
    EXPECT_EQ(registry.get("mohr").file, shipped_folder / "mohr.so");
}

} // namespace
} // namespace kaya
