// The archive that writes a save file.
#pragma once

#include "io/hdf5_tree.hpp"
#include "model/state.hpp"

namespace kaya {

/// Leads the walk of model/state.hpp into a tree.
class SaveArchive {
public:
    explicit SaveArchive(TreeWriter& tree) : tree_(tree) {}

    template <class T> void value(const std::string& name, T& value) {
        tree_.attribute(name, scalars(value), Plain<T>::count);
    }
    void text(const std::string& name, std::string& text) { tree_.text(name, text); }
    template <class T> void list(const std::string& name, Column<T>& list) {
        tree_.data(name, scalars(list), list.size(), Plain<T>::count);
    }
    template <class T> void column(const std::string& name, Column<T>& column, const T&) { list(name, column); }
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

private:
    TreeWriter& tree_;
};

} // namespace kaya
