// Rows of words in aligned columns.
#pragma once

#include "base/number_text.hpp"

#include <string>
#include <vector>

namespace kaya {

/// A table to be shown: words of the first row are headings.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> headings) : rows_{std::move(headings)} {}

    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    std::size_t size() const { return rows_.size() - 1; }

    /// Numbers are aligned to the right, words to the left; two blanks between columns.
    std::string text() const;

private:
    std::vector<std::vector<std::string>> rows_;
};

} // namespace kaya
