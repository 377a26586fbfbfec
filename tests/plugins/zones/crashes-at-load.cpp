// A zone model that crashes when it is loaded.
#include "stdlib/zones/zone.hpp"

#include <csignal>

const kaya_zmodel* kaya_zone_model(void) {
    std::raise(SIGSEGV);
    return nullptr;
}
