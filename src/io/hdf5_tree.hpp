// A tree of named values as an HDF5 file in memory. The HDF5 library writes it, and never accesses the disk: base/whole_file.hpp writes and
// checks the file, so that a full disk is reported by kaya and not by HDF5. kaya also reads the file itself (io/hdf5_format.hpp): the
// library follows links to other files, and trusts what it reads.
#pragma once

#include "base/scalar.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kaya {

/// The file does not hold the expected item. The text names the place in the tree.
class TreeError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class TreeWriter {
public:
    TreeWriter();
    ~TreeWriter();

    void open_group(const std::string& name);
    void close_group();

    /// A few numbers stored with the open group.
    template <class T> void attribute(const std::string& name, const T* numbers, std::size_t count) {
        attribute(name, scalar_of<T>(), numbers, count);
    }
    /// A table of rows x per_row numbers; light compression where it pays.
    template <class T> void data(const std::string& name, const T* numbers, std::size_t rows, std::size_t per_row) {
        data(name, scalar_of<T>(), numbers, rows, per_row);
    }
    void attribute(const std::string& name, Scalar type, const void* numbers, std::size_t count);
    void data(const std::string& name, Scalar type, const void* numbers, std::size_t rows, std::size_t per_row);
    void text(const std::string& name, const std::string& text);

    /// The bytes of the file.
    std::string image();

private:
    struct Files;
    std::unique_ptr<Files> files_;
};

class TreeReader {
public:
    /// Throws TreeError when the bytes are not an HDF5 file. All functions below throw it for a value that is missing, has another type or
    /// size, or is of a form that TreeWriter does not write. The bytes must outlive the reader.
    explicit TreeReader(std::string_view image);
    ~TreeReader();

    void open_group(const std::string& name);
    void close_group();
    /// Of all that the open group holds.
    std::set<std::string> names() const;

    template <class T> void attribute(const std::string& name, T* numbers, std::size_t count) {
        attribute(name, scalar_of<T>(), numbers, count);
    }
    /// Rows of that table. It has been made sure that the file is large enough to hold so many.
    template <class T> std::size_t rows(const std::string& name, std::size_t per_row) {
        return rows(name, scalar_of<T>(), per_row);
    }
    /// All rows; `numbers` has room for rows() * per_row.
    template <class T> void data(const std::string& name, T* numbers, std::size_t rows, std::size_t per_row) {
        data(name, scalar_of<T>(), numbers, rows, per_row);
    }
    // A truth is stored as a uint8.
    void attribute(const std::string& name, Scalar type, void* numbers, std::size_t count);
    std::size_t rows(const std::string& name, Scalar type, std::size_t per_row);
    void data(const std::string& name, Scalar type, void* numbers, std::size_t rows, std::size_t per_row);
    std::string text(const std::string& name);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace kaya
