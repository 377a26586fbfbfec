/* SPDX-License-Identifier: MIT */
/* Numbers, texts and properties as the bytes of a save file, and back. */
#ifndef KAYA_COMPAT_BYTES_H
#define KAYA_COMPAT_BYTES_H

#include "kaya/compat/property.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace kaya_compat {

class Writer {
public:
    Writer(void (*write)(void*, const void*, size_t), void* sink) : write_(write), sink_(sink) {}
    template <class T> void plain(const T& value) { write_(sink_, &value, sizeof value); }
    void text(const std::string& text) {
        plain<std::uint64_t>(text.size());
        write_(sink_, text.data(), text.size());
    }

private:
    void (*write_)(void*, const void*, size_t);
    void* sink_;
};

class Reader {
public:
    Reader(const void* bytes, std::size_t count) : at_(static_cast<const char*>(bytes)), left_(count) {}
    template <class T> T plain() {
        T value;
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }
    std::string text() {
        const auto size = plain<std::uint64_t>();
        if (size > left_) throw std::runtime_error("what was saved ends too early");
        return std::string(take(static_cast<std::size_t>(size)), static_cast<std::size_t>(size));
    }

private:
    const char* take(std::size_t count) {
        if (count > left_) throw std::runtime_error("what was saved ends too early");
        const char* here = at_;
        at_ += count;
        left_ -= count;
        return here;
    }
    const char* at_;
    std::size_t left_;
};

inline void write_property(Writer& writer, const base::Property& value) {
    writer.plain(static_cast<std::int32_t>(value.kind()));
    switch (value.kind()) {
    case base::Property::Kind::text: writer.text(value.toString()); break;
    case base::Property::Kind::vector:
        for (const double x : {value.toVector().x(), value.toVector().y(), value.toVector().z()}) writer.plain(x);
        break;
    default: writer.plain(value.toDouble());
    }
}

inline base::Property read_property(Reader& reader) {
    switch (static_cast<base::Property::Kind>(reader.plain<std::int32_t>())) {
    case base::Property::Kind::text: return base::Property(reader.text());
    case base::Property::Kind::truth: return base::Property(reader.plain<double>() != 0);
    case base::Property::Kind::whole: return base::Property(static_cast<long long>(reader.plain<double>()));
    case base::Property::Kind::vector: {
        const double x = reader.plain<double>(), y = reader.plain<double>(), z = reader.plain<double>();
        return base::Property(DVect3(x, y, z));
    }
    default: return base::Property(reader.plain<double>());
    }
}

} // namespace kaya_compat

#endif
