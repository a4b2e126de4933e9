#pragma once

#include <string>
#include <vector>

namespace perilink::verification {

/// A study. Each program of one defines it; program.cpp calls it and tells what it throws.
/// \param arguments  those behind the name of the program
/// \return whether the study found what it claims: the exit status of the program is 0 then, else 1
bool run_program(const std::vector<std::string>& arguments);

}  // namespace perilink::verification
