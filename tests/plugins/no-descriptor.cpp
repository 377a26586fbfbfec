// Returns no descriptor.
#include "kaya/jmodel.h"

const kaya_jmodel* kaya_joint_model(void) { return nullptr; }
