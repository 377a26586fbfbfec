// list frequencies: modes of rigid blocks on their joints.
#include "commands/list/listing.hpp"

#include "commands/list/eigen_modes.hpp"
#include "commands/session/long_work.hpp"
#include "commands/program/text_table.hpp"

#include <cmath>
#include <functional>

namespace kaya {

std::string list_frequencies(Session& session, const lang::List& command) {
    constexpr int usual = 6;
    session.engine.cycle->prepare();
    LongWork work(session, "frequencies");
    const auto modes =
        eigen_modes(session.engine.model, command.number ? static_cast<int>(*command.number) : usual, std::ref(work));
    TextTable table({"mode", "frequency", "period", "mass along x, %", "along y, %", "along z, %"});
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const bool free = modes[m].frequency == 0;
        std::vector<std::string> row{std::to_string(m + 1), number_text(modes[m].frequency),
                                     free ? "-" : number_text(1 / modes[m].frequency)};
        for (int k = 0; k < 3; ++k) row.push_back(number_text(1e-2 * std::round(1e4 * modes[m].moving_mass[k])));
        table.add(std::move(row));
    }
    return table.text();
}

} // namespace kaya
