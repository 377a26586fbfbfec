#include "lang/interp/source.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace kaya::lang {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
protected:
    void SetUp() override {
        folder = fs::temp_directory_path() / ("kaya_source_" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    fs::path folder;
};

std::vector<std::string> lines(std::string_view text) { return source_from_text("t", text)->lines; }

template <class Call> Diagnostic refused(Call call) {
    try {
        call();
    } catch (const Diagnostic& d) { return d; }
    ADD_FAILURE() << "accepted";
    return Diagnostic("");
}

TEST(Source, EveryKindOfLineEnd) {
    const std::vector<std::string> two = {"a", "b"};
    EXPECT_EQ(lines("a\nb\n"), two);
    EXPECT_EQ(lines("a\r\nb\r\n"), two);
    EXPECT_EQ(lines("a\rb\r"), two);
    EXPECT_EQ(lines("a\nb"), two) << "no end of the last line";
    EXPECT_EQ(lines("a\n\nb"), (std::vector<std::string>{"a", "", "b"}));
    EXPECT_EQ(lines("a\r\n\r\nb"), (std::vector<std::string>{"a", "", "b"}));
}

TEST(Source, MarksOfOldEditorsAreDropped) {
    EXPECT_EQ(lines("\xEF\xBB\xBFnew\n"), std::vector<std::string>{"new"});
    EXPECT_EQ(lines("new\r\n\x1A"), std::vector<std::string>{"new"});
}

TEST(Source, EmptyTextHasNoLines) {
    EXPECT_TRUE(lines("").empty());
    EXPECT_TRUE(lines("\xEF\xBB\xBF").empty());
}

TEST(Source, PieceOfAFileKeepsItsLineNumber) {
    const Source piece = source_from_text("deck", "a\nb", 10);
    EXPECT_EQ(piece->lines.size(), 11u);
    EXPECT_EQ(piece->lines[9], "a");
}

TEST(Source, BinaryIsRefused) {
    using namespace std::string_literals;
    EXPECT_EQ(refused([] { lines("new\n\0"s); }).message, "'t' holds a byte 0 at position 4: it is not a text");
    EXPECT_EQ(refused([] { lines("\x89HDF\r\n\x1a\n"); }).message, "'t' is a saved model, not a command file");
    EXPECT_EQ(refused([] { lines("\xFF\xFEn\0e\0"s); }).message,
              "'t' is a UTF-16 text; a command file must be UTF-8 or ASCII");
}

TEST_F(Files, MissingFolderAndUnreadable) {
    EXPECT_EQ(refused([&] { read_source(folder / "none.3dd", "none.3dd"); }).message, "there is no file 'none.3dd'");
    EXPECT_EQ(refused([&] { read_source(folder, "here"); }).message, "'here' is a folder, not a command file");
    const fs::path locked = write("locked.3dd", "new\n");
    fs::permissions(locked, fs::perms::none);
    if (std::ifstream(locked).good()) return; // root can read every file
    EXPECT_EQ(refused([&] { read_source(locked, "locked.3dd"); }).message,
              "'locked.3dd' cannot be read: Permission denied");
}

TEST_F(Files, TooLargeIsRefusedWithoutReadingIt) {
    const fs::path large = write("large.3dd", "");
    fs::resize_file(large, 3ull << 30); // sparse: uses no disk space
    EXPECT_EQ(refused([&] { read_source(large, "large.3dd"); }).message,
              "'large.3dd' has 3072 MB: too large for a command file (at most 512 MB)");
}

TEST_F(Files, SuffixIsTried) {
    write("wall.dat", "new\n");
    write("wall.fis", "new\n");
    EXPECT_EQ(find_deck("wall", {folder}).filename(), "wall.dat") << "the order of suffixes decides";
    EXPECT_EQ(find_deck("wall.fis", {folder}).filename(), "wall.fis");
}

TEST_F(Files, NearestNameIsSuggested) {
    write("tunnel.3dd", "new\n");
    const Diagnostic d = refused([&] { find_deck("tunel.3dd", {folder}); });
    EXPECT_EQ(d.message, "there is no file 'tunel.3dd'");
    EXPECT_EQ(d.hint, "did you mean 'tunnel.3dd'?");
}

TEST_F(Files, FirstFolderWins) {
    fs::create_directories(folder / "inner");
    write("a.dat", "outer\n");
    write("inner/a.dat", "inner\n");
    EXPECT_EQ(read_source(find_deck("a.dat", {folder / "inner", folder}), "a")->lines[0], "inner");
}

} // namespace
TEST(Source, ALineWithoutEndIsRefused) {
    EXPECT_EQ(source_from_text("long", "a\n" + std::string(4u << 20, 'b'))->lines.size(), 2u);
    try {
        source_from_text("long", "a\n" + std::string((4u << 20) + 1, 'b') + "\nc");
        FAIL();
    } catch (const Diagnostic& problem) {
        EXPECT_EQ(problem.message, "this line has 4194305 characters, more than 4194304");
        EXPECT_EQ(problem.place.line, 2);
    }
}

} // namespace kaya::lang
