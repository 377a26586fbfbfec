#include "commands/monitors/progress.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(DurationText, MinutesAndHours) {
    EXPECT_EQ(duration_text(0), "0:00");
    EXPECT_EQ(duration_text(75.4), "1:15");
    EXPECT_EQ(duration_text(3599.6), "1:00:00");
    EXPECT_EQ(duration_text(4000), "1:06:40");
}

TEST(Progress, FinishReportsTheRun) {
    std::FILE* stream = std::tmpfile();
    {
        Output output(stream, stream);
        Model model;
        model.clock.cycle = 100;
        Progress progress(output, model, {});
        for (int i = 0; i < 5000; ++i) {
            ++model.clock.cycle;
            progress.advanced();
        }
        progress.finish();
        EXPECT_GT(progress.seconds(), 0.0);
    }
    std::rewind(stream);
    std::string text(200, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), stream));
    std::fclose(stream);
    EXPECT_EQ(text.substr(0, 10), "cycle 5100") << text;
    EXPECT_NE(text.find("5000 cycles in"), std::string::npos) << text;
}

} // namespace
} // namespace kaya
