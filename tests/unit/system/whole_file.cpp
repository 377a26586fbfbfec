#include "system/whole_file.hpp"

#include "base/diagnostic.hpp"
#include "tests/unit/refused_calls.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace kaya;
using namespace kaya::test;
using testing::HasSubstr;

namespace {

Diagnostic caught(const std::function<void()>& action) {
    try {
        action();
    } catch (const Diagnostic& d) { return d; }
    return Diagnostic("nothing was thrown");
}

/// Runs the action in a separate process, without unnamed files if requested. Returns the process.
template <class Action> pid_t in_child(bool nameless, const Action& action) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    int status = 0;
    try {
        if (!nameless) refuse_call(SYS_openat, EOPNOTSUPP, 2, O_TMPFILE & ~O_DIRECTORY);
        action();
    } catch (const std::exception&) { status = 1; }
    std::_Exit(testing::Test::HasFailure() ? 2 : status);
}

int status_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

/// A file of a killed run in the folder.
std::string left_over(const ScratchFolder& folder) {
    put(folder / "draft", "half");
    struct stat info {};
    ::stat((folder / "draft").c_str(), &info);
    const std::string name = folder / (".kaya-" + std::to_string(info.st_ino) + ".unfinished");
    std::filesystem::rename(folder / "draft", name);
    return name;
}

/// File systems with and without unnamed files.
class EachFileSystem : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WholeFile, EachFileSystem, testing::Bool());

} // namespace

TEST(WholeFile, WrittenBytesAreReadAndNoOtherFileRemains) {
    const ScratchFolder folder;
    std::string content = "line\n";
    content.push_back('\0');
    content += std::string(3 << 20, 'x');
    write_whole_file(folder / "a.csv", content);
    EXPECT_EQ(read_whole_file(folder / "a.csv"), content);
    write_whole_file(folder / "a.csv", "short");
    EXPECT_EQ(read_whole_file(folder / "a.csv"), "short");
    EXPECT_EQ(folder.file_count(), 1u);
}

// Each process removes files of killed runs before its first file in a folder, while the others write theirs.
TEST(WholeFile, ProcessesWritingIntoANewFolderKeepEachOthersFiles) {
    const ScratchFolder scratch;
    for (int round = 0; round < 100; ++round) {
        const std::string folder = scratch / ("f" + std::to_string(round));
        std::filesystem::create_directory(folder);
        std::array<int, 2> gate{};
        ASSERT_EQ(::pipe(gate.data()), 0);
        std::array<pid_t, 6> writers{};
        for (auto& writer : writers) {
            writer = ::fork();
            if (writer != 0) continue;
            ::close(gate[1]);
            char none = 0;
            [[maybe_unused]] const auto opened = ::read(gate[0], &none, 1); // until the parent closes it
            try {
                write_whole_file(folder + "/a.csv", "text");
            } catch (const Diagnostic&) { std::_Exit(1); }
            std::_Exit(0);
        }
        ::close(gate[0]), ::close(gate[1]);
        for (const auto writer : writers) {
            int status = 0;
            ::waitpid(writer, &status, 0);
            ASSERT_EQ(status, 0) << "round " << round;
        }
        ASSERT_EQ(content_of(folder + "/a.csv"), "text");
    }
}

