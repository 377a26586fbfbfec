// Files of other programs, tables and journals that somebody has changed: what is wrong is refused with a message; nothing crashes,
// and nothing is our own fault.
#include "base/diagnostic.hpp"
#include "commands/journal.hpp"
#include "commands/session.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace kaya {
namespace {

namespace fs = std::filesystem;

class Scene {
public:
    Scene() : results_(std::tmpfile()), messages_(std::tmpfile()) {
        Options options;
        options.threads = 1;
        options.joint_folders = {KAYA_TEST_JOINTS};
        session_ = std::make_unique<Session>(options, results_, messages_);
    }
    ~Scene() {
        session_.reset();
        std::fclose(results_);
        std::fclose(messages_);
    }
    Session& session() { return *session_; }

private:
    std::FILE *results_, *messages_;
    std::unique_ptr<Session> session_;
};

/// Stops a session that works for too long; what was changed may ask for a million cycles.
class Patience {
public:
    explicit Patience(Session& session)
        : waiter_([this, &session](const std::stop_token& token) {
              const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
              while (!token.stop_requested() && std::chrono::steady_clock::now() < end)
                  std::this_thread::sleep_for(std::chrono::milliseconds(5));
              if (!token.stop_requested()) session.interrupt();
          }) {}

private:
    std::jthread waiter_;
};

struct Kind {
    std::string name;
    std::string good; ///< a file that is right
    void (*use)(Session&, const std::string& file);
};

void import_and_cycle(Session& session, const std::string& file) {
    session.interpreter.run_text(
        fmt::format("import '{}'\nprop mat 1 dens 2000\njmodel jkn 1e8 jks 1e8\ncycle 2\n", file), "hostile.3dd");
}

void read_table(Session& session, const std::string& file) {
    session.interpreter.run_text(fmt::format("table 1 read '{}'\nlist tables\n", file), "hostile.3dd");
}

void replay(Session& session, const std::string& file) { replay_journal(session, file); }

constexpr std::array<std::array<double, 3>, 4> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 4> triangles{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

std::string tetrahedron(const std::string& head, const char* corner, const std::string& middle, const char* triangle,
                        int first, const std::string& end) {
    std::string text = head;
    for (const auto& c : corners) text += fmt::format(fmt::runtime(corner), c[0], c[1], c[2]);
    text += middle;
    for (const auto& t : triangles)
        text += fmt::format(fmt::runtime(triangle), t[0] + first, t[1] + first, t[2] + first);
    return text + end;
}

std::string stl_text() {
    std::string text = "solid block\n";
    for (const auto& t : triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int v : t) text += fmt::format("vertex {} {} {}\n", corners[v][0], corners[v][1], corners[v][2]);
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid block\n";
}

std::string stl_binary() {
    std::string bytes(80, ' ');
    const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(static_cast<std::uint32_t>(triangles.size()));
    for (const auto& t : triangles) {
        for (int k = 0; k < 3; ++k) put(0.0f);
        for (const int v : t)
            for (const double x : corners[v]) put(static_cast<float>(x));
        put(std::uint16_t{0});
    }
    return bytes;
}

std::string read_all(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// What kaya itself writes: a grid file and a journal.
std::string grid_text(const test::ScratchFolder& folder) {
    Scene scene;
    scene.session().interpreter.run_text(
        fmt::format("poly brick 0 1 0 1 0 1\npoly brick 1 2 0 1 0 1\nexport '{}'\n", folder / "good.3dgrid"), "x");
    return read_all(folder / "good.3dgrid");
}

std::string journal_text(const test::ScratchFolder& folder) {
    Scene scene;
    Journal journal(scene.session(), folder / "good.journal");
    {
        std::ofstream(folder / "good.3dd")
            << "poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 dens 2000\njmodel jkn 1e8 jks 1e8\n"
               "fix range z 0 1\ngravity 0 0 -10\ndef f\n a = 2\nend\n@f\nset @b = 3\nhist unbal\ncycle 5\n";
    }
    journal.deck(folder / "good.3dd");
    scene.session().run_deck(folder / "good.3dd");
    journal.finish();
    return read_all(folder / "good.journal");
}

std::string changed(std::string bytes, std::mt19937_64& random) {
    static const std::vector<std::string> tokens{
        "0",  "-1", "1e308", "nan", "inf", "-inf", "99999999999",        "4294967295", "2147483648", "",
        "\n", "'",  "\"",    "{",   "]",   ";",    std::string(1, '\0'), "\xff\xfe",   " ",          "1e-320"};
    const int times = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < times && !bytes.empty(); ++k) {
        const std::size_t at = random() % bytes.size(), length = random() % 12, to = random() % bytes.size();
        switch (random() % 6) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes.erase(at, length); break;
        case 2: bytes.replace(at, random() % 4, tokens[random() % tokens.size()]); break;
        case 3: bytes.insert(to, bytes.substr(at, 4 * length)); break;
        case 4: bytes.resize(at); break;
        default: bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8)); break;
        }
    }
    return bytes;
}

