// What goes along the walk over everything that a Model holds (state.hpp). An archive sees numbers by their place and type, so that the
// walk is compiled once for all archives, and not for each of them with each of 300 columns.
#pragma once

#include "base/scalar.hpp"
#include "model/edit/plain.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Values of a plain type (plain.hpp): `rows` of them, of `each` numbers.
struct Numbers {
    Scalar type;
    void* first;
    std::size_t rows, each;

    std::size_t count() const { return rows * each; }
    std::string_view bytes() const { return {static_cast<const char*>(first), count() * size_of(type)}; }
};

template <class T> Numbers numbers_of(T& value) {
    return {scalar_of<typename Plain<T>::scalar>(), scalars(value), 1, Plain<T>::count};
}
template <class T> Numbers numbers_of(Column<T>& column) {
    return {scalar_of<typename Plain<T>::scalar>(), scalars(column), column.size(), Plain<T>::count};
}

/// Calls see(first, count) with a pointer to numbers of their type.
template <class See> void with_type(const Numbers& numbers, See&& see) {
    switch (numbers.type) {
    case Scalar::boolean: return see(static_cast<bool*>(numbers.first), numbers.count());
    case Scalar::uint8: return see(static_cast<std::uint8_t*>(numbers.first), numbers.count());
    case Scalar::int32: return see(static_cast<std::int32_t*>(numbers.first), numbers.count());
    case Scalar::uint32: return see(static_cast<std::uint32_t*>(numbers.first), numbers.count());
    case Scalar::int64: return see(static_cast<std::int64_t*>(numbers.first), numbers.count());
    case Scalar::uint64: return see(static_cast<std::uint64_t*>(numbers.first), numbers.count());
    case Scalar::float64: return see(static_cast<double*>(numbers.first), numbers.count());
    }
}

/// A list of plain values.
class NumberList {
public:
    virtual Numbers numbers() = 0;
    virtual void resize(std::size_t rows) = 0;

protected:
    ~NumberList() = default;
};

/// A list of structs, each of which has its own part of the walk.
class RecordList {
public:
    virtual std::size_t size() const = 0;
    virtual void clear() = 0;
    virtual void visit(std::size_t record) = 0;
    virtual void visit_new() = 0;     ///< of a record that is appended
    virtual void visit_initial() = 0; ///< of a new record that is not in the list

protected:
    ~RecordList() = default;
};

/// What sees the columns of a table.
class ColumnArchive {
public:
    /// A plain value for each row; a new row has `initial`.
    virtual void numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) = 0;

    template <class T> void column(std::string_view name, Column<T>& column, T initial) {
        numbers_column(name, numbers_of(column), numbers_of(initial));
    }

protected:
    ~ColumnArchive() = default;
};

/// A table before its columns are visited.
class TableRows {
public:
    virtual std::size_t size() const = 0;
    virtual void resize(std::size_t rows) = 0;
    virtual void columns(ColumnArchive& archive) = 0;

protected:
    ~TableRows() = default;
};

/// A part of the walk; the function must outlive it.
class Visit {
public:
    template <class Function> explicit Visit(const Function& function)
        : function_(&function), call_([](const void* called) { (*static_cast<const Function*>(called))(); }) {}
    void operator()() const { call_(function_); }

private:
    const void* function_;
    void (*call_)(const void*);
};

class Archive : public ColumnArchive {
public:
    virtual void numbers(std::string_view name, const Numbers& value) = 0; ///< one value
    virtual void text(std::string_view name, std::string& text) = 0;
    virtual void number_list(std::string_view name, NumberList& list) = 0;
    virtual void rows(TableRows& table) = 0; ///< before the table's columns
    virtual void record_list(std::string_view name, RecordList& records) = 0;
    virtual void group(std::string_view name, const Visit& visit) = 0; ///< with a separate set of names
    virtual void outside(const Visit& visit) = 0; ///< data without influence on the run: the hash leaves them out

    template <class T> void value(std::string_view name, T& value) { numbers(name, numbers_of(value)); }

    template <class T> void list(std::string_view name, Column<T>& list) {
        struct List final : NumberList {
            explicit List(Column<T>& seen) : all(seen) {}
            Numbers numbers() override { return numbers_of(all); }
            void resize(std::size_t rows) override { all.resize(rows, new_value<T>()); }
            Column<T>& all;
        } plain(list);
        number_list(name, plain);
    }

    /// visit(S&) is called for each record, inside a separate section.
    template <class S, class Function>
    void records(std::string_view name, std::vector<S>& all, const Function& visit_record) {
        struct Records final : RecordList {
            Records(std::vector<S>& seen, const Function& function) : all(seen), call(function) {}
            std::size_t size() const override { return all.size(); }
            void clear() override { all.clear(); }
            void visit(std::size_t record) override { call(all[record]); }
            void visit_new() override { call(all.emplace_back()); }
            void visit_initial() override {
                S record{};
                call(record);
            }
            std::vector<S>& all;
            const Function& call;
        } list(all, visit_record);
        record_list(name, list);
    }

    template <class Function> void section(std::string_view name, const Function& visit) { group(name, Visit(visit)); }
    template <class Function> void aside(const Function& visit) { outside(Visit(visit)); }

protected:
    ~Archive() = default;
};

} // namespace kaya
