// The work of the program in one process.
#pragma once

namespace kaya {

/// Does what the words of the command line ask for and returns the exit status. Errors are printed.
int work(int argc, char** argv);

} // namespace kaya
