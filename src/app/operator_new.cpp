// Replaces the global operator new, so that large vectors of the program use huge pages. Libraries
// leave the allocator of their process as it is.

#include <cstddef>
#include <cstdlib>
#include <new>

#include "base/huge_pages.hpp"

#ifndef __SANITIZE_ADDRESS__  // its allocator reports memory that is freed in another way

// Not inlined, because compilers would report free() as a mismatch with new.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  void* memory = perilink::allocate_memory(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*bytes*/) noexcept {
  std::free(memory);
}

#endif
