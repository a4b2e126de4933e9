#include "base/huge_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace perilink {

void* allocate_memory(std::size_t bytes) noexcept {
  constexpr std::size_t large = std::size_t{1} << 20;
  void* memory = std::malloc(bytes > 0 ? bytes : 1);
  if (bytes < large || memory == nullptr) return memory;
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = begin + bytes;
  const std::uintptr_t first = (begin + page - 1) / page * page;
  // Only advice: a system that ignores it keeps small pages.
  (void)madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  return memory;
}

}  // namespace perilink
