// Walks over the state of programs with one name less or one column more: a program before a column was added, and one after it. Names are
// those of the walk, with `*` for the number of a record.
#pragma once

#include "model/whole/state.hpp"

#include <set>
#include <string>
#include <vector>

namespace kaya::test {

/// All names in the walk over a model.
class NameList final : public Archive {
public:
    std::vector<std::string> all, columns;
    std::set<std::string> holding; ///< columns in which a row does not have the initial value

    void numbers(std::string_view name, const Numbers&) override { add(name); }
    void text(std::string_view name, std::string&) override { add(name); }
    void number_list(std::string_view name, NumberList&) override { add(name); }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) override {
        add(name);
        columns.push_back(path_ + std::string(name));
        const std::string_view bytes = column.bytes(), one = initial.bytes();
        for (std::size_t at = 0; at < bytes.size(); at += one.size())
            if (bytes.substr(at, one.size()) != one) holding.insert(columns.back());
    }
    void rows(TableRows&) override {}
    void record_list(std::string_view name, RecordList& records) override {
        section(name, [&] {
            below("*/", [&] {
                for (std::size_t k = 0; k < records.size(); ++k) records.visit(k);
            });
        });
    }
    void group(std::string_view name, const Visit& visit) override {
        add(name);
        below(std::string(name) + "/", visit);
    }
    void outside(const Visit& visit) override { visit(); }

private:
    void add(std::string_view name) {
        const std::string whole = path_ + std::string(name);
        if (std::ranges::find(all, whole) == all.end()) all.push_back(whole);
    }
    template <class Function> void below(const std::string& name, const Function& visit) {
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
class OtherWalk final : public Archive {
public:
    explicit OtherWalk(Archive& archive) : archive_(archive) {}

    std::string without; ///< a name unknown to the other program
    std::string with;    ///< "table/column": the other program has this column
    Column<double> more; ///< and these are its numbers

    void numbers(std::string_view name, const Numbers& value) override {
        if (knows(name)) archive_.numbers(name, value);
    }
    void text(std::string_view name, std::string& text) override {
        if (knows(name)) archive_.text(name, text);
    }
    void number_list(std::string_view name, NumberList& list) override {
        if (knows(name)) archive_.number_list(name, list);
    }
    void numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) override {
        if (knows(name)) archive_.numbers_column(name, column, initial);
    }
    void rows(TableRows& table) override {
        archive_.rows(table);
        if (with.starts_with(path_)) archive_.column(with.substr(path_.size()), more, 0.0);
    }
    void record_list(std::string_view name, RecordList& records) override {
        if (!knows(name)) return;
        Inside inside(*this, records, std::string(name) + "/*/");
        archive_.record_list(name, inside);
    }
    void group(std::string_view name, const Visit& visit) override {
        if (knows(name)) archive_.section(name, [&] { below(std::string(name) + "/", visit); });
    }
    void outside(const Visit& visit) override { archive_.outside(visit); }

private:
    /// The records of a list, whose names are inside the list.
    class Inside final : public RecordList {
    public:
        Inside(OtherWalk& walk, RecordList& records, std::string path)
            : walk_(walk), records_(records), path_(std::move(path)) {}
        std::size_t size() const override { return records_.size(); }
        void clear() override { records_.clear(); }
        void visit(std::size_t record) override {
            walk_.below(path_, [&] { records_.visit(record); });
        }
        void visit_new() override {
            walk_.below(path_, [&] { records_.visit_new(); });
        }
        void visit_initial() override {
            walk_.below(path_, [&] { records_.visit_initial(); });
        }

    private:
        OtherWalk& walk_;
        RecordList& records_;
        std::string path_;
    };

    bool knows(std::string_view name) const { return path_ + std::string(name) != without; }
    template <class Function> void below(const std::string& name, const Function& visit) {
        const std::size_t length = path_.size();
        path_ += name;
        visit();
        path_.resize(length);
    }

    Archive& archive_;
    std::string path_;
};

} // namespace kaya::test
