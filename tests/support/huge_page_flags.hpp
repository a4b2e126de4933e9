#pragma once

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

namespace perilink::test {

/// Returns the flags of the mapping that holds an address; empty: unknown.
inline std::string flags_of(const void* address) {
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream file("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(file, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream range(line);
    if (range >> std::hex >> begin >> dash >> end && dash == '-') {
      is_here = begin <= place && place < end;
    }
    if (is_here && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

/// Whether huge pages are asked for at an address.
inline bool are_asked_for(const void* address) {
  return flags_of(address).find(" hg ") != std::string::npos;
}

/// Whether the system has huge pages for those who ask.
inline bool can_be_had() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string words;
  std::getline(file, words);
  return words.find("[never]") == std::string::npos && !words.empty();
}

}  // namespace perilink::test
