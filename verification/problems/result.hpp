#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace perilink::verification {

/// Puts a finished table in the place of the study's file; an interrupted study leaves the old one.
inline void write_result(const std::string& directory, const std::string& table,
                         const std::string& file_name = "result.csv") {
  const std::filesystem::path path = std::filesystem::path(directory) / file_name;
  const std::filesystem::path partial = path.string() + ".part";
  std::ofstream file(partial);
  file << table;
  file.close();
  if (file) std::filesystem::rename(partial, path);
}

}  // namespace perilink::verification
