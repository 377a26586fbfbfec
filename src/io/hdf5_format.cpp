#include "io/hdf5_format.hpp"

#include "base/deflate.hpp"

#include <algorithm>
#include <set>

namespace kaya::hdf5 {

namespace {

using namespace std::string_view_literals;

[[noreturn]] void refuse(const std::string& why) { throw TreeError(why); }

void require(bool right, const char* why) {
    if (!right) refuse(why);
}

/// Numbers of the messages of object headers.
enum Kind : std::uint16_t {
    nil = 0,
    data_space = 1,
    link_info = 2,
    data_type = 3,
    old_fill_value = 4,
    fill_value = 5,
    link_message = 6,
    external_files = 7,
    data_layout = 8,
    filter_pipeline = 0xb,
    attribute = 0xc,
    old_time = 0xe,
    continuation = 0x10,
    symbol_table = 0x11,
    changed_time = 0x12
};

struct Message {
    std::uint16_t kind;
    std::string_view body;
};

void refuse_other_kinds(std::uint16_t kind) {
    switch (kind) {
    case link_info:
    case link_message: refuse("holds links that are not hard links, which saves do not have");
    case external_files: refuse("keeps its numbers in another file");
    case nil:
    case data_space:
    case data_type:
    case old_fill_value:
    case fill_value:
    case data_layout:
    case filter_pipeline:
    case attribute:
    case old_time:
    case continuation:
    case symbol_table:
    case changed_time: return;
    default: refuse("has a header message of kind " + std::to_string(kind) + ", which saves do not have");
    }
}

/// The header of an object, which may continue in another block.
std::vector<Message> messages_of(Image& image, Address header) {
    constexpr std::size_t prefix_size = 16;
    Bytes prefix(image.at(header, prefix_size));
    require(prefix.byte() == 1, "has an object header of another version");
    prefix.skip(1);
    std::size_t left = prefix.number<std::uint16_t>();
    prefix.skip(4); // how many links lead here
    std::vector<std::string_view> blocks{image.at(header + prefix_size, prefix.number<std::uint32_t>())};
    std::vector<Message> messages;
    constexpr std::size_t head_size = 8;
    constexpr int shared = 2;
    for (std::size_t k = 0; k < blocks.size(); ++k)
        for (Bytes block(blocks[k]); left > 0 && block.left() >= head_size; --left) {
            Message message{block.number<std::uint16_t>(), {}};
            const auto size = block.number<std::uint16_t>();
            const int flags = block.byte();
            block.skip(3);
            message.body = block.take(size);
            refuse_other_kinds(message.kind);
            require((flags & shared) == 0, "shares a part of its header with another object");
            messages.push_back(message);
            if (message.kind != continuation) continue;
            Bytes place(message.body);
            const auto first = place.number<Address>();
            blocks.push_back(image.at(first, place.number<std::uint64_t>()));
        }
    return messages;
}

/// Calls leaf(key, child) for all children of the leaves of a B-tree.
template <class Leaf> void walk_tree(Image& image, Address root, int kind, std::size_t key_size, const Leaf& leaf) {
    struct Node {
        Address at;
        int level; ///< -1: any
    };
    constexpr std::size_t head_size = 24;
    std::vector<Node> open{{root, -1}};
    std::set<Address> seen;
    while (!open.empty()) {
        const Node node = open.back();
        open.pop_back();
        require(seen.insert(node.at).second, "has an index that leads to one place twice");
        Bytes head(image.at(node.at, head_size));
        require(head.take(4) == "TREE" && head.byte() == kind, "has no index");
        const int level = head.byte();
        require(node.level < 0 || level == node.level, "has an index of uneven depth");
        const std::size_t entries = head.number<std::uint16_t>();
        Bytes body(image.at(node.at + head_size, entries * (key_size + sizeof(Address)) + key_size));
        for (std::size_t k = 0; k < entries; ++k) {
            Bytes key(body.take(key_size));
            const auto child = body.number<Address>();
            if (level == 0) leaf(key, child);
            else open.push_back({child, level - 1});
        }
    }
}

/// Types as the writer makes them, in version 1 of their description.
struct KnownType {
    Scalar number;
    std::size_t size;
    std::string_view description; ///< without the size, which follows the first four bytes
};
constexpr KnownType known_types[] = {{Scalar::uint8, 1, "\x10\0\0\0\0\0\x08\0"sv},
                                     {Scalar::int32, 4, "\x10\x08\0\0\0\0\x20\0"sv},
                                     {Scalar::uint32, 4, "\x10\0\0\0\0\0\x20\0"sv},
                                     {Scalar::int64, 8, "\x10\x08\0\0\0\0\x40\0"sv},
                                     {Scalar::uint64, 8, "\x10\0\0\0\0\0\x40\0"sv},
                                     {Scalar::float64, 8, "\x11\x20\x3f\0\0\0\x40\0\x34\x0b\0\x34\xff\x03\0\0"sv}};

ElementType type_of(Bytes message) {
    constexpr std::size_t kind_size = 4;
    constexpr char text_kind = 0x13;
    std::string description(message.take(kind_size));
    ElementType type;
    type.size = message.number<std::uint32_t>();
    require(type.size > 0, "is of a type without size");
    type.text = description[0] == text_kind;
    description += message.take(message.left());
    for (const KnownType& known : known_types)
        if (type.size == known.size && description.starts_with(known.description)) type.number = known.number;
    return type;
}

Extent extent_of(Bytes message) {
    require(message.byte() == 1, "has a size of another version");
    const int rank = message.byte();
    message.skip(6);
    require(rank <= 2, "has more than two dimensions");
    Extent extent;
    for (int k = 0; k < rank; ++k) extent.push_back(message.number<std::uint64_t>());
    return extent;
}

/// Version 1; version 3, which h5py writes, has another head and no gaps.
void read_attribute(Bytes message, Group& group) {
    const int version = message.byte();
    require(version == 1 || version == 3, "has an attribute of another version");
    require(message.byte() == 0, "has an attribute of a shared type");
    const std::uint64_t name_size = message.number<std::uint16_t>(), type_size = message.number<std::uint16_t>(),
                        extent_size = message.number<std::uint16_t>();
    if (version == 3) message.skip(1);
    const auto part = [&](std::uint64_t size) {
        const auto taken = message.take(size);
        if (version == 1) message.skip((8 - size % 8) % 8);
        return taken;
    };
    const auto padded_name = part(name_size);
    const auto name = padded_name.substr(0, padded_name.find('\0'));
    const ElementType type = type_of(Bytes(part(type_size)));
    const Extent extent = extent_of(Bytes(part(extent_size)));
    const std::uint64_t bytes = bytes_of(type, extent);
    const bool is_new =
        group.attributes.try_emplace(std::string(name), Attribute{type, bytes / type.size, message.take(bytes)}).second;
    require(is_new, "has two attributes of one name");
}

/// Names of links are stored in a heap, and links in small tables at the leaves of a tree.
void read_links(Image& image, Bytes message, Group& group) {
    const auto tree = message.number<Address>(), heap_at = message.number<Address>();
    constexpr std::size_t heap_size = 32, head_size = 8, entry_size = 40;
    Bytes heap(image.at(heap_at, heap_size));
    require(heap.take(4) == "HEAP" && heap.byte() == 0, "has no names");
    heap.skip(3);
    const auto names_size = heap.number<std::uint64_t>();
    heap.skip(8); // free space
    const auto names = image.at(heap.number<Address>(), names_size);
    walk_tree(image, tree, 0, sizeof(Address), [&](Bytes, Address table) {
        Bytes head(image.at(table, head_size));
        require(head.take(4) == "SNOD" && head.byte() == 1, "has no table of links");
        head.skip(1);
        const std::size_t count = head.number<std::uint16_t>();
        Bytes entries(image.at(table + head_size, count * entry_size));
        for (std::size_t k = 0; k < count; ++k) {
            const auto name_at = entries.number<std::uint64_t>();
            const auto target = entries.number<Address>();
            const auto cached = entries.number<std::uint32_t>();
            entries.skip(20);
            require(name_at < names.size(), "has a link without a name");
            const auto end = names.find('\0', name_at);
            require(end != names.npos && end > name_at, "has a link without a name");
            const std::string name(names.substr(name_at, end - name_at));
            constexpr std::uint32_t soft_link = 2;
            if (cached == soft_link) refuse("holds the soft link '" + name + "', and saves have hard links only");
            if (!group.links.emplace(name, target).second) refuse("holds '" + name + "' twice");
        }
    });
}

constexpr int deflate_filter = 1, shuffle_filter = 2;

void read_filters(Bytes message, Data& data) {
    require(message.byte() == 1, "has a list of filters of another version");
    const int count = message.byte();
    message.skip(6);
    for (int k = 0; k < count; ++k) {
        const int filter = message.number<std::uint16_t>();
        const std::uint64_t name_size = message.number<std::uint16_t>();
        message.skip(2);
        const std::uint64_t values = message.number<std::uint16_t>();
        message.skip(name_size + 4 * (values + values % 2));
        data.filters.push_back(filter);
    }
    const std::vector<std::vector<int>> known{{deflate_filter}, {shuffle_filter}, {shuffle_filter, deflate_filter}};
    require(std::find(known.begin(), known.end(), data.filters) != known.end(),
            "is packed by a filter other than shuffle and deflate");
}

/// A chunk is a number of whole rows; every chunk occurs exactly once.
void read_chunks(Image& image, Bytes layout, Data& data) {
    require(data.extent.size() == 2, "is cut into parts that are not rows");
    require(layout.byte() == 3, "is cut into parts of other dimensions than its own");
    const auto tree = layout.number<Address>();
    data.chunk_rows = layout.number<std::uint32_t>();
    const bool whole_rows = layout.number<std::uint32_t>() == data.extent[1];
    const std::uint64_t rows = data.extent[0];
    require(whole_rows && data.chunk_rows > 0 && data.chunk_rows <= rows, "is cut into parts that are not rows");
    constexpr std::size_t key_size = 32; // of the index, where each chunk has one
    const std::uint64_t count = (rows - 1) / data.chunk_rows + 1;
    require(count <= image.size() / key_size, "claims to be larger than its file can hold");
    data.chunks.resize(count);
    walk_tree(image, tree, 1, key_size, [&](Bytes key, Address at) {
        const std::uint64_t size = key.number<std::uint32_t>();
        const auto left_out = key.number<std::uint32_t>();
        const auto row = key.number<std::uint64_t>();
        const bool right = row < rows && row % data.chunk_rows == 0 && key.number<std::uint64_t>() == 0;
        require(right, "has rows at a place that it does not have");
        Chunk& chunk = data.chunks[row / data.chunk_rows];
        require(!chunk.found, "has rows twice");
        chunk = {image.at(at, size), left_out, true};
    });
    for (const Chunk& chunk : data.chunks) require(chunk.found, "has rows that are missing");
}

void read_layout(Image& image, Bytes layout, Data& data) {
    enum { compact, contiguous, chunked, virtual_layout };
    constexpr int known_version = 3;
    const int version = layout.byte(), kind = layout.byte();
    require(kind != virtual_layout, "is put together from other files (a virtual layout)");
    require(version == known_version && kind != compact, "is laid out in a way that saves do not have");
    if (kind == chunked) return read_chunks(image, layout, data);
    require(kind == contiguous, "is laid out in a way that saves do not have");
    const auto at = layout.number<Address>();
    const auto size = layout.number<std::uint64_t>();
    require(size == data.bytes, "does not have as many bytes as it claims");
    if (size > 0) data.stored = image.at(at, size);
}

/// The inverse of shuffle: the bytes are sorted as the first bytes of all numbers, then the second ones, and so on.
std::string unshuffled(std::string_view bytes, std::size_t size) {
    std::string numbers(bytes.size(), '\0');
    const std::size_t count = bytes.size() / size;
    for (std::size_t k = 0; k < size; ++k)
        for (std::size_t i = 0; i < count; ++i) numbers[i * size + k] = bytes[k * count + i];
    return numbers;
}

std::string unpacked(std::string_view packed, std::size_t size) {
    auto bytes = inflated(packed, size);
    require(bytes.has_value(), "cannot be unpacked");
    return std::move(*bytes);
}

} // namespace

std::uint64_t bytes_of(const ElementType& type, const Extent& extent) {
    std::uint64_t bytes = type.size;
    for (const std::uint64_t side : extent)
        require(!__builtin_mul_overflow(bytes, side, &bytes), "claims to be larger than its file can hold");
    return bytes;
}

Address root_group(Image& image) {
    constexpr std::size_t superblock_size = 96;
    if (image.size() < superblock_size) refuse("it is not an HDF5 file");
    Bytes block(image.at(0, superblock_size));
    if (block.take(8) != "\x89HDF\r\n\x1a\n"sv) refuse("it is not an HDF5 file");
    const bool known = block.take(8) == "\0\0\0\0\0\x08\x08\0"sv;
    block.skip(8); // how full the indexes are
    if (!known || block.number<Address>() != 0) refuse("it is a kind of HDF5 file that saves are not");
    block.skip(4 * sizeof(Address)); // free places, the end of the file, drivers, the name of the root
    return block.number<Address>();
}

Group read_group(Image& image, Address header) {
    Group group;
    bool has_links = false;
    for (const auto& [kind, body] : messages_of(image, header)) {
        if (kind == attribute) read_attribute(Bytes(body), group);
        if (kind != symbol_table) continue;
        require(!has_links, "has two tables of links");
        has_links = true;
        read_links(image, Bytes(body), group);
    }
    require(has_links, "is not a group");
    return group;
}

Data read_data(Image& image, Address header) {
    const auto messages = messages_of(image, header);
    const auto only = [&](Kind kind) {
        std::optional<std::string_view> found;
        for (const Message& message : messages) {
            if (message.kind != kind) continue;
            require(!found, "has a header that says one thing twice");
            found = message.body;
        }
        return found;
    };
    const auto type = only(data_type), extent = only(data_space), layout = only(data_layout),
               filters = only(filter_pipeline);
    require(type && extent && layout, "is not a data set");
    Data data;
    data.type = type_of(Bytes(*type));
    data.extent = extent_of(Bytes(*extent));
    data.bytes = bytes_of(data.type, data.extent);
    if (filters) read_filters(Bytes(*filters), data);
    read_layout(image, Bytes(*layout), data);
    return data;
}

void unpack(const Data& data, char* to) {
    if (data.chunk_rows == 0) {
        require(data.filters.empty(), "is packed without being cut into parts");
        if (!data.stored.empty()) std::memcpy(to, data.stored.data(), data.stored.size());
        return;
    }
    const std::uint64_t row_bytes = data.bytes / data.extent[0], chunk_bytes = data.chunk_rows * row_bytes;
    for (std::size_t c = 0; c < data.chunks.size(); ++c) {
        const Chunk& chunk = data.chunks[c];
        std::string bytes;
        std::string_view rows = chunk.stored;
        for (std::size_t k = data.filters.size(); k-- > 0;) {
            if ((chunk.filters_left_out >> k & 1) != 0) continue;
            bytes = data.filters[k] == deflate_filter ? unpacked(rows, chunk_bytes) : unshuffled(rows, data.type.size);
            rows = bytes;
        }
        require(rows.size() == chunk_bytes, "does not have as many bytes as it claims");
        const std::uint64_t first = c * chunk_bytes;
        std::memcpy(to + first, rows.data(), std::min(chunk_bytes, data.bytes - first));
    }
}

} // namespace kaya::hdf5
