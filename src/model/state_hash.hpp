// The digest of a state: names and bits of all values that differ from a new model. A table without rows, a column of initial values, a
// setting that was never changed and an empty list add nothing, so that a later program with more of them computes the same digest.
#pragma once

#include "base/hash.hpp"
#include "model/state.hpp"

#include <map>
#include <string>
#include <string_view>

namespace kaya {

/// Values of a new model by name; those of a new record of a list are under the name of the list and `*`.
class InitialState {
public:
    InitialState() {
        Model model;
        visit_state(*this, model);
    }

    bool holds(const std::string& name, std::string_view bytes) const {
        const auto found = values_.find(name);
        return found != values_.end() && found->second == bytes;
    }

    template <class T> void value(const std::string& name, T& value) { values_[path_ + name] = bytes_of(value); }
    void text(const std::string& name, std::string& text) { values_[path_ + name] = text; }
    template <class T> void list(const std::string& name, Column<T>& list) { values_[path_ + name] = bytes_of(list); }
    template <class T> void column(const std::string&, Column<T>&, const T&) {}
    template <class T> void rows(T& table) { count("rows", table.size()); }
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& all, Visit&& visit) {
        section(name, [&] {
            count("count", all.size());
            section("*", [&] {
                S record{};
                visit(record);
            });
        });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) {
        const std::size_t length = path_.size();
        path_ += name + "/";
        visit();
        path_.resize(length);
    }
    template <class Visit> void aside(Visit&&) {}

    template <class T> static std::string_view bytes_of(T& value) {
        return {reinterpret_cast<const char*>(scalars(value)), sizeof(T)};
    }
    template <class T> static std::string_view bytes_of(Column<T>& column) {
        return {reinterpret_cast<const char*>(scalars(column)), column.size() * sizeof(T)};
    }

private:
    void count(const std::string& name, std::uint64_t number) { value(name, number); }

    std::map<std::string, std::string, std::less<>> values_;
    std::string path_;
};

/// An archive that only reads. The digest includes names and values.
class HashArchive {
public:
    template <class T> void value(const std::string& name, T& value) { add(name, InitialState::bytes_of(value)); }
    void text(const std::string& name, std::string& text) { add(name, text); }
    template <class T> void list(const std::string& name, Column<T>& list) { add(name, InitialState::bytes_of(list)); }
    template <class T> void column(const std::string& name, Column<T>& column, T initial) {
        const std::string_view all = InitialState::bytes_of(column), one = InitialState::bytes_of(initial);
        for (std::size_t at = 0; at < all.size(); at += one.size())
            if (all.substr(at, one.size()) != one) return hash(name, all);
    }
    template <class T> void rows(T& table) { count("rows", table.size()); }
    template <class S, class Visit> void records(const std::string& name, std::vector<S>& all, Visit&& visit) {
        section(name, [&] {
            count("count", all.size());
            for (std::size_t k = 0; k < all.size(); ++k) below(std::to_string(k), "*", [&] { visit(all[k]); });
        });
    }
    template <class Visit> void section(const std::string& name, Visit&& visit) { below(name, name, visit); }
    template <class Visit> void aside(Visit&&) {}

    std::uint64_t digest() const { return hash_.value(); }

private:
    void count(const std::string& name, std::uint64_t number) { value(name, number); }

    void add(const std::string& name, std::string_view bytes) {
        if (!initial_.holds(kind_ + name, bytes)) hash(name, bytes);
    }

    void hash(const std::string& name, std::string_view bytes) {
        hash_.add(path_ + name);
        hash_.add(bytes);
    }

    template <class Visit> void below(const std::string& name, const std::string& kind, Visit&& visit) {
        const std::size_t path_length = path_.size(), kind_length = kind_.size();
        path_ += name + "/";
        kind_ += kind + "/";
        visit();
        path_.resize(path_length);
        kind_.resize(kind_length);
    }

    const InitialState initial_;
    Hash hash_;
    std::string path_, kind_; ///< where the walk is, with the numbers of records and with `*` in their place
};

} // namespace kaya
