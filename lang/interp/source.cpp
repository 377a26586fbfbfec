#include "lang/interp/source.hpp"

#include "system/door.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <set>

namespace kaya::lang {

namespace fs = std::filesystem;

namespace {

/// No deck is near this size; reading a 10 GB result file as text would only exhaust the memory.
constexpr std::uintmax_t largest_deck = 512u << 20;

/// The longest lines seen, written by programs, have some thousand characters. A file without line ends is not a command file, and would
/// fill the memory with its words.
constexpr std::size_t longest_line = 4u << 20;

constexpr std::array suffixes = {"", ".3dd", ".dat", ".3ddat", ".fis", ".txt"};

/// The probable kind of a binary file, by its first bytes.
struct Signature {
    std::string_view start;
    const char* message;
    const char* hint;
};
constexpr std::array signatures = {
    Signature{"\x89HDF", "'{}' is a saved model, not a command file", "restore it with: restore {}"},
    Signature{"\xFF\xFE", "'{}' is a UTF-16 text; a command file must be UTF-8 or ASCII",
              "save it again as UTF-8 in the editor"},
    Signature{"\xFE\xFF", "'{}' is a UTF-16 text; a command file must be UTF-8 or ASCII",
              "save it again as UTF-8 in the editor"},
};

void refuse_binary(const std::string& name, std::string_view text) {
    for (const auto& s : signatures)
        if (text.starts_with(s.start))
            throw Diagnostic(fmt::format(fmt::runtime(s.message), name), fmt::format(fmt::runtime(s.hint), name));
    const auto nul = text.find('\0');
    if (nul != std::string_view::npos)
        throw Diagnostic(fmt::format("'{}' holds a byte 0 at position {}: it is not a text", name, nul),
                         "a command file is plain text");
}

void refuse_long_line(const std::shared_ptr<SourceText>& source) {
    const std::string& line = source->lines.back();
    if (line.size() <= longest_line) return;
    throw Diagnostic(fmt::format("this line has {} characters, more than {}", line.size(), longest_line),
                     "are the ends of the lines lost?")
        .at({source, static_cast<int>(source->lines.size()), 1, 1});
}

Diagnostic no_file(const std::string& name, std::string_view near) {
    Diagnostic d(fmt::format("there is no file '{}'", name),
                 near.empty() ? "check the name and the folder" : fmt::format("did you mean '{}'?", near));
    d.code = "no-file";
    return d;
}

} // namespace

Source source_from_text(std::string name, std::string_view text, int first_line) {
    refuse_binary(name, text);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.ends_with('\x1A')) text.remove_suffix(1);

    auto source = std::make_shared<SourceText>();
    source->name = std::move(name);
    source->lines.resize(static_cast<std::size_t>(std::max(0, first_line - 1)));
    while (!text.empty()) {
        const auto end = text.find_first_of("\r\n");
        if (end == std::string_view::npos) {
            source->lines.emplace_back(text);
            refuse_long_line(source);
            break;
        }
        source->lines.emplace_back(text.substr(0, end));
        refuse_long_line(source);
        text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
    }
    return source;
}

Source read_source(const fs::path& path, std::string name) {
    std::error_code error;
    const auto status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw no_file(name, {});
    if (fs::is_directory(status))
        throw Diagnostic(fmt::format("'{}' is a folder, not a command file", name), "name a file inside it");
    if (fs::is_regular_file(status) && fs::file_size(path, error) > largest_deck)
        throw Diagnostic(fmt::format("'{}' has {} MB: too large for a command file (at most {} MB)", name,
                                     fs::file_size(path, error) >> 20, largest_deck >> 20));

    const Descriptor in = door::open(path, Use::read, door::Access::read);
    if (!in)
        throw Diagnostic(fmt::format("'{}' cannot be read: {}", name, std::strerror(errno)),
                         "check the permissions of the file");
    std::string text;
    const bool read = read_all(in.number(), text, largest_deck);
    if (text.size() > largest_deck) // a pipe or device has no size
        throw Diagnostic(
            fmt::format("'{}' is too large for a command file (more than {} MB)", name, largest_deck >> 20));
    if (!read) throw Diagnostic(fmt::format("reading '{}' failed: {}", name, std::strerror(errno)));
    SourceText source = *source_from_text(std::move(name), text);
    source.is_file = true;
    return std::make_shared<const SourceText>(std::move(source));
}

fs::path find_deck(const std::string& name, const std::vector<fs::path>& folders) {
    std::error_code error;
    std::set<std::string> neighbours; // sorted, so that the suggestion never depends on the disk
    for (const auto& folder : folders) {
        const fs::path whole = folder / name;
        for (const auto suffix : suffixes) {
            fs::path candidate = whole;
            candidate += suffix;
            if (fs::exists(candidate, error) && (*suffix == '\0' || !fs::is_directory(candidate, error)))
                return candidate;
        }
        const fs::path parent = whole.has_parent_path() ? whole.parent_path() : fs::path(".");
        for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error))
            if (entry->path().extension() != ".journal") neighbours.insert(entry->path().filename().string());
    }
    const std::vector<std::string_view> candidates(neighbours.begin(), neighbours.end());
    const auto near = did_you_mean(fs::path(name).filename().string(), candidates);
    throw no_file(name, near);
}

} // namespace kaya::lang
