// The archive that writes a save file.
#pragma once

#include "io/hdf5_tree.hpp"
#include "model/whole/archive.hpp"

namespace kaya {

/// Leads the walk of model/whole/state.hpp into a tree.
class SaveArchive final : public Archive {
public:
    explicit SaveArchive(TreeWriter& tree) : tree_(tree) {}

    void numbers(std::string_view name, const Numbers& value) override;
    void text(std::string_view name, std::string& text) override;
    void number_list(std::string_view name, NumberList& list) override;
    void numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) override;
    void rows(TableRows& table) override;
    void record_list(std::string_view name, RecordList& records) override;
    void group(std::string_view name, const Visit& visit) override;
    void outside(const Visit& visit) override { visit(); }

private:
    void data(std::string_view name, const Numbers& numbers);

    TreeWriter& tree_;
};

} // namespace kaya
