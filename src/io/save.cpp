#include "io/save.hpp"

#include "base/diagnostic.hpp"
#include "io/hdf5_tree.hpp"
#include "io/save_trailer.hpp"
#include "io/save_walk.hpp"
#include "base/whole_file.hpp"
#include "model/state.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

/// Leads the walk of model/state.hpp into a tree.
class SaveArchive {
public:
    explicit SaveArchive(TreeWriter& tree) : tree_(tree) {}

    template <class T> void value(const std::string& name, T& value) {
        tree_.attribute(name, scalars(value), Plain<T>::count);
    }
    void text(const std::string& name, std::string& text) { tree_.text(name, text); }
    template <class T> void column(const std::string& name, Column<T>& column) {
        tree_.data(name, scalars(column), column.size(), Plain<T>::count);
    }
    template <class T> void rows(T& table) {
        std::uint64_t rows = table.size();
        value("rows", rows);
    }
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& all, Visit&& visit) {
        section(name, [&] {
            std::uint64_t count = all.size();
            value("count", count);
            for (std::size_t k = 0; k < all.size(); ++k) section(std::to_string(k), [&] { visit(all[k]); });
        });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) {
        tree_.open_group(name);
        visit();
        tree_.close_group();
    }
    template <class Visit> void aside(Visit&& visit) { visit(); }
    template <class Visit> void since(std::int32_t, bool, Visit&& visit) { visit(); }

private:
    TreeWriter& tree_;
};

} // namespace

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
