// Throws while the descriptor is asked for.
#include "kaya/jmodel.h"

const kaya_jmodel* kaya_joint_model(void) { throw 7; }
