// Throws when it is asked for its descriptor.
#include "kaya/jmodel.h"

const kaya_jmodel* kaya_joint_model(void) { throw 7; }
