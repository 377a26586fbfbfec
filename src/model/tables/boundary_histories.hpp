// Time-dependent loads and velocities: a number times a function of time.
#pragma once

#include "model/tables/blocks.hpp"
#include "model/tables/column.hpp"

#include <cstdint>
#include <string>

namespace kaya {

/// A time-dependent factor: the words after `hist` of a boundary condition.
struct TimeFunction {
    enum class Kind : std::int32_t { sine, cosine, impulse, table, script };
    Kind kind = Kind::sine;
    double frequency = 0;   ///< cycles/time
    double duration = 0;    ///< the factor is 0 after that time; 0: it never ends
    std::int64_t table = 0; ///< number of the table that gives the factor over time
    std::string script;     ///< name of the deck's function or variable
    std::string place;      ///< "quake.3dd:12", for messages

    bool operator==(const TimeFunction&) const = default;
};

/// The function number of a value that does not depend on time.
inline constexpr std::int32_t constant_in_time = -1;

/// One component of a load or of a prescribed velocity that changes with time. Of a rigid block, component 0 to 2
/// is translation or force, 3 to 5 rotation or moment, and 6 + 3 f + a the part of Blocks::load_arms of the force along
/// axis f and the arm along the block's own axis a; of a gridpoint only 0 to 2.
class BoundaryHistories : public Table<BoundaryHistories> {
public:
    enum class What : std::int32_t { velocity, load };
    static constexpr std::int32_t motions = 6, loads = 15; ///< how many components a rigid block has of each

    Column<BlockId> block;
    Column<Row> gridpoint; ///< counted from the first one of the block; no_row: the block as a whole
    Column<What> what;
    Column<std::int32_t> component;
    Column<double> amplitude;      ///< velocity, or force; times the function it acts
    Column<double> acting;         ///< of a load: its present contribution to the load of its body
    Column<std::int32_t> function; ///< row of Model::time_functions

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("gridpoint", gridpoint, Role::local_link);
        visit("what", what, Role::condition);
        visit("component", component, Role::condition);
        visit("amplitude", amplitude, Role::load);
        visit("acting", acting, Role::load);
        visit("function", function, condition<TimeFunction>());
    }
};

/// Storage of a load on a rigid block; components as in BoundaryHistories.
inline double& load_component(Blocks& blocks, Row block, int component) {
    if (component < 3) return blocks.load[block][component];
    if (component < BoundaryHistories::motions) return blocks.torque[block][component - 3];
    const int place = component - BoundaryHistories::motions;
    return blocks.load_arms[block](place % 3, place / 3);
}

} // namespace kaya
