#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "base/whole_file.hpp"
#include "io/save_archive.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "model/state.hpp"

#include <fmt/format.h>

namespace kaya {

std::string save_image(Model& model, const SaveExtras& extras) {
    try {
        TreeWriter tree;
        SaveArchive archive(tree);
        std::int32_t version = save_format_version;
        std::uint64_t hash = state_hash(model);
        archive.value("format_version", version);
        archive.value("state_hash", hash);
        SaveExtras copy = extras;
        visit_extras(archive, copy);
        archive.section("model", [&] { visit_state(archive, model); });
        return with_trailer(tree.image());
    } catch (const TreeError& error) {
        throw Diagnostic(fmt::format("the model cannot be saved: {}", error.what()),
                         "is there enough memory? the file is made there first, and written as a whole", Fault::run);
    }
}

void save_state(Model& model, const std::string& path, const SaveExtras& extras) {
    write_whole_file(path, save_image(model, extras));
}

} // namespace kaya
