// Feeds arbitrary bytes to the case reader. It may refuse them with one of the program's own errors
// and nothing else; what it accepts must survive being written and read back.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "io/case/case_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  perilink::CaseFile input;
  try {
    input = perilink::parse_case(text, "fuzz.toml");
  } catch (const perilink::InputError&) {
    return 0;
  }
  const std::string written = perilink::write_case(input);
  if (perilink::write_case(perilink::parse_case(written, "written.toml")) != written) std::abort();
  return 0;
}
