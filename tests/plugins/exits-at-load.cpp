// Ends the program in the function that returns its descriptor.
#include "kaya/jmodel.h"

#include <cstdlib>

const kaya_jmodel* kaya_joint_model(void) { std::exit(0); }
