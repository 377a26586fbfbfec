// Ends the program when it is asked for its descriptor.
#include "kaya/jmodel.h"

#include <cstdlib>

const kaya_jmodel* kaya_joint_model(void) { std::exit(0); }
