#include "joints/library_file.hpp"

#include <cstring>
#include <elf.h>
#include <fstream>

namespace kaya {

std::string fault_of_library_file(const std::filesystem::path& file) {
    const std::string not_a_library = "is not a shared library";
    if (!std::filesystem::is_regular_file(file)) return not_a_library;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return "cannot be read";

    Elf64_Ehdr header{};
    stream.read(reinterpret_cast<char*>(&header), sizeof header);
    if (stream.gcount() < SELFMAG || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return not_a_library;
    const std::string cut_off = "is cut off: the file is shorter than its own table says";
    if (!stream) return cut_off;
    if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN) return not_a_library;

    const auto size = std::filesystem::file_size(file);
    for (unsigned k = 0; k < header.e_phnum; ++k) {
        Elf64_Phdr segment{};
        stream.seekg(static_cast<std::streamoff>(header.e_phoff + k * sizeof segment));
        stream.read(reinterpret_cast<char*>(&segment), sizeof segment);
        if (!stream || segment.p_offset > size || segment.p_filesz > size - segment.p_offset) return cut_off;
    }
    return {};
}

} // namespace kaya
