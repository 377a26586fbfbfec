// The command line: options, subcommands, and the run or the tool that they ask for.
#pragma once

namespace kaya {

/// Does what the command line asks for. Gives the exit status; throws what main() reports.
int start(int argc, char** argv);

} // namespace kaya
