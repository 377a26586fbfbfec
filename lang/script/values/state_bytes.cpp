// The script state as one block of bytes: little-endian, lengths before contents, a mark and a version first.
#include "lang/script/values/state.hpp"

#include "base/diagnostic.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace kaya::script {

namespace {

constexpr std::string_view mark = "KAYASCRIPT";
constexpr std::uint32_t version = 5, oldest_version = 3;
static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// Every part of the state passes through `io` in one order, for writing and for reading.
class Writer {
public:
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void number(const Number& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void text(const std::string& value) {
        number(static_cast<std::uint64_t>(value.size()));
        bytes += value;
    }
    template <class Item, class Function> void list(const std::vector<Item>& items, Function function) {
        number(static_cast<std::uint64_t>(items.size()));
        for (const auto& item : items) function(item);
    }
    std::string bytes;
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    template <class Number>
    requires std::is_arithmetic_v<Number>
    void number(Number& value) {
        const auto piece = take(sizeof value);
        std::memcpy(&value, piece.data(), sizeof value);
    }
    void text(std::string& value) {
        std::uint64_t size = 0;
        number(size);
        value = take(size);
    }
    template <class Item, class Function> void list(std::vector<Item>& items, Function function) {
        std::uint64_t size = 0;
        number(size);
        items.clear();
        // Grown one by one: a damaged length ends at the end of the bytes, not at the end of the memory.
        for (std::uint64_t i = 0; i < size; ++i) function(items.emplace_back());
    }
    std::string_view take(std::uint64_t size) {
        if (size > rest_.size())
            throw Diagnostic("the saved scripts end too early", "the file is cut off or damaged", Fault::run);
        const auto piece = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return piece;
    }
    bool done() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

void put(Writer& out, const StoredValue& value) {
    out.number(static_cast<std::uint8_t>(value.index()));
    switch (value.index()) {
    case 1: out.number(static_cast<std::uint8_t>(std::get<bool>(value))); break;
    case 2: out.number(std::get<std::int64_t>(value)); break;
    case 3: out.number(std::get<double>(value)); break;
    case 4: out.text(std::get<std::string>(value)); break;
    case 5:
        for (int i = 0; i < 3; ++i) out.number(std::get<Vec3>(value)[i]);
        break;
    case 6: {
        const Handle& handle = std::get<Handle>(value);
        out.number(handle.table);
        out.number(handle.slot);
        out.number(handle.generation);
        break;
    }
    case 7: out.number(static_cast<std::uint64_t>(std::get<ObjectReference>(value).index)); break;
    default: break;
    }
}

template <class Number> Number taken(Reader& in) {
    Number number{};
    in.number(number);
    return number;
}

void take(Reader& in, StoredValue& value) {
    switch (taken<std::uint8_t>(in)) {
    case 0: value = std::monostate{}; return;
    case 1: value = taken<std::uint8_t>(in) != 0; return;
    case 2: value = taken<std::int64_t>(in); return;
    case 3: value = taken<double>(in); return;
    case 4: in.text(value.emplace<std::string>()); return;
    case 5: {
        Vec3 vector;
        for (int i = 0; i < 3; ++i) in.number(vector[i]);
        value = vector;
        return;
    }
    case 6: {
        Handle handle;
        in.number(handle.table);
        in.number(handle.slot);
        in.number(handle.generation);
        value = handle;
        return;
    }
    case 7: value = ObjectReference{static_cast<std::size_t>(taken<std::uint64_t>(in))}; return;
    default: throw Diagnostic("the saved scripts hold a value of an unknown kind", "the file is damaged", Fault::run);
    }
}

/// Hooks had no location before version 5: the one of `set fishcall` for before_cycle and after_forces.
double usual_location(std::uint8_t moment) {
    constexpr std::array<double, 2> locations{1, 40};
    return moment < locations.size() ? locations[moment] : 0;
}

using Named = std::vector<std::pair<std::string, StoredValue>>;

} // namespace

std::string to_bytes(const ScriptState& state) {
    Writer out;
    out.bytes = mark;
    out.number(version);
    for (const Named* values : {&state.fish_globals, &state.lua_globals, &state.extras})
        out.list(*values, [&](const auto& item) {
            out.text(item.first);
            put(out, item.second);
        });
    const auto put_value = [&](const StoredValue& value) { put(out, value); };
    out.list(state.objects, [&](const StoredObject& object) {
        out.list(object.dimensions, [&](std::int64_t extent) { out.number(extent); });
        out.list(object.keys, put_value);
        out.list(object.values, put_value);
        out.number(static_cast<std::uint8_t>(object.kind));
        out.text(object.name);
    });
    out.list(state.sources, [&](const StoredSource& source) {
        out.number(static_cast<std::uint8_t>(source.kind));
        out.text(source.title);
        out.text(source.name);
        out.number(source.line);
        out.text(source.text);
    });
    out.list(state.hooks, [&](const StoredHook& hook) {
        out.text(hook.function);
        out.number(hook.moment);
        out.number(hook.interval);
        out.number(static_cast<std::uint8_t>(hook.whilestepping));
        out.number(hook.location);
    });
    out.number(static_cast<std::uint64_t>(state.tables.size()));
    for (const auto& [number, table] : state.tables) {
        out.number(number);
        out.text(table.name);
        out.list(table.points(), [&](const TablePoint& point) {
            out.number(point.x);
            out.number(point.y);
        });
    }
    for (const std::uint64_t word : state.random) out.number(word);
    out.number(static_cast<std::uint8_t>(state.automatic_create));
    return std::move(out.bytes);
}

ScriptState from_bytes(const std::string& bytes) {
    Reader in(bytes);
    if (in.take(std::min<std::uint64_t>(mark.size(), bytes.size())) != mark)
        throw Diagnostic("these are not saved scripts", "the file is damaged, or kaya did not write it", Fault::run);
    const auto found = taken<std::uint32_t>(in);
    if (found < oldest_version || found > version)
        throw Diagnostic(fmt::format("the scripts were saved in version {}; this program reads versions {} to {}",
                                     found, oldest_version, version),
                         {}, Fault::run);
    ScriptState state;
    for (Named* values : {&state.fish_globals, &state.lua_globals, &state.extras})
        in.list(*values, [&](auto& item) {
            in.text(item.first);
            take(in, item.second);
        });
    const auto take_value = [&](StoredValue& value) { take(in, value); };
    in.list(state.objects, [&](StoredObject& object) {
        in.list(object.dimensions, [&](std::int64_t& extent) { in.number(extent); });
        in.list(object.keys, take_value);
        in.list(object.values, take_value);
        object.kind = object.dimensions.empty() ? StoredObject::Kind::table : StoredObject::Kind::array;
        if (found == oldest_version) return;
        object.kind = static_cast<StoredObject::Kind>(taken<std::uint8_t>(in));
        in.text(object.name);
        if (object.kind > StoredObject::Kind::matrix)
            throw Diagnostic("the saved scripts hold a table of an unknown kind", "the file is damaged", Fault::run);
    });
    in.list(state.sources, [&](StoredSource& source) {
        source.kind = static_cast<StoredSource::Kind>(taken<std::uint8_t>(in));
        in.text(source.title);
        in.text(source.name);
        in.number(source.line);
        in.text(source.text);
    });
    in.list(state.hooks, [&](StoredHook& hook) {
        in.text(hook.function);
        in.number(hook.moment);
        in.number(hook.interval);
        hook.whilestepping = taken<std::uint8_t>(in) != 0;
        if (found > 4) in.number(hook.location);
        else hook.location = usual_location(hook.moment);
        constexpr std::uint8_t last = 4; // Moment::solve_complete
        if (hook.moment > last || hook.interval < 1)
            throw Diagnostic("the saved scripts hold a hook of an unknown kind", "the file is damaged", Fault::run);
    });
    for (auto count = taken<std::uint64_t>(in); count > 0; --count) {
        const auto number = taken<std::int64_t>(in);
        in.text(state.tables[number].name);
        std::vector<TablePoint> points;
        in.list(points, [&](TablePoint& point) {
            in.number(point.x);
            in.number(point.y);
        });
        state.tables[number].replace(std::move(points));
    }
    for (auto& word : state.random) in.number(word);
    if (found > oldest_version) state.automatic_create = taken<std::uint8_t>(in) != 0;
    if (!in.done()) throw Diagnostic("bytes are left over after the saved scripts", "the file is damaged", Fault::run);
    return state;
}

} // namespace kaya::script
