#include "solver/dense/blas_kernels.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <limits>
#include <string>

namespace perilink {

const char* fitting_kernels(std::string_view taken, bool has_avx2, bool has_avx512) {
  if (taken != "Prescott") return "";
  return has_avx512 ? "SKYLAKEX" : has_avx2 ? "HASWELL" : "";
}

void use_fitting_kernels() {
#ifdef __x86_64__
  constexpr const char* setting = "OPENBLAS_CORETYPE";
  using CoreName = const char* (*)();
  using Call = void (*)();
  auto* name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  // It chooses again after its first choice is discarded.
  auto* forget = reinterpret_cast<Call>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_quit"));
  auto* choose = reinterpret_cast<Call>(dlsym(RTLD_DEFAULT, "gotoblas_dynamic_init"));
  if (name == nullptr || forget == nullptr || choose == nullptr) return;
  if (std::getenv(setting) != nullptr) return;
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  const char* kernels = fitting_kernels(name(), __builtin_cpu_supports("avx2"), has_avx512);
  if (*kernels == '\0' || setenv(setting, kernels, 1) != 0) return;
  forget();
  choose();
#endif
}

int most_blas_threads(std::string_view config) {
  constexpr std::string_view key = "MAX_THREADS=";
  const std::size_t at = config.find(key);
  const int most =
      at == config.npos ? 0 : std::atoi(std::string(config.substr(at + key.size())).c_str());
  return most > 0 ? most : std::numeric_limits<int>::max();
}

int most_blas_threads() {
  using Config = const char* (*)();
  auto* config = reinterpret_cast<Config>(dlsym(RTLD_DEFAULT, "openblas_get_config"));
  return most_blas_threads(config == nullptr ? "" : config());
}

}  // namespace perilink
