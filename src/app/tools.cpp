#include "app/tools.hpp"

#include "lang/commands/language.hpp"
#include "lang/interp/format.hpp"

#include <fmt/format.h>
#include <fstream>

namespace kaya {

namespace {

namespace fs = std::filesystem;

/// The new text takes the place of the old one as a whole or not at all.
void replace(const fs::path& file, const std::string& text) {
    fs::path beside = file;
    beside += ".tmp";
    std::ofstream stream(beside, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code problem;
    if (stream.good()) {
        fs::permissions(beside, fs::status(file, problem).permissions(), problem);
        fs::rename(beside, file, problem);
    }
    if (stream.good() && !problem) return;
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw Diagnostic(fmt::format("'{}' cannot be written", file.string()), "is it write-protected, or the disk full?",
                     Fault::run);
}

} // namespace

int format_decks(const std::vector<std::string>& decks, bool in_place, Output& output) {
    int status = 0;
    for (const auto& deck : decks) {
        try {
            const fs::path path = lang::find_deck(deck, {"."});
            const auto source = lang::read_source(path, deck);
            const std::string text = lang::format_deck(lang::classic(), source);
            if (in_place) replace(path, text);
            else output.print(text);
        } catch (const lang::DeckErrors& errors) {
            for (const auto& error : errors.all) output.message(error);
            status = static_cast<int>(Fault::deck);
        } catch (const Diagnostic& error) {
            output.message(error);
            status = static_cast<int>(error.fault);
        }
    }
    return status;
}

} // namespace kaya
