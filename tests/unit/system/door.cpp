#include "system/door.hpp"

#include "base/diagnostic.hpp"
#include "system/whole_file.hpp"
#include "tests/unit/refused_calls.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <sys/stat.h>
#include <sys/wait.h>

namespace kaya {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::put;

/// work/ is allowed, out/ is next to it. With and without openat2.
class DoorTest : public testing::TestWithParam<bool> {
protected:
    DoorTest() : folder(fs::canonical(scratch.path())), work(folder / "work"), out(folder / "out") {
        fs::create_directories(work / "sub"), fs::create_directory(out);
        put(out / "victim", "secret");
        put(work / "mine", "mine");
        auto gate = std::make_shared<Gate>();
        gate->shut({.folders = {work}, .named = {}, .libraries = {}, .own = {}, .digests = {}, .permissions = {}});
        door::set_gate(std::move(gate));
    }
    ~DoorTest() override { door::set_gate(nullptr); }

    /// In a separate process, with or without openat2. Its exit status is 0 if no check failed.
    int in_child(const std::function<void()>& action) const {
        const pid_t child = ::fork();
        if (child == 0) {
            if (!GetParam()) test::refuse_call(SYS_openat2, ENOSYS);
            action();
            std::_Exit(testing::Test::HasFailure() ? 1 : 0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return status;
    }

    static bool refused(const std::function<void()>& action) {
        try {
            action();
            return false;
        } catch (const Diagnostic&) { return true; }
    }

    test::ScratchFolder scratch;
    fs::path folder, work, out;
};
INSTANTIATE_TEST_SUITE_P(Kernels, DoorTest, testing::Bool());

TEST_P(DoorTest, OpensFilesInItsFoldersAndLinksWithinThem) {
    fs::create_symlink("../mine", work / "sub/link");
    EXPECT_EQ(in_child([&] {
                  EXPECT_EQ(read_whole_file(work / "mine"), "mine");
                  EXPECT_EQ(read_whole_file(work / "sub/../sub/link"), "mine");
                  write_whole_file(work / "sub/link", "new");
                  EXPECT_TRUE(fs::is_symlink(work / "sub/link"));
                  EXPECT_EQ(content_of(work / "mine"), "new");
                  EXPECT_FALSE(door::make_folders(work / "a/b/c", Use::write));
                  write_whole_file(work / "a/b/c/file", "deep");
                  EXPECT_EQ(file_text(work / "a/b/c/file"), "deep");
                  EXPECT_EQ(file_text(work / "none"), std::nullopt);
                  EXPECT_EQ(file_text(work / "sub"), std::nullopt);
              }),
              0);
}

TEST_P(DoorTest, RefusesPathsOutsideForEachUse) {
    fs::create_symlink(out / "victim", work / "link");
    fs::create_symlink("../out/none", work / "dangling");
    fs::create_symlink("../out", work / "folder");
    fs::create_hard_link(out / "victim", work / "hard");
    ASSERT_EQ(::mkfifo((work / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(in_child([&] {
                  for (const char* name : {"link", "dangling", "folder/victim", "folder/none", "hard", "pipe",
                                           "../out/victim", "folder/../victim"}) {
                      const fs::path file = work / name;
                      for (const Use use : {Use::read, Use::write, Use::own}) {
                          EXPECT_TRUE(refused([&] { door::open(file, use, door::Access::renew); })) << name;
                          EXPECT_TRUE(refused([&] { write_whole_file(file, "x", use); })) << name;
                      }
                      EXPECT_FALSE(door::peek(file)) << name;
                      EXPECT_TRUE(refused([&] { read_whole_file(file); })) << name;
                  }
                  EXPECT_TRUE(refused([&] { door::make_folders(work / "folder/new", Use::write); }));
                  EXPECT_TRUE(refused([&] { door::enter(work / "folder"); }));
                  EXPECT_TRUE(door::remove(work / "folder/victim"));
                  EXPECT_TRUE(door::remove_all(work / "../out"));
              }),
              0);
    EXPECT_EQ(content_of(out / "victim"), "secret");
    EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 1);
}

TEST_P(DoorTest, RemovesLinksAndNotTheirTargets) {
    fs::create_directory(work / "tree");
    fs::create_symlink(out, work / "tree/folder");
    fs::create_symlink(out / "victim", work / "tree/file");
    fs::create_symlink(out, work / "link");
    put(work / "tree/own", "x");
    EXPECT_EQ(in_child([&] {
                  EXPECT_FALSE(door::remove_all(work / "tree"));
                  EXPECT_FALSE(door::remove_all(work / "link"));
                  EXPECT_FALSE(door::remove(work / "none"));
              }),
              0);
    EXPECT_FALSE(fs::exists(fs::symlink_status(work / "tree")));
    EXPECT_FALSE(fs::exists(fs::symlink_status(work / "link")));
    EXPECT_EQ(content_of(out / "victim"), "secret");
}

// Another process changes the names continuously: no change between the check and the opening leads outside.
TEST_P(DoorTest, NamesChangedDuringOpeningLeadNowhereElse) {
    fs::create_directories(work / "real");
    put(work / "real/file", "mine");
    fs::create_symlink(out, work / "out-link");
    put(out / "file", "secret");
    const pid_t changer = ::fork();
    if (changer == 0)
        for (;;) { // sub/ is a folder, then a link out, then a folder again
            ::rename((work / "sub").c_str(), (work / "kept").c_str());
            ::rename((work / "out-link").c_str(), (work / "sub").c_str());
            ::rename((work / "sub").c_str(), (work / "out-link").c_str());
            ::rename((work / "kept").c_str(), (work / "sub").c_str());
        }
    put(work / "sub/file", "mine");
    const int status = in_child([&] {
        for (int k = 0; k < 3000; ++k) {
            try {
                EXPECT_NE(file_text(work / "sub/file"), "secret");
                const door::Stream stream = door::open_stream(work / "sub/appended", Use::write, "a");
                if (k % 10 == 0) write_whole_file(work / "sub/written", "x");
                door::remove(work / "sub/file2");
            } catch (const Diagnostic&) { // refused, or missing at this moment
            }
        }
    });
    ::kill(changer, SIGKILL);
    ::waitpid(changer, nullptr, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 2);
}

} // namespace
} // namespace kaya
