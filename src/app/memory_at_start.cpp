// Checks available memory before any library starts. OpenBLAS allocates a buffer per thread while
// it is loaded; without memory it retries forever (fixed after its version 0.3.29). Code in main()
// or in a constructor would run too late.

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "app/commands/commands.hpp"

// AddressSanitizer starts even later and reserves more address space than any limit.
#ifndef __SANITIZE_ADDRESS__

namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;
/// Buffer, stack and heap of a thread of OpenBLAS [bytes].
constexpr std::size_t for_each_thread = 272 * megabyte;
/// One buffer and the memory of the program itself [bytes].
constexpr std::size_t least = 160 * megabyte;

bool can_take(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  munmap(memory, bytes);
  return true;
}

/// Restarts the program with one OpenBLAS thread, which is all it uses. Returns if the restart is
/// impossible or has already happened.
void start_again_with_one_thread(char** words, char** environment) {
  static char setting[] = "OPENBLAS_NUM_THREADS=1";
  static std::array<char*, 4096> changed;
  constexpr std::size_t name_length = sizeof setting - 2;  // with the equals sign
  std::size_t count = 0;
  for (; *environment != nullptr; ++environment) {
    if (std::strcmp(*environment, setting) == 0) return;
    if (std::strncmp(*environment, setting, name_length) == 0) continue;
    if (count + 2 >= changed.size()) return;
    changed[count++] = *environment;
  }
  changed[count] = setting;
  execve("/proc/self/exe", words, changed.data());
}

void look_for_memory(int /*count*/, char** words, char** environment) {
  const long processors = sysconf(_SC_NPROCESSORS_ONLN);
  if (can_take((processors < 1 ? 1 : static_cast<std::size_t>(processors)) * for_each_thread)) {
    return;
  }
  start_again_with_one_thread(words, environment);
  if (can_take(least)) return;
  constexpr char text[] =
      "perilink: out of memory: the libraries of the program need 160 MB as they start\n"
      "  raise the limit (ulimit -v, ulimit -d) or free memory\n";
  [[maybe_unused]] const ssize_t ignored = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(perilink::exit_solver);
}

__attribute__((section(".preinit_array"), used)) void (*first)(int, char**,
                                                               char**) = look_for_memory;

}  // namespace

#endif
