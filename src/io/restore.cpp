#include "base/diagnostic.hpp"
#include "io/hdf5_tree.hpp"
#include "io/save.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "base/whole_file.hpp"
#include "model/consistency.hpp"
#include "model/state.hpp"

#include <fmt/format.h>

#include <limits>

namespace kaya {

namespace {

/// Looks whether every column of a table is in the file with that many rows, before the table grows.
struct RowCheck {
    TreeReader& tree;
    std::size_t rows;

    template <class T> void column(const std::string& name, Column<T>&) {
        using S = typename Plain<T>::scalar;
        if (tree.rows<S>(name, Plain<T>::count) != rows) throw TreeError("column " + name + " has other rows");
    }
};

/// Leads the walk of model/state.hpp out of a tree.
class RestoreArchive {
public:
    explicit RestoreArchive(TreeReader& tree) : tree_(tree) {}

    template <class T> void value(const std::string& name, T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 0;
            tree_.attribute(name, &byte, 1);
            if (byte > 1) throw TreeError(name + " is neither true nor false");
            value = byte == 1;
        } else {
            tree_.attribute(name, scalars(value), Plain<T>::count);
        }
    }
    void text(const std::string& name, std::string& text) { text = tree_.text(name); }
    template <class T> void column(const std::string& name, Column<T>& column) {
        using S = typename Plain<T>::scalar;
        column.resize(tree_.rows<S>(name, Plain<T>::count), new_value<T>());
        tree_.data(name, scalars(column), column.size(), Plain<T>::count);
    }
    template <class T> void rows(T& table) {
        std::uint64_t rows = 0;
        value("rows", rows);
        if (rows > static_cast<std::uint64_t>(std::numeric_limits<Row>::max())) throw TreeError("too many rows");
        RowCheck check{tree_, static_cast<std::size_t>(rows)};
        table.columns([&](const std::string& name, auto& column, Role) { visit_column(check, name, column); });
        table.resize(static_cast<std::size_t>(rows));
    }
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& all, Visit&& visit) {
        section(name, [&] {
            std::uint64_t count = 0;
            value("count", count);
            all.clear();
            // One by one: a count that is wrong ends at the first record that is missing.
            for (std::uint64_t k = 0; k < count; ++k) section(std::to_string(k), [&] { visit(all.emplace_back()); });
        });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) {
        tree_.open_group(name);
        visit();
        tree_.close_group();
    }
    template <class Visit> void aside(Visit&& visit) { visit(); }
    template <class Visit> void since(std::int32_t format, bool, Visit&& visit) {
        if (version >= format) visit();
    }

    std::int32_t version = 0; ///< of the file

private:
    TreeReader& tree_;
};

Diagnostic unusable(const std::string& name, const std::string& why) {
    return Diagnostic(fmt::format("'{}' cannot be restored: {}", name, why),
                      "the model is as it was; restore another save file", Fault::run);
}

/// The name is at this place in every format so far.
std::string writer_of(TreeReader& tree) {
    try {
        return " of kaya " + tree.text("program_version");
    } catch (const TreeError&) { return {}; }
}

/// What can be done about a file that this program does not read.
Diagnostic other_format(const std::string& name, std::int32_t version, const std::string& writer) {
    Diagnostic refusal = unusable(name, fmt::format("it has format {}{}, and this program reads formats {} to {}",
                                                    version, writer, first_kept_format, save_format_version));
    refusal.hint =
        version > save_format_version
            ? "the model is as it was; restore it with the program that wrote it, or a later one"
            : fmt::format(
                  "the model is as it was; formats before {} are older than the first release: run the deck again, "
                  "or go on with the program that wrote the file",
                  first_kept_format);
    return refusal;
}

} // namespace

SaveExtras restore_image(Model& model, std::string_view image, const std::string& name) {
    const std::string_view tree_image = without_trailer(image, name);
    SaveExtras extras;
    Model fresh;
    try {
        TreeReader tree(tree_image);
        RestoreArchive archive(tree);
        std::uint64_t hash = 0;
        archive.value("format_version", archive.version);
        if (archive.version < first_kept_format || archive.version > save_format_version)
            throw other_format(name, archive.version, writer_of(tree));
        archive.value("state_hash", hash);
        visit_extras(archive, extras);
        extras.format = archive.version;
        // Until format 11 the column is always there.
        if (archive.version < 12) fresh.zones.keeps_dashpots = fresh.excavated.zones.keeps_dashpots = true;
        archive.section("model", [&] { visit_state(archive, fresh); });
        const std::string wrong = inconsistency(fresh);
        if (!wrong.empty()) throw unusable(name, wrong);
        if (state_hash(fresh) != hash) throw unusable(name, "its content does not add up to the state hash in it");
    } catch (const TreeError& error) { throw unusable(name, error.what()); } catch (const std::bad_alloc&) {
        throw unusable(name, "there is not enough memory for it");
    }
    ModelEdit(fresh, Change::lists); // what the cycle derives from the tables is not in the file
    model = std::move(fresh);
    return extras;
}

SaveExtras restore_state(Model& model, const std::string& path) {
    return restore_image(model, read_whole_file(path), path);
}

} // namespace kaya
