#include "base/diagnostic.hpp"
#include "io/hdf5_tree.hpp"
#include "io/save.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "model/whole/consistency.hpp"
#include "model/whole/state.hpp"
#include "model/whole/state_hash.hpp"
#include "system/whole_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace kaya {

namespace {

/// Checks that the columns of a table in the file have that many rows, before the table grows.
struct RowCheck final : ColumnArchive {
    RowCheck(TreeReader& read, const std::set<std::string>& seen, std::size_t count)
        : tree(read), names(seen), rows(count) {}

    void numbers_column(std::string_view column, const Numbers&, const Numbers& initial) override {
        const std::string name(column);
        if (!names.contains(name)) {
            missing += initial.bytes().size();
            return;
        }
        there += initial.bytes().size();
        if (tree.rows(name, initial.type, initial.each) != rows) throw TreeError("column " + name + " has other rows");
    }

    /// Otherwise a small file could request more than any memory.
    bool fills() const {
        constexpr std::size_t most_missing = 8; // times the size that is present
        return rows == 0 || missing <= most_missing * there;
    }

    TreeReader& tree;
    const std::set<std::string>& names;
    std::size_t rows;
    std::size_t there = 0, missing = 0; ///< bytes of a row
};

/// Fills the walk of model/whole/state.hpp from a tree. A value that the tree lacks keeps its initial value: the file is older than that column,
/// value or table.
class RestoreArchive final : public Archive {
public:
    explicit RestoreArchive(TreeReader& tree) : tree_(tree), left_(tree.names()) {}

    void numbers(std::string_view at, const Numbers& value) override {
        const std::string name(at);
        if (!take(name)) return;
        if (value.type == Scalar::boolean) {
            std::uint8_t byte = 0;
            tree_.attribute(name, &byte, 1);
            if (byte > 1) throw TreeError(name + " is neither true nor false");
            *static_cast<bool*>(value.first) = byte == 1;
        } else {
            tree_.attribute(name, value.type, value.first, value.count());
        }
    }
    void text(std::string_view at, std::string& text) override {
        const std::string name(at);
        if (take(name)) text = tree_.text(name);
    }
    void number_list(std::string_view at, NumberList& list) override {
        const std::string name(at);
        if (!take(name)) return;
        const Numbers before = list.numbers();
        list.resize(tree_.rows(name, before.type, before.each));
        data(name, list.numbers());
    }
    void numbers_column(std::string_view at, const Numbers& column, const Numbers&) override {
        const std::string name(at);
        if (take(name)) data(name, column);
    }
    void rows(TableRows& table) override {
        const std::uint64_t rows = count("rows");
        if (rows > static_cast<std::uint64_t>(std::numeric_limits<Row>::max())) throw TreeError("too many rows");
        RowCheck check(tree_, left_, static_cast<std::size_t>(rows));
        table.columns(check);
        if (!check.fills()) throw TreeError(path_.substr(0, path_.size() - 1) + " has too few columns for its rows");
        table.resize(static_cast<std::size_t>(rows));
    }
    void record_list(std::string_view name, RecordList& all) override {
        section(name, [&] {
            const std::uint64_t records = count("count");
            all.clear();
            // One by one: a count that is wrong ends at the first record that is missing.
            for (std::uint64_t k = 0; k < records; ++k) {
                const std::string number = std::to_string(k);
                left_.erase(number);
                inside(number, "*/", [&] { all.visit_new(); });
            }
        });
    }
    void group(std::string_view at, const Visit& visit) override {
        const std::string name(at);
        if (take(name)) inside(name, name + "/", visit);
    }
    void outside(const Visit& visit) override { visit(); }

    /// Sees names of the group `name`, which must be there; they are noted after `kind`: records of a list have the same ones.
    template <class Function> void inside(const std::string& name, const std::string& kind, const Function& visit) {
        tree_.open_group(name);
        std::set<std::string> outside = std::exchange(left_, tree_.names());
        const std::size_t length = path_.size();
        path_ += kind;
        visit();
        for (const auto& other : left_) note(unknown_, other);
        path_.resize(length);
        left_ = std::move(outside);
        tree_.close_group();
    }

    /// Names that the walk has and the file lacks, and names of the file that the walk lacks.
    const std::vector<std::string>& missing() const { return missing_; }
    const std::vector<std::string>& unknown() const { return unknown_; }

private:
    /// Whether the open group has that name.
    bool take(const std::string& name) {
        if (left_.erase(name) > 0) return true;
        note(missing_, name);
        return false;
    }

    /// A number without which the rest of the group makes no sense.
    std::uint64_t count(const std::string& name) {
        std::uint64_t number = 0;
        left_.erase(name);
        tree_.attribute(name, &number, 1);
        return number;
    }

