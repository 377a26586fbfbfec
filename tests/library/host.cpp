// Promises to the process of another program: models change nothing of it, and each has its own settings.
#include "kaya/kaya.h"

#include <array>
#include <clocale>
#include <csignal>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

class Model {
public:
    Model() {
        kaya_options options{};
        options.interface = KAYA_LIBRARY_INTERFACE;
        options.output = [](void* user, const char* text, std::size_t size) {
            static_cast<std::string*>(user)->append(text, size);
        };
        options.user = &printed;
        EXPECT_EQ(kaya_open(&options, &model_), KAYA_DONE);
    }
    ~Model() { kaya_close(model_); }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
    operator kaya_model*() const { return model_; }

    kaya_status run(const std::string& commands) { return kaya_run(model_, commands.c_str(), "test"); }

    std::string printed;

private:
    kaya_model* model_ = nullptr;
};

/// A block on a plane with a user's law at the joint. The law is tried in a second process before it is loaded.
std::string slide(int cycles) {
    return "poly brick 0 2 0 1 0 1\npoly brick 0.5 1.5 0 1 1 2\nprop mat 1 dens 2500\n"
           "jmodel load " KAYA_TEST_PLUGINS "/works.so\njmodel model works\nprop jmat 1 stiffness 1e9\n"
           "gravity 1 0 -9.81\nfix range z 0 1\ncycle " +
           std::to_string(cycles) + "\n";
}

/// State of the process.
struct Process {
    std::filesystem::path folder = std::filesystem::current_path();
    std::vector<std::string> environment;
    std::vector<std::array<unsigned long, 2>> handlers;
    std::vector<bool> blocked;
    std::vector<std::array<rlim_t, 2>> limits;
    std::string locale = std::setlocale(LC_ALL, nullptr);
    mode_t mask = ::umask(0);
    int dumpable = ::prctl(PR_GET_DUMPABLE), no_new_privileges = ::prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0);

    Process() {
        ::umask(mask);
        for (char** one = environ; *one != nullptr; ++one) environment.emplace_back(*one);
        sigset_t now;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &now);
        for (int signal = 1; signal < NSIG; ++signal) {
            struct sigaction action {};
            ::sigaction(signal, nullptr, &action);
            handlers.push_back(
                {reinterpret_cast<unsigned long>(action.sa_handler), static_cast<unsigned long>(action.sa_flags)});
            blocked.push_back(::sigismember(&now, signal) == 1);
        }
        for (int what = 0; what < RLIMIT_NLIMITS; ++what) {
            rlimit limit{};
            ::getrlimit(static_cast<__rlimit_resource>(what), &limit);
            limits.push_back({limit.rlim_cur, limit.rlim_max});
        }
    }
    bool operator==(const Process&) const = default;
};

void in_four_threads(const std::function<void(int)>& work) {
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) threads.emplace_back(work, t);
    for (auto& thread : threads) thread.join();
}

} // namespace

TEST(Host, EightModelsInFourThreadsLeaveTheProcessAsItWas) {
    const Process before;
    in_four_threads([](int t) {
        Model first, second;
        EXPECT_EQ(first.run("set threads " + std::to_string(t + 1) + "\n" + slide(200)), KAYA_DONE)
            << kaya_error_at(first, 0).text;
        EXPECT_EQ(second.run(slide(100)), KAYA_DONE) << kaya_error_at(second, 0).text;
        EXPECT_EQ(second.run("poly brik 0 1"), KAYA_WRONG);
    });
    EXPECT_EQ(Process(), before);
}

TEST(Host, AUsersLawIsTriedWhileOtherModelsWork) {
    in_four_threads([](int t) {
        for (int k = 0; k < 10; ++k) {
            Model model;
            if (t % 2 == 0) EXPECT_EQ(model.run(slide(20)), KAYA_DONE) << kaya_error_at(model, 0).text;
            else {
                const bool crashes = k % 2 == 0;
                const std::string file = crashes ? "/crashes-at-load.so" : "/exits-at-load.so";
                EXPECT_NE(model.run("jmodel load " KAYA_TEST_PLUGINS + file), KAYA_DONE);
                const std::string expected =
                    crashes ? "crashes when it is loaded" : "ends the program when it is loaded";
                EXPECT_NE(std::string(kaya_error_at(model, 0).message).find(expected), std::string::npos)
                    << kaya_error_at(model, 0).text;
            }
        }
    });
}

TEST(Host, ThreadsAreThoseOfOneModel) {
    Model one, two, given;
    ASSERT_EQ(one.run("set threads 1"), KAYA_DONE);
    ASSERT_EQ(two.run("set threads 2"), KAYA_DONE);
    ASSERT_EQ(one.run(slide(50) + "list settings"), KAYA_DONE) << kaya_error_at(one, 0).text;
    ASSERT_EQ(two.run(slide(50) + "list settings"), KAYA_DONE) << kaya_error_at(two, 0).text;
    const auto threads_in = [](const std::string& text) {
        const auto line = text.find("threads");
        return line == text.npos ? std::string() : text.substr(text.find_first_of("0123456789", line), 1);
    };
    EXPECT_EQ(threads_in(one.printed), "1") << one.printed;
    EXPECT_EQ(threads_in(two.printed), "2") << two.printed;
    EXPECT_EQ(kaya_hash(one), kaya_hash(two));
}
