#pragma once

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// \file
/// The project's own files, for tests that read them.

namespace perilink::quality {

inline const std::filesystem::path& project_root() {
  static const std::filesystem::path root = PERILINK_SOURCE_DIR;
  return root;
}

/// Path as messages show it, from the top of the project.
inline std::string shown(const std::filesystem::path& file) {
  return file.lexically_relative(project_root()).generic_string();
}

inline std::vector<std::string> read_lines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Files below a folder of the project, sorted.
inline std::vector<std::filesystem::path> files_below(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path top = project_root() / folder;
  if (!std::filesystem::exists(top)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// C++ files below a folder of the project, sorted.
inline std::vector<std::filesystem::path> cpp_files(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& file : files_below(folder)) {
    if (file.extension() == ".cpp" || file.extension() == ".hpp") files.push_back(file);
  }
  return files;
}

/// Files that git tracks; outside a checkout (a source archive) there is no such list and the
/// result is empty.
inline std::vector<std::filesystem::path> tracked_files() {
  const std::string command = "git -C '" + project_root().string() + "' ls-files -z 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::vector<std::filesystem::path> files;
  std::string name;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c != '\0') {
      name += static_cast<char>(c);
      continue;
    }
    // A file may be deleted in the working tree and not yet in git.
    if (std::filesystem::is_regular_file(project_root() / name)) {
      files.push_back(project_root() / name);
    }
    name.clear();
  }
  pclose(pipe);
  if (!files.empty()) return files;
  for (const char* folder : {"src", "tests", "verification", "docs", "meshes"}) {
    const auto more = files_below(folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

}  // namespace perilink::quality
