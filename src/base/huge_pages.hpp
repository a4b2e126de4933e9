#pragma once

#include <cstddef>

namespace perilink {

/// Memory for malloc's free(); large pieces in huge pages where the system gives these to who asks
/// (Linux with transparent_hugepage = madvise or always): large bodies are read far faster so. The
/// program's operator new takes its memory here, and CHOLMOD.
/// \return null where there is none
void* allocate_memory(std::size_t bytes) noexcept;

}  // namespace perilink
