// The zone models of the blocks with the values that hold for them, and the zones in tiles of one law each; derived.
#pragma once

#include "base/diagnostic.hpp"
#include "laws/zone_model.hpp"
#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/zones/zone_tiles.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Coupling of zones with their neighbours: docs/theory/zones.md.
enum class Together {
    nothing, ///< each is on its own
    at_points, ///< tetrahedra average volume strain and the plastic change of the mean stress over the zones at each gridpoint
    strains_at_points, ///< flowing zones have the mean strain of the zones at their gridpoints: trials of `solve fos extrapolate`
    flow_in_cells, ///< the six zones of a cell are its layers: their model runs at six points
    cells          ///< elastic zones strain cell by cell: their model runs once for six
};

/// Whether the six zones of a cell stay together.
inline bool by_cells(Together together) { return together == Together::flow_in_cells || together == Together::cells; }

/// A zone model with values.
struct ZoneLaw {
    const ZoneModel* model;
    std::vector<double> values; ///< in the order of the model's property table
    ElasticConstants elastic;
    Together together;
};

/// A bit of Model::unreduced after those of KeptStrength, so that only trials of `solve fos` set it: all flowing zones are coupled by
/// Together::strains_at_points.
constexpr std::uint8_t strains_are_shared = keep_tension << 1;
/// The same: angles of dilation are those of friction, as far as it is reduced.
constexpr std::uint8_t flow_is_associated = strains_are_shared << 1;

/// Whether each friction of a zone model has a dilation that can be as large: `joint-dilation` for `joint-friction`.
bool can_flow_associated(const ZoneModel& zone_model);

class ZoneLaws {
public:
    ZoneLaws() = default;
    /// Allocates the columns of the laws. Throws Diagnostic where a block's zone model is missing, or its values are missing, outside their
    /// limits, or inconsistent.
    ZoneLaws(Model& model, ZoneModels& models);

    const ZoneLaw& of_block(Row block) const { return laws[static_cast<std::size_t>(law_of_[block])]; }
    std::vector<ElasticConstants> elastic_constants() const; ///< by block, zero for rigid ones
    bool any(Together together) const;

    std::vector<ZoneLaw> laws;
    ZoneTiles tiles;

private:
    std::vector<Row> law_of_; ///< by block, no_row for rigid ones
};

/// The zone model of a block: that of `zone model`, else that of its constitutive number. Throws Diagnostic for a number
/// that means none.
std::string zone_model_of(const Model& model, Row block);

/// The values of a zone model for a block with its material, whether it has zones or not; NaN for one that was not given.
std::vector<double> zone_model_values(const Model& model, Row block, const ZoneModel& zone_model);

/// A property of a zone model for a material: given by `prop mat`, else its initial value.
double value_for_material(const LawTable::Property& property, const Material& material);

/// Points a batch at columns of the same names; rows, history and state are the caller's.
template <class Columns> void point_to(kaya_zbatch& batch, const ZoneLaw& law, const Model& model, Columns& columns) {
    batch = {};
    batch.properties = law.values.data();
    batch.time_step = model.clock.time_step;
    batch.volume = columns.volume;
    batch.pore_pressure = columns.pressure;
    batch.dissipation = columns.dissipation;
    for (int k = 0; k < 6; ++k) {
        batch.strain_inc[k] = columns.strain[k];
        batch.stress[k] = columns.stress[k];
    }
    if (!model.settings.large_strain) return;
    for (int k = 0; k < 3; ++k) batch.spin[k] = columns.spin[k];
}

/// The message about a zone whose model failed.
Diagnostic failed_zone(const Model& model, const ZoneLaw& law, Row zone, const ZoneFailure& failure);

/// Whether Settings::strength_factor changes anything about it.
bool can_be_reduced(const ZoneModel& model);

/// Removes the history of the old model when a block's zones get another one.
void forget_zones(Model& model, Row block);

} // namespace kaya
