#include "io/hdf5_format.hpp"

namespace kaya {

namespace {

/// Limit of the unpacked data of a file: above the compression ratio of saves, and far below what deflate could expand to.
constexpr std::uint64_t always_allowed = std::uint64_t{64} << 20, most_per_byte = 512;

} // namespace

struct TreeReader::State {
    hdf5::Image image;
    std::vector<std::pair<std::string, hdf5::Group>> open; ///< groups and their names, the root first
    std::map<hdf5::Address, std::string> places{};         ///< of all objects visited
    std::uint64_t unpacked = 0;                            ///< bytes of all data among them

    const hdf5::Group& top() const { return open.back().second; }

    std::string path_of(const std::string& name) const {
        std::string path;
        for (std::size_t k = 1; k < open.size(); ++k) path += open[k].first + "/";
        return path + name;
    }

    [[noreturn]] void refuse(const std::string& name, const std::string& why) const {
        throw TreeError(path_of(name) + " " + why);
    }

    /// Runs `work`; an error in it gets the name of the object.
    template <class Work> auto named(const std::string& name, Work work) const {
        try {
            return work();
        } catch (const TreeError& error) { refuse(name, error.what()); }
    }

    /// The object of that name in the open group; `is_new`: it is visited for the first time.
    hdf5::Address find(const std::string& name, bool& is_new) {
        const auto link = top().links.find(name);
        if (link == top().links.end()) refuse(name, "is missing");
        const std::string path = path_of(name);
        const auto place = places.try_emplace(link->second, path);
        is_new = place.second;
        // Otherwise a small file could expand beyond any memory, and groups could contain themselves.
        if (!is_new && place.first->second != path) refuse(name, "is the same object as " + place.first->second);
        return link->second;
    }

    hdf5::Data data(const std::string& name) {
        bool is_new = false;
        const auto header = find(name, is_new);
        hdf5::Image repeated = image.again();
        auto data = named(name, [&] { return hdf5::read_data(is_new ? image : repeated, header); });
        if (is_new && data.bytes > always_allowed + most_per_byte * image.size() - unpacked)
            refuse(name, "makes the file larger unpacked than a save can be");
        if (is_new) unpacked += data.bytes;
        return data;
    }

    hdf5::Data table(const std::string& name, Scalar type, std::size_t per_row) {
        auto found = data(name);
        if (found.type.number != type) refuse(name, "is of another type");
        if (found.extent.size() != 2 || found.extent[1] != per_row) refuse(name, "is of another size");
        return found;
    }
};

TreeReader::TreeReader(std::string_view image) : state_(std::make_unique<State>(State{hdf5::Image(image), {}})) {
    const auto root = hdf5::root_group(state_->image);
    state_->places.emplace(root, "the file itself");
    state_->open.emplace_back("", state_->named("its root", [&] { return hdf5::read_group(state_->image, root); }));
}

TreeReader::~TreeReader() = default;

void TreeReader::open_group(const std::string& name) {
    bool is_new = false;
    const auto header = state_->find(name, is_new);
    hdf5::Image repeated = state_->image.again();
    auto group = state_->named(name, [&] { return hdf5::read_group(is_new ? state_->image : repeated, header); });
    state_->open.emplace_back(name, std::move(group));
}

void TreeReader::close_group() { state_->open.pop_back(); }

std::set<std::string> TreeReader::names() const {
    std::set<std::string> names;
    for (const auto& [name, address] : state_->top().links) names.insert(name);
    for (const auto& [name, attribute] : state_->top().attributes) names.insert(name);
    return names;
}

void TreeReader::attribute(const std::string& name, Scalar type, void* numbers, std::size_t count) {
    const auto& attributes = state_->top().attributes;
    const auto found = attributes.find(name);
    if (found == attributes.end()) state_->refuse(name, "is missing");
    const auto& [of, has, data] = found->second;
    if (of.number != type || has != count) state_->refuse(name, "is of another type or size");
    std::memcpy(numbers, data.data(), data.size());
}

std::size_t TreeReader::rows(const std::string& name, Scalar type, std::size_t per_row) {
    return static_cast<std::size_t>(state_->table(name, type, per_row).extent[0]);
}

void TreeReader::data(const std::string& name, Scalar type, void* numbers, std::size_t rows, std::size_t per_row) {
    const auto data = state_->table(name, type, per_row);
    if (data.extent[0] != rows) state_->refuse(name, "is of another size");
    state_->named(name, [&] { hdf5::unpack(data, static_cast<char*>(numbers)); });
}

std::string TreeReader::text(const std::string& name) {
    const auto data = state_->data(name);
    if (!data.type.text || data.bytes != data.type.size) state_->refuse(name, "is not a text");
    std::string text(data.bytes, '\0');
    state_->named(name, [&] { hdf5::unpack(data, text.data()); });
    text.resize(std::strlen(text.c_str()));
    return text;
}

} // namespace kaya
