#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "io/save_archive.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "model/whole/state.hpp"
#include "model/whole/state_hash.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

void SaveArchive::numbers(std::string_view name, const Numbers& value) {
    tree_.attribute(std::string(name), value.type, value.first, value.count());
}

void SaveArchive::text(std::string_view name, std::string& text) { tree_.text(std::string(name), text); }

void SaveArchive::number_list(std::string_view name, NumberList& list) { data(name, list.numbers()); }

void SaveArchive::numbers_column(std::string_view name, const Numbers& column, const Numbers&) { data(name, column); }

void SaveArchive::rows(TableRows& table) {
    std::uint64_t rows = table.size();
    value("rows", rows);
}

void SaveArchive::record_list(std::string_view name, RecordList& records) {
    section(name, [&] {
        std::uint64_t count = records.size();
        value("count", count);
        for (std::size_t k = 0; k < count; ++k) section(std::to_string(k), [&] { records.visit(k); });
    });
}

void SaveArchive::group(std::string_view name, const Visit& visit) {
    tree_.open_group(std::string(name));
    visit();
    tree_.close_group();
}

void SaveArchive::data(std::string_view name, const Numbers& numbers) {
    tree_.data(std::string(name), numbers.type, numbers.first, numbers.rows, numbers.each);
}

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

Units units_of(const SaveExtras& extras) {
    const auto found = std::ranges::find(extras.scripts, "units", &SaveExtras::Item::name);
    return found == extras.scripts.end() ? Units() : Units(found->content);
}

void keep_units(SaveExtras& extras, const Units& units) {
    if (units.given()) extras.scripts.push_back({"units", units.name()});
}

} // namespace kaya
