// Meshes of COMPAS in JSON: every object with the members "vertex" and "face" (or "vertices" and "faces") is a body, wherever it stands.
#include "base/diagnostic.hpp"
#include "base/json_text.hpp"
#include "base/stop_point.hpp"
#include "geometry/read/surface_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace kaya {
namespace {

/// A value of JSON. Objects keep their members in the order of the file.
struct JsonValue {
    enum class Kind { other, number, text, list, object } kind = Kind::other;
    int line = 0;
    double number = 0;
    std::string text;
    std::vector<JsonValue> items;   ///< of a list, and the values of an object
    std::vector<std::string> names; ///< of an object

    const JsonValue* find(std::string_view name) const {
        const auto found = std::ranges::find(names, name);
        return found == names.end() ? nullptr : &items[static_cast<std::size_t>(found - names.begin())];
    }
};

class JsonParser {
public:
    JsonParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    JsonValue read() {
        JsonValue value = read_value(0);
        skip_blanks();
        if (at_ < text_.size()) fail("text follows the end of the data");
        return value;
    }

    [[noreturn]] void fail(const std::string& message) const { fail(line_, message); }
    [[noreturn]] void fail(int line, const std::string& message) const {
        throw Diagnostic(fmt::format("{}, line {}: {}", file_, line, message), "export the blocks as JSON again");
    }

private:
    void skip_blanks() {
        stops_.pass();
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n') ++line_;
            else if (c != ' ' && c != '\t' && c != '\r') return;
        }
    }

    bool take(char c) {
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    void expect(char c) {
        if (take(c)) return;
        if (at_ >= text_.size()) fail(fmt::format("the file ends before '{}'", c));
        fail(fmt::format("expected '{}'", c));
    }

    JsonValue read_value(int depth) {
        constexpr int deepest = 200;
        if (depth > deepest) fail("the data are nested too deeply");
        skip_blanks();
        JsonValue value;
        value.line = line_;
        if (at_ >= text_.size()) fail("the file ends before a value");
        if (take('{')) {
            value.kind = JsonValue::Kind::object;
            for (bool more = !take('}'); more; more = separated('}')) {
                skip_blanks();
                value.names.push_back(read_text());
                expect(':');
                value.items.push_back(read_value(depth + 1));
            }
        } else if (take('[')) {
            value.kind = JsonValue::Kind::list;
            for (bool more = !take(']'); more; more = separated(']')) value.items.push_back(read_value(depth + 1));
        } else if (text_[at_] == '"') {
            value.kind = JsonValue::Kind::text;
            value.text = read_text();
        } else {
            read_word(value);
        }
        return value;
    }

    /// After an item: whether another one follows.
    bool separated(char end) {
        if (take(end)) return false;
        expect(',');
        return true;
    }

    std::string read_text() {
        expect('"');
        JsonText read = json_decoded(text_.substr(at_));
        if (!read.wrong.empty()) fail(read.wrong);
        at_ += read.length;
        expect('"');
        return std::move(read.text);
    }

    /// A number, true, false or null.
    void read_word(JsonValue& value) {
        const std::size_t end = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
        const std::string_view word = text_.substr(at_, end - at_);
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value.number);
        if (error == std::errc{} && stop == word.data() + word.size() && std::isfinite(value.number))
            value.kind = JsonValue::Kind::number;
        else if (word != "true" && word != "false" && word != "null")
            fail(fmt::format("'{}' is not a value", word.substr(0, 30)));
        at_ = end;
    }

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    int line_ = 1;
    StopPoints stops_;
};

class JsonMeshes {
public:
    explicit JsonMeshes(const JsonParser& parser) : parser_(parser) {}

    /// Finds meshes in a value; `name` is that of the nearest object around it that has one.
    void find(const JsonValue& value, std::string name) {
        if (const JsonValue* own = value.find("name"); own != nullptr && own->kind == JsonValue::Kind::text)
            name = own->text;
        const JsonValue* vertices = either(value, "vertex", "vertices");
        const JsonValue* faces = either(value, "face", "faces");
        if (vertices != nullptr && faces != nullptr && holds_meshes(*vertices) && holds_meshes(*faces)) {
            add(*vertices, *faces, name);
            return;
        }
        for (const JsonValue& item : value.items) find(item, name);
    }

    std::vector<FaceSoup> soups;

private:
    static const JsonValue* either(const JsonValue& value, std::string_view one, std::string_view other) {
        const JsonValue* found = value.find(one);
        return found != nullptr ? found : value.find(other);
    }
    static bool holds_meshes(const JsonValue& value) {
        return value.kind == JsonValue::Kind::list || value.kind == JsonValue::Kind::object;
    }

    void add(const JsonValue& vertices, const JsonValue& faces, const std::string& name) {
        std::map<std::string, Vec3, std::less<>> places;
        for (std::size_t i = 0; i < vertices.items.size(); ++i)
            places[vertices.names.empty() ? std::to_string(i) : vertices.names[i]] = place(vertices.items[i]);
        FaceSoup soup{name, {}};
        for (const JsonValue& face : faces.items) {
            std::vector<Vec3> loop;
            for (const JsonValue& corner : face.items) {
                const std::string key =
                    corner.kind == JsonValue::Kind::text ? corner.text : fmt::format("{:g}", corner.number);
                const auto found = places.find(key);
                if (found == places.end())
                    parser_.fail(corner.line, fmt::format("a face has vertex {}, which is not there", key));
                loop.push_back(found->second);
            }
            soup.loops.push_back(std::move(loop));
        }
        soups.push_back(std::move(soup));
    }

    /// {"x": 1, "y": 2, "z": 3} or [1, 2, 3].
    Vec3 place(const JsonValue& value) const {
        Vec3 result;
        static constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
        for (std::size_t k = 0; k < 3; ++k) {
            const JsonValue* number = nullptr;
            if (value.kind == JsonValue::Kind::object) number = value.find(axes[k]);
            else if (k < value.items.size()) number = &value.items[k];
            if (number == nullptr || number->kind != JsonValue::Kind::number)
                parser_.fail(value.line, fmt::format("a vertex has no {}", axes[k]));
            result[static_cast<Eigen::Index>(k)] = number->number;
        }
        return result;
    }

    const JsonParser& parser_;
};

} // namespace

std::vector<FaceSoup> read_compas(std::string_view text, const std::string& file) {
    JsonParser parser(text, file);
    const JsonValue all = parser.read();
    JsonMeshes bodies(parser);
    bodies.find(all, "");
    if (bodies.soups.empty())
        throw Diagnostic(fmt::format("{} holds no meshes", file),
                         "a mesh is an object with the members \"vertex\" and \"face\"");
    return std::move(bodies.soups);
}

} // namespace kaya
