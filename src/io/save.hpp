// The whole model as a file, and back. The layout is described in docs/save-files.md.
#pragma once

#include "base/units.hpp"
#include "model/tables/model.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Raised when stored data change their meaning. A column or value that is added needs no new number: a save without it is restored with
/// the initial value of a new model.
inline constexpr std::int32_t save_format_version = 14;
/// The first format that is still read: earlier ones belong to unreleased programs.
inline constexpr std::int32_t first_kept_format = 10;
/// The state hash of formats before was another function of the state.
inline constexpr std::int32_t first_comparable_format = 14;

/// Name of an item of SaveExtras::scripts that is a sentence about the file and not part of the state.
inline constexpr std::string_view remark_item = "remark";

/// Parts of a save file beyond the model; the model does not depend on them.
struct SaveExtras {
    struct Item {
        std::string name;
        std::string content; ///< any bytes
    };
    std::int32_t format = save_format_version; ///< of the file that it was read from
    std::string program_version;
    std::string title;
    std::vector<Item> scripts; ///< state of the script languages, by part
    std::vector<Item> decks;   ///< texts of the files that made this model, in order of reading

    /// State that the file lacks: it is older than these columns, values and tables, which have their initial values.
    std::vector<std::string> missing;
};

/// The bytes of a save file. The same state gives the same bytes.
std::string save_image(Model& model, const SaveExtras& extras);

/// Writes it whole or not at all (base/whole_file.hpp). Throws Diagnostic (Fault::run).
void save_state(Model& model, const std::string& path, const SaveExtras& extras);

/// Reads an image. The model is built separately, checked (model/whole/consistency.hpp, state hash) and moved at the end: on any error Diagnostic
/// is thrown and `model` is unchanged. `name` is for messages.
SaveExtras restore_image(Model& model, std::string_view image, const std::string& name);
SaveExtras restore_state(Model& model, const std::string& path);

/// The units that the deck named, a part of `scripts`; none of files without them.
Units units_of(const SaveExtras& extras);
void keep_units(SaveExtras& extras, const Units& units);

} // namespace kaya
