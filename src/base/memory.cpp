#include "base/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <new>
#include <string>

namespace perilink {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// Returns the free memory of the machine [bytes].
double free_memory() {
  std::ifstream file("/proc/meminfo");
  double kilobytes = 0.0;
  for (std::string word; file >> word;) {
    if (word == "MemAvailable:" && file >> kilobytes) return 1024.0 * kilobytes;
  }
  return unknown;
}

/// Returns the limit of the process [bytes].
double limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  return static_cast<double>(limit.rlim_cur);
}

/// Address space of the process and its data part [bytes].
struct Taken {
  double all = 0.0, data = 0.0;
};

Taken taken() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0, shared = 0.0, text = 0.0, library = 0.0, data = 0.0;
  file >> all >> resident >> shared >> text >> library >> data;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {all * page, data * page};
}

}  // namespace

double available_address_space() {
  const Taken now = taken();
  return std::max(0.0, std::min(limit_of(RLIMIT_AS) - now.all, limit_of(RLIMIT_DATA) - now.data));
}

double available_memory() { return std::min(free_memory(), available_address_space()); }

std::string bytes_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", std::ceil(bytes / 1e6));
  return bytes < 1e11 ? fmt::format("{:.3g} GB", bytes / 1e9)
                      : fmt::format("{:.0f} GB", bytes / 1e9);
}

std::string failure_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) == nullptr) return error.what();
  const double limit = std::min(limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA));
  const std::string there_is =
      std::isfinite(limit)
          ? fmt::format("the process may take {} (ulimit -v or -d)", bytes_text(limit))
          : fmt::format("{} of memory are free", bytes_text(free_memory()));
  return fmt::format(
      "out of memory: {}; a coarser body or a smaller horizon needs less, and perilink check "
      "reports how much",
      there_is);
}

}  // namespace perilink
