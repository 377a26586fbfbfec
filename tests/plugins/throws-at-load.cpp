// Throws in the function that returns its descriptor.
#include "kaya/jmodel.h"

const kaya_jmodel* kaya_joint_model(void) { throw 7; }
