#pragma once

namespace perilink {

/// Reads the command line and calls one command. \return the exit status
int run_program(int argc, char** argv);

}  // namespace perilink
