#pragma once

namespace perilink::verification {

/// Spacings across the prism that give about 10 000 and 30 000 unknowns.
inline constexpr int spacings_10k = 9, spacings_30k = 13;

/// Prints the time of a batch on one thread by each way of following it, by number of segments.
/// \param dim   2: the tension block; 3: a prism of 4:1:1
/// \param size  particles across the block, spacings across the prism
void print_batch_times(int dim, int size);

}  // namespace perilink::verification
