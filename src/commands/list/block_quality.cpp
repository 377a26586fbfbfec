// list blocks quality: blocks that will cause problems, and what to do about them.
#include "commands/list/listing.hpp"
#include "geometry/polyhedra/quality.hpp"
#include "model/edit/build.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace kaya {

namespace {

/// A defect of one block.
struct Finding {
    Row block;
    std::string ailment, numbers;
};

std::string numbers_of(const BlockQuality& q) {
    return fmt::format("volume {}, extent {}, thickness {}, shortest edge {}", number_text(q.volume),
                       number_text(q.extent), number_text(q.thickness), number_text(q.shortest_edge));
}

bool invalid(Ailment ailment) {
    return ailment == Ailment::open || ailment == Ailment::inverted || ailment == Ailment::concave ||
           ailment == Ailment::warped;
}

} // namespace

std::string list_block_quality(Session& session, const lang::List& command) {
    const auto& model = session.engine.model;
    const auto rows = select(model, ObjectKind::block, session.test_of(ObjectKind::block, command.range));
    if (rows.empty()) return "no blocks";
    std::vector<Polyhedron> shapes;
    std::vector<BlockQuality> qualities;
    double volume = 0;
    for (const Row row : rows) {
        shapes.push_back(shape_of(model, row));
        qualities.push_back(block_quality(shapes.back()));
        volume += qualities.back().volume;
    }
    const double mean = volume / static_cast<double>(rows.size());

    std::vector<Finding> findings;
    std::map<std::string, std::string> remedies;
    std::size_t bad = 0, poor = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        auto ailments = ailments_of(qualities[i], mean);
        // A block with zones bends as it is loaded: its faces need not be flat.
        if (model.blocks.deformable[rows[i]])
            std::erase_if(ailments, [](Ailment a) { return a == Ailment::warped || a == Ailment::concave; });
        if (ailments.empty()) continue;
        ++(std::any_of(ailments.begin(), ailments.end(), invalid) ? bad : poor);
        std::string names;
        for (const Ailment ailment : ailments) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(ailment));
            remedies.emplace(name_of(ailment), remedy_for(ailment));
        }
        findings.push_back({rows[i], names, numbers_of(qualities[i])});
    }
    const auto pairs = overlapping_blocks(shapes);
    for (const auto& [first, second, share] : pairs) {
        const bool same = share > 1 - 1e-6 && std::abs(qualities[first].volume - qualities[second].volume) <=
                                                  1e-6 * qualities[second].volume;
        const char* name = same ? "duplicate" : "overlapping";
        remedies.emplace(name, same ? "two blocks are one and the same: delete one of them"
                                    : "two blocks fill the same space: delete or move one, or cut off what is common");
        findings.push_back({rows[second], name,
                            fmt::format("{:.3g} % of the smaller one in common with block {}", 100 * share,
                                        model.blocks.number[rows[first]])});
    }

    std::string text = fmt::format("{} block{} of volume {}: {} invalid, {} poorly shaped, {} pair{} in one place",
                                   rows.size(), rows.size() == 1 ? "" : "s", number_text(volume), bad, poor,
                                   pairs.size(), pairs.size() == 1 ? "" : "s");
    if (findings.empty()) return text;
    TextTable table({"block", "what", "numbers"});
    for (const Finding& f : findings) {
        if (table.size() == longest_table) break;
        table.add({std::to_string(model.blocks.number[f.block]), f.ailment, f.numbers});
    }
    text += fmt::format("\n{}", table.text());
    if (findings.size() > longest_table)
        text += fmt::format("\n... and {} more; a range picks which are shown", findings.size() - longest_table);
    for (const auto& [name, remedy] : remedies) text += fmt::format("\n{}: {}", name, remedy);
    return text;
}

} // namespace kaya
