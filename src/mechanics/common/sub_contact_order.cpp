#include "mechanics/common/sub_contact_order.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace kaya {

void order_sub_contacts(Model& model) {
    constexpr std::size_t near = 384; // contacts; their rows stay in the processor's second-level cache
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    std::vector<Row> order(contacts.size());
    std::iota(order.begin(), order.end(), Row{0});
    for (std::size_t first = 0; first < order.size(); first += near) {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(first + near, order.size()));
        std::stable_sort(begin, end, [&](Row a, Row b) { return contacts.properties[a] < contacts.properties[b]; });
    }
    std::vector<Row> source;
    source.reserve(subs.size());
    bool ordered = true;
    for (const Row c : order) {
        const Span span = contacts.sub_contacts[c];
        ordered = ordered && span.first == static_cast<Row>(source.size());
        for (Row s = span.first; s < span.end(); ++s) source.push_back(s);
    }
    if (ordered) return;
    subs.gather(source);
    Row first = 0;
    for (const Row c : order) {
        contacts.sub_contacts[c].first = first;
        first += contacts.sub_contacts[c].count;
    }
    for (std::size_t s = 0; s < subs.size(); ++s) subs.ids.move(subs.id[s], static_cast<Row>(s));
}

} // namespace kaya
