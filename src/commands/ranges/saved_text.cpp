#include "commands/ranges/saved_text.hpp"

#include "base/diagnostic.hpp"

#include <cstdlib>

namespace kaya {

SavedText::SavedText(const std::string& text, std::string what) : stream_(text), what_(std::move(what)) {}

void SavedText::refuse() const {
    throw Diagnostic("the " + what_ + " of the save file cannot be read", "the file was changed", Fault::run);
}

bool SavedText::at_end() { return (stream_ >> std::ws).eof(); }

std::int64_t SavedText::whole(std::int64_t least, std::int64_t most) {
    std::int64_t value = 0;
    if (!(stream_ >> value) || value < least || value > most) refuse();
    return value;
}

double SavedText::number() {
    std::string word;
    stream_ >> word; // strtod reads what {:a} writes; streams do not
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0') refuse();
    return value;
}

std::string SavedText::name() {
    std::string name(count(), '\0');
    stream_.get();
    stream_.read(name.data(), static_cast<std::streamsize>(name.size()));
    if (!stream_) refuse();
    return name;
}

} // namespace kaya
