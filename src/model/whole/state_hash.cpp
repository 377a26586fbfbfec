#include "model/whole/state_hash.hpp"

#include "model/whole/state.hpp"

namespace kaya {

InitialState::InitialState() {
    Model model;
    visit_state(*this, model);
}

bool InitialState::holds(const std::string& name, std::string_view bytes) const {
    const auto found = values_.find(name);
    return found != values_.end() && found->second == bytes;
}

void InitialState::record_list(std::string_view name, RecordList& records) {
    section(name, [&] {
        count("count", records.size());
        section("*", [&] { records.visit_initial(); });
    });
}

void InitialState::group(std::string_view name, const Visit& visit) {
    const std::size_t length = path_.size();
    path_.append(name).append("/");
    visit();
    path_.resize(length);
}

void HashArchive::numbers_column(std::string_view name, const Numbers& column, const Numbers& initial) {
    const std::string_view all = column.bytes(), one = initial.bytes();
    for (std::size_t at = 0; at < all.size(); at += one.size())
        if (all.substr(at, one.size()) != one) return hash(name, all);
}

void HashArchive::record_list(std::string_view name, RecordList& records) {
    section(name, [&] {
        count("count", records.size());
        for (std::size_t k = 0; k < records.size(); ++k) {
            const auto visit = [&] { records.visit(k); };
            below(std::to_string(k), "*", Visit(visit));
        }
    });
}

void HashArchive::add(std::string_view name, std::string_view bytes) {
    if (!initial_.holds(std::string(kind_).append(name), bytes)) hash(name, bytes);
}

void HashArchive::hash(std::string_view name, std::string_view bytes) {
    hash_.add(std::string(path_).append(name));
    hash_.add(bytes);
}

void HashArchive::below(std::string_view name, std::string_view kind, const Visit& visit) {
    const std::size_t path_length = path_.size(), kind_length = kind_.size();
    path_.append(name).append("/");
    kind_.append(kind).append("/");
    visit();
    path_.resize(path_length);
    kind_.resize(kind_length);
}

std::uint64_t state_hash(Model& model) {
    HashArchive archive;
    visit_state(archive, model);
    return archive.digest();
}

} // namespace kaya
