#include "problems/program.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>

int main(int count, char** words) try {
  return perilink::verification::run_program({words + 1, words + count}) ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}: {}\n", std::filesystem::path(words[0]).filename().string(), error.what());
  return 1;
}
