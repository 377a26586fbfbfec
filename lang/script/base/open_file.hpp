// The file of FISH's `open`, `read`, `write` and `close`: one at a time.
#pragma once

#include "system/door.hpp"

namespace kaya::script {

struct OpenFile {
    door::Stream reading, writing;
};

} // namespace kaya::script
