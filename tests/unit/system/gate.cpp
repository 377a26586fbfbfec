#include "system/gate.hpp"

#include "base/diagnostic.hpp"
#include "base/sha256.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace kaya {
namespace {

namespace fs = std::filesystem;

/// work/ is the folder of the run, secret/ is next to it.
class GateTest : public testing::Test {
protected:
    GateTest() {
        folder = fs::canonical(scratch.path());
        work = folder / "work";
        for (const auto* sub : {"work", "secret", "joints"}) fs::create_directory(folder / sub);
        write(folder / "secret/file");
        gate.shut({.folders = {work},
                   .named = {},
                   .libraries = {folder / "joints"},
                   .own = {},
                   .digests = {sha256("\x7f"
                                      "ELF mine")},
                   .permissions = work / "allowed"});
    }

    static void write(const fs::path& file, const std::string& text = "text") { std::ofstream(file) << text; }

    /// The code of the refusal; empty if it is permitted.
    template <class Ask> static std::string refused(Ask ask) {
        try {
            ask();
            return {};
        } catch (const Diagnostic& error) { return error.code; }
    }
    std::string read(const fs::path& file) {
        return refused([&] { gate.may_read(file); });
    }
    std::string written(const fs::path& file) {
        return refused([&] { gate.may_write(file); });
    }
    std::string loaded(const fs::path& file) {
        return refused([&] { gate.may_load(file); });
    }

    test::ScratchFolder scratch;
    std::error_code ignored;
    fs::path folder, work;
    Gate gate;
};

TEST(Sha256, GivesTheDigestsOfTheStandard) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_F(GateTest, AllowsPathsBelowItsFolders) {
    EXPECT_EQ(read(work / "a/b.txt"), "");
    EXPECT_EQ(written(work / "new.csv"), "");
    EXPECT_EQ(written(work / "../work/new.csv"), "");
}

TEST_F(GateTest, RefusesOtherPathsInAnySpelling) {
    for (const auto* path : {"../secret/file", "a/../../secret/file", "../secret/none", "../work2/file"}) {
        EXPECT_EQ(read(work / path), "file-outside") << path;
        EXPECT_EQ(written(work / path), "file-outside") << path;
    }
}

TEST_F(GateTest, FollowsLinksIncludingDanglingOnes) {
    fs::create_symlink("../secret", work / "folder");
    fs::create_symlink("../secret/none", work / "dangling");
    fs::create_symlink("dangling", work / "twice");
    fs::create_symlink("round", work / "round");
    for (const auto* name : {"folder/file", "folder/none", "dangling", "twice", "round"}) {
        EXPECT_EQ(read(work / name), "file-outside") << name;
        EXPECT_EQ(written(work / name), "file-outside") << name;
    }
    write(work / "here");
    fs::create_symlink("here", work / "link");
    EXPECT_EQ(read(work / "link"), "");
}

TEST_F(GateTest, RefusesFilesOfTwoNamesPipesAndTheSystem) {
    fs::create_hard_link(folder / "secret/file", work / "hard");
    ASSERT_EQ(mkfifo((work / "pipe").c_str(), 0600), 0);
    fs::create_symlink("/proc/self", work / "self");
    for (const auto* name : {"hard", "pipe", "self/environ", "self/cwd/../secret"}) {
        EXPECT_NE(read(work / name), "") << name;
        EXPECT_NE(written(work / name), "") << name;
    }
}

TEST_F(GateTest, WritesNoHiddenFileNoLibraryNoDeckInUse) {
    write(work / "deck.3dd");
    gate.may_read_code(work / "deck.3dd");
    EXPECT_EQ(written(work / "deck.3dd"), "file-in-use");
    fs::create_symlink("deck.3dd", work / "other");
    EXPECT_EQ(written(work / "other"), "file-in-use");
    EXPECT_EQ(written(work / "allowed"), "file-in-use");
    for (const auto* name : {".bashrc", ".git/hooks/x", "law.so", "law.so.1.2"})
        EXPECT_EQ(written(work / name), "file-hidden") << name;
    EXPECT_EQ(written(work / "law.solo"), "");
    EXPECT_EQ(read(work / ".settings"), "");
}

TEST_F(GateTest, LoadsLibrariesOfItsFoldersAndThoseOfKnownDigest) {
    write(folder / "joints/law.so"), write(work / "law.so"), write(work / "picture.png");
    write(work / "mine.so", "\x7f"
                            "ELF mine");
    fs::create_symlink(work / "picture.png", folder / "joints/link.so");
    EXPECT_EQ(loaded(folder / "joints/law.so"), "");
    EXPECT_EQ(loaded(work / "mine.so"), "");
    EXPECT_EQ(loaded(work / "law.so"), "library-not-allowed");
    EXPECT_EQ(loaded(folder / "joints/link.so"), "library-not-allowed");
    write(work / "mine.so", "\x7f"
                            "ELF nine");
    EXPECT_EQ(loaded(work / "mine.so"), "library-not-allowed");
}

TEST_F(GateTest, LoadsTheContentsThatItHasCompared) {
    const std::string mine = "\x7f"
                             "ELF mine";
    write(work / "mine.so", mine), write(folder / "joints/law.so", "law"), write(work / "other.so", "other");
    const fs::path name = gate.may_load(work / "mine.so");
    EXPECT_EQ(gate.may_load(work / "mine.so"), name) << "the loader would take it for another library";
    write(work / "mine.so", "\x7f"
                            "ELF nine"); // in place
    const auto text = [](const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    EXPECT_EQ(text(name), mine);
    fs::rename(work / "other.so", work / "mine.so");
    EXPECT_EQ(text(name), mine);
    write(name, "none");
    fs::resize_file(name, 2, ignored);
    EXPECT_EQ(text(name), mine) << "the copy can be changed";
    // A link that leads to an allowed folder while the gate looks.
    fs::create_symlink(folder / "joints/law.so", work / "link.so");
    const fs::path behind = gate.may_load(work / "link.so");
    fs::remove(work / "link.so"), write(work / "link.so", "other");
    EXPECT_EQ(text(behind), "law");
}

TEST_F(GateTest, AScriptOfAJointModelMayBeReadUnlessTheRunWroteIt) {
    write(work / "law.lua"), write(work / "fresh.lua");
    EXPECT_EQ(loaded(work / "law.lua"), "");
    gate.may_write(work / "fresh.lua");
    EXPECT_EQ(loaded(work / "fresh.lua"), "library-not-allowed");
    EXPECT_EQ(loaded(folder / "secret/law.lua"), "file-outside");
}

TEST_F(GateTest, NamesTheCommandThatAllowsIt) {
    try {
        gate.may_write(work / "../secret/it's");
        FAIL();
    } catch (const Diagnostic& error) {
        EXPECT_NE(error.hint.find("kaya allow " + (work / "../secret").string()), error.hint.npos) << error.hint;
    }
}

TEST_F(GateTest, AnOpenGateKeepsTheDeckAlone) {
    Gate open;
    open.may_read_code(work / "deck.3dd");
    EXPECT_EQ(refused([&] { open.may_write(work / "deck.3dd"); }), "file-in-use");
    EXPECT_EQ(refused([&] { open.may_write(folder / "secret/file"); }), "");
    EXPECT_EQ(refused([&] { open.may_load(work / "any"); }), "");
}

} // namespace
} // namespace kaya
