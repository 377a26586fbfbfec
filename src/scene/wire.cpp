#include "scene/wire.hpp"

#include <cstring>
#include <type_traits>

namespace kaya {

namespace {

template <class T> constexpr bool is_vector = false;
template <class T> constexpr bool is_vector<std::vector<T>> = true;
template <class T> constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T, std::size_t n> constexpr bool is_plain<std::array<T, n>> = true;

struct Writer {
    std::string bytes;
    void raw(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
    template <class T> void operator()(T& value) {
        if constexpr (is_plain<T>) raw(&value, sizeof value);
        else if constexpr (std::is_same_v<T, std::string> || is_vector<T>) {
            const std::uint64_t count = value.size();
            raw(&count, sizeof count);
            if constexpr (std::is_same_v<T, std::string>) raw(value.data(), count);
            else if constexpr (is_plain<typename T::value_type>)
                raw(value.data(), count * sizeof(typename T::value_type));
            else
                for (auto& part : value) (*this)(part);
        } else value.parts(*this);
    }
};

struct Reader {
    const std::string& bytes;
    std::size_t at = 0;
    bool whole = true; ///< no count has led beyond the end so far
    void raw(void* data, std::size_t size) {
        whole = whole && size <= bytes.size() - at;
        if (!whole || size == 0) return;
        std::memcpy(data, bytes.data() + at, size);
        at += size;
    }
    template <class T> void operator()(T& value) {
        if constexpr (std::is_same_v<T, bool>) {
            std::uint8_t byte = 0;
            raw(&byte, 1);
            value = byte != 0;
        } else if constexpr (is_plain<T>) raw(&value, sizeof value);
        else if constexpr (std::is_same_v<T, std::string> || is_vector<T>) {
            std::uint64_t count = 0;
            raw(&count, sizeof count);
            using Part = typename T::value_type;
            const std::size_t least = is_plain<Part> ? sizeof(Part) : 1;
            whole = whole && count <= (bytes.size() - at) / least;
            if (!whole) return;
            value.resize(count);
            if constexpr (is_plain<Part>) raw(value.data(), count * sizeof(Part));
            else
                for (auto& part : value) (*this)(part);
        } else value.parts(*this);
    }
};

} // namespace

std::string to_bytes(Drawing drawing) {
    Writer writer;
    std::uint8_t kind = static_cast<std::uint8_t>(drawing.index());
    writer(kind);
    std::visit([&](auto& what) { writer(what); }, drawing);
    return std::move(writer.bytes);
}

std::optional<Drawing> drawing_from(const std::string& bytes) {
    Reader reader{bytes};
    std::uint8_t kind = std::variant_size_v<Drawing>;
    reader(kind);
    if (!reader.whole || kind >= std::variant_size_v<Drawing>) return std::nullopt;
    Drawing drawing;
    if (kind == 1) drawing = Chart{};
    if (kind == 2) drawing = ScenePair{};
    std::visit([&](auto& what) { reader(what); }, drawing);
    if (!reader.whole || reader.at != bytes.size()) return std::nullopt;
    return drawing;
}

} // namespace kaya
