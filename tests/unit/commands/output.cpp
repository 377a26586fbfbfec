#include "commands/program/output.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

namespace kaya {
namespace {

/// A stream of the C library that stores its output.
class Catch {
public:
    Catch() : stream_(std::tmpfile()) {}
    ~Catch() { std::fclose(stream_); }
    Catch(const Catch&) = delete;
    Catch& operator=(const Catch&) = delete;
    std::FILE* stream() { return stream_; }
    std::string text() {
        std::fflush(stream_);
        std::rewind(stream_);
        std::string text;
        for (int c = std::fgetc(stream_); c != EOF; c = std::fgetc(stream_)) text += static_cast<char>(c);
        return text;
    }

private:
    std::FILE* stream_;
};

class OutputTest : public testing::Test {
protected:
    std::string log_text() const {
        std::ifstream stream(log);
        std::stringstream text;
        text << stream.rdbuf();
        return text.str();
    }
    void SetUp() override { std::filesystem::remove(log); }
    void TearDown() override { std::filesystem::remove(log); }

    Catch results, messages;
    Output output{results.stream(), messages.stream()};
    // With the number of this process, because tests run in parallel.
    std::string log = testing::TempDir() + "kaya_output_test_" + std::to_string(::getpid()) + ".log";
};

TEST_F(OutputTest, ResultsAndMessagesGoToSeparateStreams) {
    output.print("x = 1");
    output.print("two\nlines\n");
    output.message(Diagnostic("it is so", "do this"));
    EXPECT_EQ(results.text(), "x = 1\ntwo\nlines\n");
    EXPECT_EQ(messages.text(), "error: it is so\n  do this\n");
}

TEST_F(OutputTest, TheLogGetsBothWhileItIsOn) {
    output.print("before");
    output.start_log(log);
    output.print("result");
    output.message(Diagnostic("message"));
    output.log_only("kaya> cycle 1");
    output.stop_log();
    output.print("after");
    EXPECT_EQ(log_text(), "result\nerror: message\nkaya> cycle 1\n");
}

TEST_F(OutputTest, ALogIsAppendedTo) {
    for (int i = 0; i < 2; ++i) {
        output.start_log(log);
        output.print("again");
        output.stop_log();
    }
    EXPECT_EQ(log_text(), "again\nagain\n");
}

TEST_F(OutputTest, ALogCanBeginEmpty) {
    output.start_log(log);
    output.print("earlier");
    output.empty_log(log);
    EXPECT_FALSE(output.logging());
    output.start_log(log);
    output.print("now");
    output.stop_log();
    EXPECT_EQ(log_text(), "now\n");
}

TEST_F(OutputTest, ALogInAMissingFolderIsRefused) {
    EXPECT_THROW(output.start_log(testing::TempDir() + "no_such_folder/kaya.log"), Diagnostic);
    EXPECT_FALSE(output.logging());
}

TEST_F(OutputTest, AQuietSessionSaysNothingButPrintsResults) {
    output.quiet = true;
    output.say("cycle 1000");
    output.print("x = 1");
    EXPECT_EQ(messages.text(), "");
    EXPECT_EQ(results.text(), "x = 1\n");
}

TEST_F(OutputTest, ProgressIsRefreshedOnATerminalOnly) {
    output.refresh("cycle 1000");
    EXPECT_EQ(messages.text(), "");
    EXPECT_FALSE(output.on_terminal());
}

TEST(Output, AFullDiskIsReported) {
    std::FILE* full = std::fopen("/dev/full", "w");
    ASSERT_NE(full, nullptr);
    Catch messages;
    {
        Output output(full, messages.stream());
        try {
            output.print("x = 1");
            output.flush();
            ADD_FAILURE() << "a full disk went unseen";
        } catch (const Diagnostic& failure) {
            EXPECT_EQ(failure.fault, Fault::run);
            EXPECT_NE(failure.message.find("No space left"), std::string::npos) << failure.message;
        }
    }
    std::fclose(full);
}

} // namespace
} // namespace kaya
