// The part of the HDF5 file format in which saves are written, read from bytes that may be hostile: version 0 of the superblock,
// symbol tables, version 1 of object headers, contiguous or chunked data, shuffle and deflate. Everything else is refused, so
// that no file leads to another one: https://docs.hdfgroup.org/hdf5/v1_14/_f_m_t3.html
#pragma once

#include "io/hdf5_tree.hpp"

#include <cstring>
#include <map>
#include <optional>
#include <vector>

namespace kaya::hdf5 {

using Address = std::uint64_t;

/// Numbers read consecutively from bytes; TreeError beyond the last.
class Bytes {
public:
    explicit Bytes(std::string_view bytes) : left_(bytes) {}

    std::size_t left() const { return left_.size(); }
    std::string_view take(std::uint64_t count) {
        if (count > left_.size()) throw TreeError("ends before its last number");
        const std::string_view taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }
    void skip(std::uint64_t count) { take(count); }
    /// Numbers are little-endian.
    template <class T> T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    int byte() { return number<std::uint8_t>(); }

private:
    std::string_view left_;
};

/// A whole file. No two parts of it share bytes, so the data read from it are never larger than the file: a small file cannot expand to a
/// large one.
class Image {
public:
    explicit Image(std::string_view bytes) : bytes_(bytes), unread_(bytes.size()) {}
    std::size_t size() const { return bytes_.size(); }
    std::string_view at(Address first, std::uint64_t count) {
        if (first > bytes_.size() || count > bytes_.size() - first)
            throw TreeError("points beyond the end of the file");
        if (count > unread_) throw TreeError("has bytes that belong to another object");
        unread_ -= count;
        return bytes_.substr(first, count);
    }
    /// The same file, unread.
    Image again() const { return Image(bytes_); }

private:
    std::string_view bytes_;
    std::uint64_t unread_;
};

/// Types that saves have; a type that is neither a number nor a text has no use here.
struct ElementType {
    std::optional<Scalar> number;
    bool text = false;
    std::size_t size = 0; ///< bytes
};

/// Sides of a table; none: a single value.
using Extent = std::vector<std::uint64_t>;

struct Attribute {
    ElementType type;
    std::uint64_t count;
    std::string_view data;
};

struct Group {
    std::map<std::string, Address, std::less<>> links;
    std::map<std::string, Attribute, std::less<>> attributes;
};

/// Where part of the rows of a table is stored.
struct Chunk {
    std::string_view stored;
    std::uint32_t filters_left_out = 0; ///< bit k: the filter k
    bool found = false;
};

struct Data {
    ElementType type;
    Extent extent;
    std::uint64_t bytes = 0;      ///< of all numbers, unpacked
    std::string_view stored;      ///< of contiguous data
    std::uint64_t chunk_rows = 0; ///< 0: contiguous
    std::vector<Chunk> chunks;
    std::vector<int> filters;
};

/// Bytes of all numbers of that type. TreeError when 64 bits do not hold it.
std::uint64_t bytes_of(const ElementType& type, const Extent& extent);

/// All of these throw TreeError with a sentence that follows the name of the object.
Address root_group(Image& image);
Group read_group(Image& image, Address header);
Data read_data(Image& image, Address header);
/// Writes data.bytes bytes.
void unpack(const Data& data, char* to);

} // namespace kaya::hdf5
