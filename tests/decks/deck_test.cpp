// deck_test PROGRAM DECK [--bless]: runs a deck in an empty folder and compares what it does with what its
// comments say.
//
//   ;> text       the command above prints this line; ... in it stands for anything
//   ;because text why the numbers that the command above prints are right: a formula, a source, another way to compute them
//   ;! error: x   the only messages are those listed; this one points at the command above
//   ;! text       the message above also says this (hint, call stack)
//   ;status N     exit status, 0 when it is not given
//   ;options ...  given to the program
//   ;limit N      no file may grow beyond N kilobytes
//   ;makes FILE   the file is there afterwards
//   ;holds FILE text   the file is there and has a line with this text
//   ;lacks FILE   the file is not there afterwards
//   ;needs FILE   a file in the folder of the deck, copied into the run folder first
//   ;first DECK   a deck in the same folder, run in the run folder first
//   ;then DECK    a deck in the same folder, run in the run folder afterwards; it must succeed
//   ;cut FILE N   only the first N bytes of the file are left, after that and before this deck runs
//
// With --bless the lines `;>` are written again from what the program prints. A printed number of four digits or more needs its `;because`.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

Lines read_lines(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error("cannot read " + file.string());
    Lines lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Text after a mark at the start of a line; blanks may precede the mark, and in Lua two minus signs.
std::optional<std::string> behind(std::string_view line, std::string_view mark) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("--;")) line.remove_prefix(2);
    if (!line.starts_with(mark)) return std::nullopt;
    line.remove_prefix(mark.size());
    if (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return std::string(line);
}

/// "..." in the pattern matches any text.
bool matches(std::string_view pattern, std::string_view text) {
    const auto gap = pattern.find("...");
    if (gap == std::string_view::npos) return pattern == text;
    if (!text.starts_with(pattern.substr(0, gap))) return false;
    const auto rest = pattern.substr(gap + 3);
    for (std::size_t from = gap; from <= text.size(); ++from)
        if (matches(rest, text.substr(from))) return true;
    return false;
}

bool is_message(std::string_view text) {
    return text.starts_with("error:") || text.starts_with("warning:") || text.starts_with("note:");
}

struct Message {
    int line; ///< of the command it points at
    std::string text;
};

/// The expectations in the comments of a deck.
struct Expected {
    int status = 0;
    int limit = 0;
    std::string options;
    Lines needs, first, then, cuts, makes, lacks, holds, hints;
    std::vector<Message> messages;
    std::map<int, Lines> printed; ///< by line of the comment
    std::set<int> reasons;        ///< lines of the comments `;because`
};

Expected read_expected(const Lines& deck) {
    Expected expected;
    int code_line = 0;
    for (std::size_t i = 0; i < deck.size(); ++i) {
        const std::string& line = deck[i];
        const int number = static_cast<int>(i) + 1;
        if (auto text = behind(line, ";>")) expected.printed[number].push_back(*text);
        else if (auto reason = behind(line, ";because"); reason && !reason->empty()) expected.reasons.insert(number);
        else if (auto message = behind(line, ";!")) {
            if (is_message(*message)) expected.messages.push_back({code_line, *message});
            else expected.hints.push_back(*message);
        } else if (auto status = behind(line, ";status")) expected.status = std::stoi(*status);
        else if (auto limit = behind(line, ";limit")) expected.limit = std::stoi(*limit);
        else if (auto options = behind(line, ";options")) expected.options = *options;
        else if (auto needs = behind(line, ";needs")) expected.needs.push_back(*needs);
        else if (auto first_deck = behind(line, ";first")) expected.first.push_back(*first_deck);
        else if (auto then = behind(line, ";then")) expected.then.push_back(*then);
        else if (auto cut = behind(line, ";cut")) expected.cuts.push_back(*cut);
        else if (auto makes = behind(line, ";makes")) expected.makes.push_back(*makes);
        else if (auto lacks = behind(line, ";lacks")) expected.lacks.push_back(*lacks);
        else if (auto holds = behind(line, ";holds")) expected.holds.push_back(*holds);
        else if (const auto first = line.find_first_not_of(" \t"); first != std::string::npos && line[first] != ';')
            code_line = number;
    }
    return expected;
}

