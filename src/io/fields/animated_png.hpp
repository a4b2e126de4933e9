#pragma once

#include <span>
#include <string>

namespace perilink {

/// Returns pictures as frames of one animated PNG (PNG, third edition, 2025), which browsers play
/// without end; other programs show the first frame.
/// \param pictures  whole PNG files of one size
/// \param shown     time of a frame; the last one stays five times as long [ms]
/// \throws std::invalid_argument where a picture is no PNG, or has another size or kind of pixels
std::string animated_png(std::span<const std::string> pictures, int shown);

}  // namespace perilink
