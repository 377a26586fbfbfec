// Detects writes of a law outside of its columns: for one call it works on copies of its columns, each between fences.
#pragma once

#include "kaya/zmodel.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace kaya {

/// A sum that no likely change leaves as it is.
inline std::uint64_t sum_of_bits(const double* column, std::size_t n) {
    // Two sums, one of them by places, so that it is a vector loop.
    std::uint64_t sum = 0, placed = 0, place = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(column[i]);
        sum += bits;
        placed ^= bits + place;
        place += 0x9e37'79b9'7f4a'7c15u;
    }
    return sum ^ placed << 1;
}

/// A forbidden write of a law, and its row.
struct Trespass {
    std::string what; ///< "wrote to 'area', which it may only read"
    std::size_t row;
};

/// Copies of columns, with fences before, between and after them. Reused to save allocations.
class FencedColumns {
public:
    void clear() { columns_.clear(); }

    /// A column of so many rows; one of constants may only be read. The pointer stays where it is until give().
    template <class T> void add(const char* name, T*& column, std::size_t rows) {
        columns_.push_back({name, &column, column, nullptr, rows, sizeof(T), std::is_const_v<T>});
    }

    /// Points all columns at their copies.
    void take();
    /// The first forbidden write of the law.
    std::optional<Trespass> trespass() const;
    /// Copies the results to the original columns, and points at those again.
    void give();

private:
    struct Column {
        const char* name;
        void* pointer; ///< to the pointer of the batch
        const void* own;
        std::byte* copy;
        std::size_t rows, size;
        bool is_read_only;
        std::size_t bytes() const { return rows * size; }
    };
    std::optional<Trespass> breach(const std::byte* from, const std::byte* to, const Column* before,
                                   const Column* after) const;

    std::vector<Column> columns_;
    std::vector<std::byte> room_;
    std::byte* end_ = nullptr; ///< of the last fence
};

/// Adds the columns that all models have.
void add_columns(FencedColumns& fences, kaya_jbatch& batch);
void add_columns(FencedColumns& fences, kaya_zbatch& batch);

/// All columns of a batch of either kind.
template <class Batch> class FencedBatch {
public:
    /// Points the batch at copies of its columns. `Law` is a LawTable.
    template <class Law> void take(const Law& law, Batch& batch) {
        fences_.clear();
        fences_.add("properties", batch.properties, law.properties.size());
        add_columns(fences_, batch);
        own_history_ = batch.history;
        for (std::size_t k = 0; k < law.history.size(); ++k) {
            history_[k] = batch.history[k];
            fences_.add(law.history[k].name.c_str(), history_[k], batch.n);
        }
        batch.history = history_.data();
        if constexpr (requires { law.fields; }) {
            own_fields_ = batch.field;
            for (std::size_t k = 0; k < law.fields.size(); ++k) {
                fields_[k] = batch.field[k];
                fences_.add(law.fields[k].name.c_str(), fields_[k], batch.n);
            }
            if (batch.field != nullptr) batch.field = fields_.data();
        }
        fences_.take();
    }

    std::optional<Trespass> trespass() const { return fences_.trespass(); }

    /// Gives the batch its columns back, with what the law wrote.
    void give(Batch& batch) {
        fences_.give();
        batch.history = own_history_;
        if constexpr (requires { batch.field; }) batch.field = own_fields_;
    }

private:
    FencedColumns fences_;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history_{};
    std::array<const double*, KAYA_JMODEL_MAX_FIELDS> fields_{};
    double* const* own_history_ = nullptr;
    const double* const* own_fields_ = nullptr;
};

/// Whether a law has changed its batch itself: where its columns are, how many rows they have.
bool is_other_batch(const kaya_jbatch& before, const kaya_jbatch& after);
bool is_other_batch(const kaya_zbatch& before, const kaya_zbatch& after);

} // namespace kaya