    void data(const std::string& name, const Numbers& numbers) {
        tree_.data(name, numbers.type, numbers.first, numbers.rows, numbers.each);
    }

    void note(std::vector<std::string>& names, const std::string& name) {
        std::string whole = path_ + name;
        if (std::ranges::find(names, whole) == names.end()) names.push_back(std::move(whole));
    }

    TreeReader& tree_;
    std::set<std::string> left_; ///< names of the open group that the walk has not reached
    std::string path_;
    std::vector<std::string> missing_, unknown_;
};

Diagnostic unusable(const std::string& name, const std::string& why) {
    return Diagnostic(fmt::format("'{}' cannot be restored: {}", name, why),
                      "the model is unchanged; restore another save file", Fault::run);
}

/// The name is at this place in every format so far.
std::string writer_of(TreeReader& tree) {
    try {
        return " of kaya " + tree.text("program_version");
    } catch (const TreeError&) { return {}; }
}

/// The data are not a model, or not the one that was saved.
Diagnostic other_state(const std::string& name, std::string why, const RestoreArchive& archive) {
    if (!archive.missing().empty()) why += fmt::format("; it lacks {}", fmt::join(archive.missing(), ", "));
    return unusable(name, why);
}

/// A later program has saved state that this one does not have.
Diagnostic unknown_state(const std::string& name, const RestoreArchive& archive, const std::string& writer) {
    Diagnostic refusal = other_state(
        name, fmt::format("it holds {}, which this program does not know", fmt::join(archive.unknown(), ", ")),
        archive);
    refusal.hint =
        fmt::format("the model is unchanged; restore it with kaya {}, which wrote it, or a later one", writer);
    return refusal;
}

/// Advice for a file that this program does not read.
Diagnostic other_format(const std::string& name, std::int32_t version, const std::string& writer) {
    Diagnostic refusal = unusable(name, fmt::format("it has format {}{}, and this program reads formats {} to {}",
                                                    version, writer, first_kept_format, save_format_version));
    refusal.hint =
        version > save_format_version
            ? "the model is unchanged; restore it with the program that wrote it, or a later one"
            : fmt::format(
                  "the model is unchanged; formats before {} are older than the first release: run the deck again, "
                  "or continue with the program that wrote the file",
                  first_kept_format);
    return refusal;
}

/// Contacts and loads of models of earlier programs are those of triangles on the outer faces of cells: so they stay, and no force jumps.
/// `missing`: what the file lacks.
void keep_triangles(Model& model, const std::vector<std::string>& missing) {
    if (std::ranges::find(missing, "settings/triangular_outer_faces") == missing.end()) return;
    model.settings.triangular_outer_faces =
        std::ranges::any_of(model.blocks.cell_zones, [](std::int32_t zones) { return zones > 0; });
}

} // namespace

SaveExtras restore_image(Model& model, std::string_view image, const std::string& name) {
    const std::string_view tree_image = without_trailer(image, name);
    SaveExtras extras;
    Model fresh;
    try {
        TreeReader tree(tree_image);
        std::uint64_t hash = 0;
        tree.attribute("format_version", &extras.format, 1);
        if (extras.format < first_kept_format || extras.format > save_format_version)
            throw other_format(name, extras.format, writer_of(tree));
        tree.attribute("state_hash", &hash, 1);
        RestoreArchive archive(tree);
        visit_extras(archive, extras);
        if (!archive.missing().empty()) throw TreeError(archive.missing().front() + " is missing");
        // Until format 11 the column is always there.
        if (extras.format < 12) fresh.zones.keeps_dashpots = fresh.excavated.zones.keeps_dashpots = true;
        archive.inside("model", "", [&] { visit_state(archive, fresh); });
        extras.missing = archive.missing();
        const std::string wrong = inconsistency(fresh);
        if (!wrong.empty()) throw other_state(name, wrong, archive);
        const std::uint64_t present = extras.format >= first_comparable_format ? state_hash(fresh) : hash;
        if (present != hash) {
            if (!archive.unknown().empty()) throw unknown_state(name, archive, extras.program_version);
            static constexpr const char* text =
                "its content does not add up to the state hash in it: {:016x} is not {:016x}";
            throw other_state(name, fmt::format(text, present, hash), archive);
        }
        keep_triangles(fresh, extras.missing);
    } catch (const TreeError& error) { throw unusable(name, error.what()); } catch (const std::bad_alloc&) {
        throw unusable(name, "there is not enough memory for it");
    }
    ModelEdit(fresh, Change::lists); // derived data of the cycle is not in the file
    model = std::move(fresh);
    return extras;
}

SaveExtras restore_state(Model& model, const std::string& path) {
    return restore_image(model, read_whole_file(path), path);
}

} // namespace kaya
