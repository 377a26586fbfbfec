// A zone model without its function.
#include "stdlib/zones/zone.hpp"

namespace {
using namespace kaya::zones;
constexpr std::array properties{bulk_property, shear_property};
constexpr std::array<kaya_jhistory, 0> history{};
constexpr kaya_zmodel descriptor = model("null-run", "has nothing to run", properties, history, "", false, nullptr);
} // namespace

const kaya_zmodel* kaya_zone_model(void) { return &descriptor; }
