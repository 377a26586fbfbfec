// Walks over the state of programs with one name less or one column more: a program before a column was added, and one after it. Names are
// those of the walk, with `*` for the number of a record.
#pragma once

#include "model/state.hpp"

#include <set>
#include <string>
#include <vector>

namespace kaya::test {

/// All names in the walk over a model.
class NameList {
public:
    std::vector<std::string> all, columns;
    std::set<std::string> holding; ///< columns in which a row does not have the initial value

    template <class T> void value(const std::string& name, T&) { add(name); }
    void text(const std::string& name, std::string&) { add(name); }
    template <class T> void list(const std::string& name, Column<T>&) { add(name); }
    template <class T> void column(const std::string& name, Column<T>& column, const T& initial) {
        add(name);
        columns.push_back(path_ + name);
        if (std::ranges::any_of(column, [&](const T& value) { return value != initial; })) holding.insert(path_ + name);
    }
    template <class T> void rows(T&) {}
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& records, Visit&& visit) {
        section(name, [&] {
            below("*/", [&] {
                for (S& record : records) visit(record);
            });
        });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) {
        add(name);
        below(name + "/", visit);
    }
    template <class Visit> void aside(Visit&& visit) { visit(); }

private:
    void add(const std::string& name) {
        if (std::ranges::find(all, path_ + name) == all.end()) all.push_back(path_ + name);
    }
    template <class Visit> void below(const std::string& name, Visit&& visit) {
        const std::size_t length = path_.size();
        path_ += name;
        visit();
        path_.resize(length);
    }
    std::string path_;
};

inline NameList names_of(Model& model) {
    NameList names;
    visit_state(names, model);
    return names;
}

/// Passes an archive along the walk of another program.
template <class Archive> class OtherWalk {
public:
    explicit OtherWalk(Archive& archive) : archive_(archive) {}

    std::string without; ///< a name unknown to the other program
    std::string with;    ///< "table/column": the other program has this column
    Column<double> more; ///< and these are its numbers

    template <class T> void value(const std::string& name, T& value) {
        if (knows(name)) archive_.value(name, value);
    }
    void text(const std::string& name, std::string& text) {
        if (knows(name)) archive_.text(name, text);
    }
    template <class T> void list(const std::string& name, Column<T>& list) {
        if (knows(name)) archive_.list(name, list);
    }
    template <class T> void column(const std::string& name, Column<T>& column, const T& initial) {
        if (knows(name)) archive_.column(name, column, initial);
    }
    template <class T> void rows(T& table) {
        archive_.rows(table);
        if (with.starts_with(path_)) archive_.column(with.substr(path_.size()), more, 0.0);
    }
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& all, Visit&& visit) {
        if (knows(name)) archive_.records(name, all, [&](S& record) { below(name + "/*/", [&] { visit(record); }); });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) {
        if (knows(name)) archive_.section(name, [&] { below(name + "/", visit); });
    }
    template <class Visit> void aside(Visit&& visit) { archive_.aside(visit); }

private:
    bool knows(const std::string& name) const { return path_ + name != without; }
    template <class Visit> void below(const std::string& name, Visit&& visit) {
        const std::size_t length = path_.size();
        path_ += name;
        visit();
        path_.resize(length);
    }

    Archive& archive_;
    std::string path_;
};

} // namespace kaya::test