TEST_P(EachFileSystem, AFileIsWrittenReplacedAndKeptWhenTheDiskIsFull) {
    const ScratchFolder folder;
    const pid_t child = in_child(GetParam(), [&] {
        write_whole_file(folder / "a.csv", "first");
        EXPECT_EQ(content_of(folder / "a.csv"), "first");
        write_whole_file(folder / "a.csv", "second");
        const SmallDisk disk(1000);
        EXPECT_THAT(caught([&] { write_whole_file(folder / "a.csv", std::string(5000, 'x')); }).hint,
                    HasSubstr("is unchanged"));
    });
    EXPECT_EQ(status_of(child), 0);
    EXPECT_EQ(content_of(folder / "a.csv"), "second");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST_P(EachFileSystem, AKilledWriterLeavesACompleteFileAndTheNextRemovesTheRest) {
    const ScratchFolder folder;
    const std::string old_text(100'000, 'o'), new_text(200'000, 'n');
    for (int kill = 0; kill < 20; ++kill) {
        put(folder / "a.csv", old_text);
        const pid_t child = in_child(GetParam(), [&] {
            for (;;) write_whole_file(folder / "a.csv", new_text);
        });
        ::usleep(static_cast<useconds_t>(1000 + 700 * kill));
        ::kill(child, SIGKILL);
        EXPECT_TRUE(WIFSIGNALED(status_of(child)));
        const std::string content = content_of(folder / "a.csv");
        ASSERT_TRUE(content == old_text || content == new_text) << content.size();
    }
    EXPECT_EQ(status_of(in_child(GetParam(), [&] { write_whole_file(folder / "a.csv", "last"); })), 0);
    EXPECT_EQ(content_of(folder / "a.csv"), "last");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WholeFile, OnlyUnfinishedFilesOfKayaAreRemoved) {
    const ScratchFolder folder;
    const std::string left = left_over(folder), written = left_over(folder), other = left_over(folder) + ".bak";
    std::filesystem::copy_file(left, other); // the number in the name of a copy is the inode of another file
    std::filesystem::copy_file(left, folder / ".kaya-1.unfinished");
    for (const auto* name : {"results.kaya-backup", "a.csv.kaya-AbCdEf", ".kaya-notes", ".kaya-.unfinished"})
        put(folder / name, "precious");
    // The first name of a file without a second one: it is empty, and as old as its name says.
    const std::string first = fmt::format(".kaya-77-{}.unfinished", ::time(nullptr)),
                      full = fmt::format(".kaya-78-{}.unfinished", ::time(nullptr)), old = ".kaya-77-1000.unfinished";
    put(folder / first, "");
    put(folder / full, "precious");
    put(folder / old, "");
    const int writer = ::open(written.c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(writer, LOCK_EX), 0);
    const auto before = folder.file_count();
    EXPECT_EQ(status_of(in_child(true, [&] { write_whole_file(folder / "a.csv", "text"); })), 0);
    ::close(writer);
    // One file was added, and three old ones were removed: that of `other` was not locked.
    EXPECT_EQ(folder.file_count(), before + 1 - 3);
    EXPECT_FALSE(std::filesystem::exists(folder / first));
    EXPECT_TRUE(std::filesystem::exists(folder / full));
    EXPECT_TRUE(std::filesystem::exists(folder / old));
    EXPECT_FALSE(std::filesystem::exists(left));
    EXPECT_TRUE(std::filesystem::exists(written));
    EXPECT_TRUE(std::filesystem::exists(other));
    EXPECT_TRUE(std::filesystem::exists(folder / ".kaya-1.unfinished"));
}

TEST(WholeFile, AFullDiskLeavesTheFileFromBefore) {
    const ScratchFolder folder;
    write_whole_file(folder / "a.csv", "from before");
    Diagnostic d("");
    {
        const SmallDisk disk(1000);
        d = caught([&] { write_whole_file(folder / "a.csv", std::string(5000, 'x')); });
    }
    EXPECT_THAT(d.message, HasSubstr("cannot write '" + (folder / "a.csv") + "'"));
    EXPECT_THAT(d.hint, HasSubstr("is unchanged"));
    EXPECT_EQ(d.fault, Fault::run);
    EXPECT_EQ(content_of(folder / "a.csv"), "from before");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WholeFile, ADeviceIsWrittenToDirectly) {
    const Diagnostic d = caught([] { write_whole_file("/dev/full", "text"); });
    EXPECT_EQ(d.message, "cannot write '/dev/full': No space left on device");
    EXPECT_EQ(d.fault, Fault::run);
    write_whole_file("/dev/null", "text");
    struct stat info {};
    ASSERT_EQ(::stat("/dev/null", &info), 0);
    EXPECT_TRUE(S_ISCHR(info.st_mode));
}

TEST(WholeFile, WritingSaysWhyItIsImpossible) {
    const ScratchFolder folder;
    EXPECT_EQ(caught([&] { write_whole_file(folder / "no/a.csv", "x"); }).hint, "make the folder first");
    EXPECT_THAT(caught([&] { write_whole_file(folder.path().string(), "x"); }).message, HasSubstr("directory"));
    EXPECT_THAT(caught([] { write_whole_file("", "x"); }).message, HasSubstr("without a name"));
    put(folder / "file", "x");
    EXPECT_THAT(caught([&] { write_whole_file(folder / "file/a.csv", "x"); }).message, HasSubstr("cannot write"));
    EXPECT_EQ(content_of(folder / "file"), "x");
}

TEST(WholeFile, ALinkStaysALink) {
    const ScratchFolder folder;
    put(folder / "target", "old");
    ASSERT_EQ(::symlink((folder / "target").c_str(), (folder / "link").c_str()), 0);
    write_whole_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(content_of(folder / "target"), "new");
}

TEST(WholeFile, PermissionsAreThoseOfTheOldFileOrOfTheUsersMask) {
    const ScratchFolder folder;
    const mode_t mask = ::umask(027);
    write_whole_file(folder / "new", "x");
    ::umask(mask);
    struct stat info {};
    ASSERT_EQ(::stat((folder / "new").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
    ASSERT_EQ(::chmod((folder / "new").c_str(), 0600), 0);
    write_whole_file(folder / "new", "y");
    ASSERT_EQ(::stat((folder / "new").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0600u);
}

TEST(WholeFile, ReadingSaysWhyItIsImpossible) {
    const ScratchFolder folder;
    const Diagnostic missing = caught([&] { read_whole_file(folder / "none.sav"); });
    EXPECT_EQ(missing.message, "there is no file '" + (folder / "none.sav") + "'");
    EXPECT_EQ(missing.fault, Fault::deck);
    EXPECT_THAT(caught([&] { read_whole_file(folder.path().string()); }).message, HasSubstr("is a folder"));
}
