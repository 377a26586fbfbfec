#include "system/run_record.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <sys/mman.h>
#include <tuple>
#include <unistd.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// A terminal would obey a control character.
char shown(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '?' : c; }

/// The record, and after it the laws with their texts. Pages that are not used take no memory.
struct Room {
    RunRecord record;
    char texts[1 << 20];
    std::size_t used = 0;

    /// Memory in the room; nullptr when it is full.
    void* take(std::size_t bytes, std::size_t alignment) {
        const std::size_t first = (used + alignment - 1) / alignment * alignment;
        if (first + bytes > sizeof texts) return nullptr;
        used = first + bytes;
        return texts + first;
    }
    const char* keep(std::string_view text) {
        auto* const copy = static_cast<char*>(take(text.size() + 1, 1));
        if (copy == nullptr) return nullptr;
        std::ranges::transform(text, copy, shown);
        copy[text.size()] = '\0';
        return copy;
    }
};

Room* new_room() {
    void* const memory =
        ::mmap(nullptr, sizeof(Room), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    Room* const made = new (memory) Room; // mapped memory is zero: only what begins otherwise is written
    made->record.process = ::getpid();
    return made;
}

Room*& room() {
    static Room* own = new_room();
    return own;
}

using Laws = std::map<std::tuple<std::string, std::string, std::string>, Called*>;
std::mutex laws_lock;
Laws& laws() {
    static auto* const all = new Laws; // outlives all exits
    return *all;
}

void copy_text(char (&to)[RunRecord::longest_text], std::string_view text) {
    const std::size_t length = std::min(text.size(), sizeof to - 1);
    std::ranges::transform(text.substr(0, length), to, shown);
    to[length] = '\0';
}

/// Folders that hold `joints` and `zones` of the program: next to it or where it is installed, and those that were added. Outlives all exits.
std::vector<fs::path>& own_folders() {
    static auto* const folders = [] {
        std::error_code ignored;
        const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
        return new std::vector{program, program.parent_path() / "lib/kaya"};
    }();
    return *folders;
}

bool ships(std::string_view file) {
    std::error_code ignored;
    const fs::path folder = fs::weakly_canonical(file, ignored).parent_path();
    return (folder.filename() == "joints" || folder.filename() == "zones") &&
           std::ranges::find(own_folders(), folder.parent_path()) != own_folders().end();
}

} // namespace

RunRecord& run_record() { return room()->record; }

void begin_run_record() {
    const std::lock_guard guard(laws_lock);
    room() = new_room();
    laws().clear();
}

void add_own_folders(const std::vector<fs::path>& joints) {
    const std::lock_guard guard(laws_lock);
    std::error_code ignored;
    for (const auto& folder : joints) {
        fs::path own = fs::weakly_canonical(folder, ignored).parent_path();
        if (std::ranges::find(own_folders(), own) == own_folders().end()) own_folders().push_back(std::move(own));
    }
}

const Called* called(std::string_view name, std::string_view file, const char* noun) {
    const std::lock_guard guard(laws_lock);
    Called*& law = laws()[{std::string(name), std::string(file), noun}];
    if (law != nullptr) return law;
    static Called one_of_many{"one of many", "of more than can be named", "law", true};
    Room& own = *room();
    const char *const own_name = own.keep(name), *const own_file = own.keep(file);
    void* const memory = own.take(sizeof(Called), alignof(Called));
    law = own_name && own_file && memory ? new (memory) Called{own_name, own_file, noun, !ships(file)} : &one_of_many;
    return law;
}

void hold_names() { laws_lock.lock(); }

void release_names() { laws_lock.unlock(); }

std::string take_suspects() {
    const std::lock_guard guard(laws_lock);
    std::string names;
    std::set<std::string_view> files; // a law is called by the name of its file until it has said its own
    for (auto& [texts, law] : laws())
        if (law->is_suspected.exchange(false) && files.insert(law->file).second)
            names += fmt::format("{}{} '{}' ({})", names.empty() ? "" : " or ", law->noun, law->name, law->file);
    return names;
}

void note_end(int status) {
    RunRecord& record = run_record();
    if (record.process == ::getpid()) record.status = status;
}

void note_reason(std::string_view reason) { copy_text(run_record().reason, reason); }

AtCommand::AtCommand(std::string_view text) {
    char(&command)[RunRecord::longest_text] = run_record().command;
    std::memcpy(before_, command, sizeof before_);
    copy_text(command, text);
}

AtCommand::~AtCommand() { std::memcpy(run_record().command, before_, sizeof before_); }

} // namespace kaya
