// Writes the cases of the tables in tests/cli/malformed, each to a file of the folder that the
// command line names.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "support/case_tables.hpp"

namespace test = perilink::test;

int main(int count, char** names) {
  if (count != 2) {
    std::fprintf(stderr, "usage: expand_cases FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = names[1];
    std::filesystem::create_directories(folder);
    for (const char* tables : {"text", "body"}) {
      for (const test::CaseEntry& entry : test::read_case_tables(tables)) {
        std::ofstream(folder / (entry.name + ".toml"), std::ios::binary) << test::case_text(entry);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
