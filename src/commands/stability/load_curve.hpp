// The curve of solve control.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace kaya {

/// Some cycles: displacement and load are means, the rest is that of the last one.
struct CurveRow {
    double displacement = 0, load = 0, time = 0;
    double pushed = 0; ///< the load with what motion and damping take
    Vec3 reaction = Vec3::Zero();
    double lost = 0, damped = 0, ratio = 0;
    double stored = 0, zone_work = 0; ///< in joints; on zones
    bool at_rest = false;             ///< hardly any work went into motion and damping
};

class LoadCurve {
public:
    /// `parts`: shorter rows of the same cycles. They take the place of the row where a sharp peak lies between rows. Only rows at rest are the
    /// peak, once there is one.
    void add(const CurveRow& row, std::vector<CurveRow> parts);
    std::size_t size() const { return rows_.size(); }
    bool empty() const { return rows_.empty(); }
    const CurveRow& back() const { return rows_.back(); }
    /// Row of the greatest load; there must be one.
    const CurveRow& peak() const { return rows_[peak_]; }
    /// Whether the peak is a row at rest, and not only the greatest load of a model that moves.
    bool peak_is_at_rest() const { return !rows_.empty() && peak().at_rest; }
    /// Whether the load was at most `load` in the last rows, undivided, also with what motion takes: it has not only jumped there.
    bool stays_below(double load) const;

    /// How far, over the peak, the true peak may lie above it, by the larger of the last two steps of the load up to a sharp peak. A flat
    /// one has 0, as one that may still rise.
    double doubt_of_peak() const;
    /// How often the load falls by `part` of the peak and rises by as much again near the peak, in rows at rest where the peak is. What it does
    /// more than once may be vibration, and the peak may lie above the load that the model bears at rest.
    int swings_at_peak(double part) const;
    static constexpr double much_doubt = 0.01;

    /// Writes the table and the CSV file that the command wants.
    void store(Session& session, const lang::SolveControl& command) const;
    /// Draws what the command wants: the load with its peak, the sums of reactions, the energies, over the displacement. Names of axes are
    /// quantities with their units: "force [force]".
    void draw(Session& session, const lang::SolveControl& command, const std::string& displacement,
              const std::string& load) const;

private:
    /// A row, and where it, or what took its place, begins in rows_.
    struct Added {
        CurveRow row;
        std::vector<CurveRow> parts;
        std::size_t first;
    };

    bool is_peak(const CurveRow& row) const {
        return row.at_rest != peak().at_rest ? row.at_rest : row.load > peak().load;
    }
    bool drops_after_peak() const;
    void divide_last();

    std::vector<CurveRow> rows_;
    std::vector<Added> last_; ///< at most four
    std::size_t peak_ = 0;
};

} // namespace kaya
