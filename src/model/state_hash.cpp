#include "base/hash.hpp"
#include "model/state.hpp"

namespace kaya {

namespace {

/// An archive that only looks. Names go into the digest too: they keep apart what stands side by side.
class HashArchive {
public:
    template <class T> void value(std::string_view name, T& value) {
        hash_.add(name);
        hash_.add(scalars(value), sizeof(T));
    }
    void text(std::string_view name, std::string& text) {
        hash_.add(name);
        hash_.add(text);
    }
    template <class T> void column(std::string_view name, Column<T>& column) {
        hash_.add(name);
        hash_.add_number(column.size());
        hash_.add(scalars(column), column.size() * sizeof(T));
    }
    template <class T> void rows(T& table) { hash_.add_number(table.size()); }
    template <class S, class Visit> void records(std::string_view name, std::vector<S>& all, Visit&& visit) {
        hash_.add(name);
        hash_.add_number(all.size());
        for (auto& record : all) visit(record);
    }
    template <class Visit> void section(std::string_view name, Visit&& visit) {
        hash_.add(name);
        visit();
    }
    template <class Visit> void aside(Visit&&) {}
    template <class Visit> void since(std::int32_t, bool used, Visit&& visit) {
        if (used) visit();
    }

    std::uint64_t digest() const { return hash_.value(); }

private:
    Hash hash_;
};

} // namespace

std::uint64_t state_hash(Model& model) {
    HashArchive archive;
    visit_state(archive, model);
    return archive.digest();
}

} // namespace kaya
