#pragma once

#include <cstddef>

namespace perilink {

/// Allocates memory that malloc's free() can free. Blocks of 1 MB and more use huge pages where
/// Linux offers them (transparent_hugepage = madvise or always), which makes large bodies much
/// faster to read. CHOLMOD and the operator new of the program allocate here.
/// \return null if there is no memory
void* allocate_memory(std::size_t bytes) noexcept;

}  // namespace perilink