int number_from(const char* variable, int otherwise) {
    const char* given = std::getenv(variable);
    return given ? std::atoi(given) : otherwise;
}

// KAYA_HOSTILE_FILES says how many, of all kinds together.
TEST(HostileFiles, AreRefusedOrUsedButNeverCrash) {
    const test::ScratchFolder folder;
    const std::vector<Kind> kinds{
        {"a.stl", stl_text(), import_and_cycle},
        {"b.stl", stl_binary(), import_and_cycle},
        {"a.obj", tetrahedron("o one\n", "v {} {} {}\n", "", "f {} {} {}\n", 1, ""), import_and_cycle},
        {"a.ply",
         tetrahedron(
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
             "property list uchar int vertex_indices\nend_header\n",
             "{} {} {}\n", "", "3 {} {} {}\n", 0, ""),
         import_and_cycle},
        {"a.wrl",
         tetrahedron("#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [\n", "{} {} {},\n",
                     "] } coordIndex [\n", "{}, {}, {}, -1,\n", 0, "] } }\n"),
         import_and_cycle},
        {"a.3dgrid", grid_text(folder), import_and_cycle},
        {"a.tab", "quake\n4 0.01\n1\n2\n-1\n0.5\n", read_table},
        {"b.tab", "pairs\n3 0\n0 1\n1 2\n2 -1\n", read_table},
        {"a.journal", journal_text(folder), replay},
    };
    for (const Kind& kind : kinds) {
        std::ofstream(folder / kind.name, std::ios::binary) << kind.good;
        Scene scene;
        ASSERT_NO_THROW(kind.use(scene.session(), folder / kind.name)) << kind.name;
    }
    const int files = number_from("KAYA_HOSTILE_FILES", 405);
    std::mt19937_64 random(static_cast<std::uint64_t>(number_from("KAYA_FIRST_SEED", 5)));
    int refused = 0, used = 0;
    for (int k = 0; k < files; ++k) {
        const Kind& kind = kinds[static_cast<std::size_t>(k) % kinds.size()];
        const std::string bytes = changed(kind.good, random), file = folder / kind.name;
        std::ofstream(file, std::ios::binary) << bytes;
        SCOPED_TRACE(fmt::format("file {} of kind {}:\n{}", k, kind.name, bytes.substr(0, 2000)));
        Scene scene;
        const Patience patience(scene.session());
        try {
            kind.use(scene.session(), file);
            ++used;
        } catch (const lang::DeckErrors&) { ++refused; } catch (const Diagnostic& problem) {
            EXPECT_NE(problem.fault, Fault::own) << render(problem);
            ++refused;
        }
        if (HasFailure()) return;
    }
    EXPECT_GT(refused, files / 10);
    EXPECT_GT(used, files / 20);
}

} // namespace
} // namespace kaya