/// An empty folder that is removed with the object.
struct Folder {
    fs::path path;
    Folder() {
        std::string name = (fs::temp_directory_path() / "kaya-deck-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

struct Outcome {
    int status;
    Lines printed, messages;
};

/// Runs the program on a deck in the folder; `limit` in kilobytes, 0 for none.
Outcome run_program(const fs::path& program, const std::string& deck, const std::string& options, int limit,
                    const Folder& folder) {
    // Output of the program goes to another folder, so that a limit on file sizes applies only to files of the deck.
    const Folder streams;
    const std::string command =
        "cd '" + folder.path.string() + "' && " + (limit > 0 ? "ulimit -f " + std::to_string(limit) + " && " : "") +
        "'" + program.string() + "' --echo " + options + " '" + deck + "' > '" + (streams.path / "printed").string() +
        "' 2> '" + (streams.path / "messages").string() + "' < /dev/null";
    const int ended = std::system(("bash -c \"" + command + "\"").c_str());
    return {WIFEXITED(ended) ? WEXITSTATUS(ended) : 128, read_lines(streams.path / "printed"),
            read_lines(streams.path / "messages")};
}

Outcome run(const fs::path& program, const fs::path& deck, const Expected& expected, const Folder& folder) {
    const fs::path beside = deck.parent_path();
    fs::copy(deck, folder.path);
    for (const auto& name : expected.needs) fs::copy(beside / name, folder.path);
    const auto run_other = [&](const std::string& name) {
        fs::copy(beside / name, folder.path / fs::path(name).filename());
        const Outcome other = run_program(program, fs::path(name).filename().string(), "", 0, folder);
        if (other.status != 0) throw std::runtime_error(name + " ended with status " + std::to_string(other.status));
    };
    for (const auto& name : expected.first) run_other(name);
    for (const auto& cut : expected.cuts) {
        const auto blank = cut.find(' ');
        fs::resize_file(folder.path / cut.substr(0, blank), std::stoul(cut.substr(blank + 1)));
    }
    const Outcome outcome = run_program(program, deck.filename().string(), expected.options, expected.limit, folder);
    for (const auto& name : expected.then) run_other(name);
    return outcome;
}

/// Lines of output by the line of the command that printed them, from the echo "name.3dd:12> ...". Output of a called file or a function
/// belongs to the command of this deck that runs it: the lines of a function are above that command.
struct Printed {
    int line;
    Lines text;
};

std::vector<Printed> split(const Lines& output, const std::string& name) {
    std::vector<Printed> printed{{0, {}}};
    for (const auto& line : output) {
        const auto mark = line.find("> ");
        const auto colon = line.find(':');
        const bool echo = mark != std::string::npos && colon != std::string::npos && colon < mark &&
                          line.find_first_not_of("0123456789", colon + 1) == mark;
        if (!echo) {
            printed.back().text.push_back(line);
            continue;
        }
        if (line.compare(0, colon, name) != 0) continue;
        const int number = std::stoi(line.substr(colon + 1));
        if (number > printed.back().line) printed.push_back({number, {}});
    }
    return printed;
}

/// Whether a line has a number of four digits or more with a point: its correctness is not obvious to a reader. Shorter numbers are mostly
/// input of the deck.
bool has_golden_number(const std::string& line) {
    static const std::regex number(R"((?:^|[^\w.])(\d*\.\d+))");
    for (std::sregex_iterator at(line.begin(), line.end(), number), end; at != end; ++at) {
        std::string digits = (*at)[1];
        std::erase(digits, '.');
        digits.erase(digits.find_last_not_of('0') + 1);
        const auto first = digits.find_first_not_of('0');
        if (first != std::string::npos && digits.size() - first >= 4) return true;
    }
    return false;
}

class Comparison {
public:
    void fail(const std::string& text) {
        std::cout << text << '\n';
        failed_ = true;
    }
    bool failed() const { return failed_; }

    std::string untried; ///< comparisons that were skipped because a tool is missing

private:
    bool failed_ = false;
};

/// One row of a comparison: either side may be missing.
struct Row {
    const std::string *expected = nullptr, *printed = nullptr;
    bool equal() const { return expected && printed && matches(*expected, *printed); }
};

/// Corresponding lines are in one row, by the longest common subsequence of both lists.
std::vector<Row> side_by_side(const Lines& expected, const Lines& printed) {
    const std::size_t n = expected.size(), m = printed.size();
    std::vector<std::vector<std::size_t>> common(n + 1, std::vector<std::size_t>(m + 1, 0));
    for (std::size_t i = n; i-- > 0;)
        for (std::size_t j = m; j-- > 0;)
            common[i][j] = matches(expected[i], printed[j]) ? common[i + 1][j + 1] + 1
                                                            : std::max(common[i + 1][j], common[i][j + 1]);
    std::vector<Row> rows;
    std::size_t i = 0, j = 0;
    while (i < n || j < m) {
        if (i < n && j < m && (matches(expected[i], printed[j]) || common[i + 1][j + 1] == common[i][j]))
            rows.push_back({&expected[i++], &printed[j++]});
        else if (j < m && (i == n || common[i][j + 1] == common[i][j])) rows.push_back({nullptr, &printed[j++]});
        else rows.push_back({&expected[i++], nullptr});
    }
    return rows;
}

/// The rows of one command in two columns; `!` marks those that differ.
std::string shown(int line, const std::vector<Row>& rows) {
    std::size_t width = 8;
    for (const auto& row : rows)
        if (row.expected) width = std::max(width, row.expected->size());
    const auto padded = [width](const std::string& text) { return text + std::string(width - text.size(), ' '); };
    std::string text = "line " + std::to_string(line) + "\n    " + padded("expected") + " | printed\n";
    for (const auto& row : rows)
        text += std::string(row.equal() ? "    " : "  ! ") + padded(row.expected ? *row.expected : "") + " | " +
                (row.printed ? *row.printed : "") + "\n";
    return text;
}

/// The first line after the comments that belong to a command.
int end_of(const std::vector<Printed>& printed, std::size_t i) {
    return i + 1 < printed.size() ? printed[i + 1].line : 1 << 30;
}

/// Golden numbers without a reason.
void require_reason(Comparison& comparison, const Expected& expected, const Lines& lines, int line, int until) {
    const auto golden = std::ranges::find_if(lines, has_golden_number);
    const auto reason = expected.reasons.lower_bound(line);
    if (golden == lines.end() || (reason != expected.reasons.end() && *reason < until)) return;
    comparison.fail(
        "line " + std::to_string(line) + " has a golden number without a reason:\n    " + *golden +
        "\n  add ;because with its formula, its source or another way to compute it; or print what is checked");
}

void compare_printed(Comparison& comparison, const Expected& expected, const std::vector<Printed>& printed) {
    auto wanted = expected.printed.begin();
    for (std::size_t i = 0; i < printed.size(); ++i) {
        const int until = end_of(printed, i);
        Lines lines;
        for (; wanted != expected.printed.end() && wanted->first < until; ++wanted)
            lines.insert(lines.end(), wanted->second.begin(), wanted->second.end());
        require_reason(comparison, expected, lines, printed[i].line, until);
        const auto rows = side_by_side(lines, printed[i].text);
        if (std::ranges::any_of(rows, [](const Row& row) { return !row.equal(); }))
            comparison.fail(shown(printed[i].line, rows));
    }
}

void compare_messages(Comparison& comparison, const Expected& expected, const Lines& messages,
                      const std::string& name) {
    std::size_t found = 0;
    for (const auto& line : messages) {
        std::size_t at = std::string::npos;
        for (const char* kind : {"error: ", "warning: ", "note: "}) at = std::min(at, line.find(kind));
        const bool starts_message = at != std::string::npos && (at == 0 || line.compare(at - 2, 2, ": ") == 0) &&
                                    line.find('|') == std::string::npos && !line.starts_with(' ');
        if (!starts_message) continue;
        if (line.find("kaya-painter' is not there") != std::string::npos) {
            comparison.untried = "its pictures need kaya-painter (scripts/install --pictures); all else agrees";
            continue;
        }
        if (found >= expected.messages.size()) {
            comparison.fail("not expected: " + line);
            continue;
        }
        const auto& wanted = expected.messages[found++];
        const std::string place = name + ":" + std::to_string(wanted.line) + ":";
        if (!line.starts_with(place)) comparison.fail("expected at " + place + " but found " + line);
        if (!matches(wanted.text, line.substr(at)))
            comparison.fail("message\n    " + line.substr(at) + "\n  but expected is\n    " + wanted.text);
    }
    for (; found < expected.messages.size(); ++found)
        comparison.fail("no message at line " + std::to_string(expected.messages[found].line) + ": " +
                        expected.messages[found].text);
    for (const auto& hint : expected.hints)
        if (std::ranges::none_of(messages, [&](const auto& line) { return line.find(hint) != std::string::npos; }))
            comparison.fail("the messages do not say: " + hint);
}

void compare_files(Comparison& comparison, const Expected& expected, const fs::path& folder) {
    for (const auto& file : expected.makes)
        if (!fs::exists(folder / file)) comparison.fail("not made: " + file);
    for (const auto& file : expected.lacks)
        if (fs::exists(folder / file)) comparison.fail("should not be there: " + file);
    for (const auto& entry : expected.holds) {
        const auto blank = entry.find(' ');
        const std::string file = entry.substr(0, blank), text = entry.substr(blank + 1);
        if (!fs::exists(folder / file)) {
            comparison.fail("not made: " + file);
            continue;
        }
        const auto lines = read_lines(folder / file);
        if (std::ranges::none_of(lines, [&](const auto& line) { return line.find(text) != std::string::npos; }))
            comparison.fail(file + " does not hold: " + text);
    }
}

/// The line with its "..." if it still matches, otherwise the text.
std::string kept_pattern(const Expected& expected, const std::string& text) {
    for (const auto& [line, patterns] : expected.printed)
        for (const auto& pattern : patterns)
            if (matches(pattern, text)) return pattern;
    return text;
}

/// The deck with new `;>` lines after the commands that print, unless one of their numbers has no reason.
void bless(Comparison& comparison, const fs::path& file, const Lines& deck, const Expected& expected,
           const std::vector<Printed>& printed) {
    for (std::size_t i = 0; i < printed.size(); ++i) {
        Lines lines;
        for (const auto& text : printed[i].text) lines.push_back(kept_pattern(expected, text));
        require_reason(comparison, expected, lines, printed[i].line, end_of(printed, i));
    }
    if (comparison.failed()) return;
    std::map<int, Lines> behind_line;
    for (std::size_t i = 0; i < printed.size(); ++i) {
        const int until = i + 1 < printed.size() ? printed[i + 1].line : static_cast<int>(deck.size()) + 1;
        int last = printed[i].line;
        for (int line = printed[i].line + 1; line < until; ++line) {
            const auto first = deck[line - 1].find_first_not_of(" \t\r");
            if (first != std::string::npos && deck[line - 1][first] != ';') last = line;
        }
        auto& lines = behind_line[printed[i].line == 0 ? 0 : last];
        lines.insert(lines.end(), printed[i].text.begin(), printed[i].text.end());
    }
    const std::string ending = !deck.empty() && deck.front().ends_with('\r') ? "\r\n" : "\n";
    std::ofstream stream(file, std::ios::binary);
    for (std::size_t i = 0; i <= deck.size(); ++i) {
        if (i > 0 && !behind(deck[i - 1], ";>")) stream << deck[i - 1] << '\n';
        for (const auto& text : behind_line[static_cast<int>(i)])
            stream << ";> " << kept_pattern(expected, text) << ending;
    }
}

int test(const fs::path& program, const fs::path& deck_file, bool blessing) {
    const Lines deck = read_lines(deck_file);
    const Expected expected = read_expected(deck);
    const Folder folder;
    const Outcome outcome = run(fs::absolute(program), fs::absolute(deck_file), expected, folder);
    const std::string name = deck_file.filename().string();
    const auto printed = split(outcome.printed, name);
    Comparison comparison;
    if (blessing) bless(comparison, deck_file, deck, expected, printed);
    if (outcome.status != expected.status)
        comparison.fail("exit status " + std::to_string(outcome.status) + ", but expected is " +
                        std::to_string(expected.status));
    if (!blessing) compare_printed(comparison, expected, printed);
    compare_messages(comparison, expected, outcome.messages, name);
    compare_files(comparison, expected, folder.path);
    if (!comparison.failed() && !comparison.untried.empty()) {
        std::cout << "skipped: " << comparison.untried << '\n';
        return 77; // ctest counts it as skipped
    }
    if (!comparison.failed()) return 0;
    std::cout << "--- all messages of " << name << '\n';
    for (const auto& line : outcome.messages) std::cout << line << '\n';
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    const bool blessing = argc == 4 && std::string_view(argv[3]) == "--bless";
    if (argc != 3 && !blessing) {
        std::cerr << "usage: deck_test PROGRAM DECK [--bless]\n";
        return 2;
    }
    try {
        return test(argv[1], argv[2], blessing);
    } catch (const std::exception& error) {
        std::cerr << "deck_test: " << error.what() << '\n';
        return 2;
    }
}
