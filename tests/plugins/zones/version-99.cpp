// A zone model built for another interface.
#include "stdlib/zones/zone.hpp"

namespace {
kaya_zmodel descriptor{};
}

const kaya_zmodel* kaya_zone_model(void) {
    descriptor.interface_version = 99;
    return &descriptor;
}
