// Rows of words in aligned columns.
#pragma once

#include "base/vector.hpp"

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

/// Six significant digits, as FISH writes numbers: 9.94099e-06, 322.077, 20. Zero has no sign.
std::string number_text(double value);

/// "(1, 2.5, 0)"
std::string vector_text(const Vec3& vector);
/// "1, 2.5, 4000000.25": to thousandths far from the origin, where six digits do not tell neighbours apart.
std::string coordinates_text(const Vec3& place);
/// The same in brackets.
std::string place_text(const Vec3& place);

} // namespace kaya
