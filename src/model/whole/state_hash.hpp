// The digest of a state: names and bits of all values that differ from a new model. A table without rows, a column of initial values, a
// setting that was never changed and an empty list add nothing, so that a later program with more of them computes the same digest.
#pragma once

#include "base/hash.hpp"
#include "model/whole/archive.hpp"
#include "model/tables/model.hpp"

#include <map>
#include <string>
#include <string_view>

namespace kaya {

/// Values of a new model by name; those of a new record of a list are under the name of the list and `*`.
class InitialState final : public Archive {
public:
    InitialState();
    bool holds(const std::string& name, std::string_view bytes) const;

    void numbers(std::string_view name, const Numbers& value) override { put(name, value.bytes()); }
    void text(std::string_view name, std::string& text) override { put(name, text); }
    void number_list(std::string_view name, NumberList& list) override { put(name, list.numbers().bytes()); }
    void numbers_column(std::string_view, const Numbers&, const Numbers&) override {}
    void rows(TableRows& table) override { count("rows", table.size()); }
    void record_list(std::string_view name, RecordList& records) override;
    void group(std::string_view name, const Visit& visit) override;
    void outside(const Visit&) override {}

private:
    void put(std::string_view name, std::string_view bytes) { values_[path_ + std::string(name)] = bytes; }
    void count(std::string_view name, std::uint64_t number) { value(name, number); }

    std::map<std::string, std::string, std::less<>> values_;
    std::string path_;
};

/// An archive that only reads. The digest includes names and values.
class HashArchive final : public Archive {
public:
    void numbers(std::string_view name, const Numbers& value) override { add(name, value.bytes()); }
    void text(std::string_view name, std::string& text) override { add(name, text); }
    void number_list(std::string_view name, NumberList& list) override { add(name, list.numbers().bytes()); }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) override;
    void rows(TableRows& table) override { count("rows", table.size()); }
    void record_list(std::string_view name, RecordList& records) override;
    void group(std::string_view name, const Visit& visit) override { below(name, name, visit); }
    void outside(const Visit&) override {}

    std::uint64_t digest() const { return hash_.value(); }

private:
    void count(std::string_view name, std::uint64_t number) { value(name, number); }
    void add(std::string_view name, std::string_view bytes);
    void hash(std::string_view name, std::string_view bytes);
    void below(std::string_view name, std::string_view kind, const Visit& visit);

    const InitialState initial_;
    Hash hash_;
    std::string path_, kind_; ///< where the walk is, with the numbers of records and with `*` in their place
};

/// Digest of everything that affects the further run: columns, settings, clock, properties, histories. Equal state gives an equal digest,
/// independent of threads, paths and time.
std::uint64_t state_hash(Model& model);

} // namespace kaya
