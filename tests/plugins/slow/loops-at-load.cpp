// Does not return when it is loaded.
#include "kaya/jmodel.h"

#include <unistd.h>

namespace {

int wait_for_ever() {
    volatile int again = 1;
    while (again == 1) ::pause(); // and takes no time of the processor
    return again;
}

const int never = wait_for_ever();

} // namespace

const kaya_jmodel* kaya_joint_model(void) { return never == 0 ? nullptr : nullptr; }
