#include "base/build_info.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/build_config.hpp"

namespace perilink {

std::string program_version() { return build_config::version; }

std::string program_commit() { return build_config::commit; }

namespace {

/// Returns the BLAS library that is loaded and the processor that OpenBLAS chose its kernels for.
std::string blas() {
  Dl_info library;
  void* product = dlsym(RTLD_DEFAULT, "dgemm_");
  if (product == nullptr || dladdr(product, &library) == 0) return "not loaded";
  using CoreName = const char* (*)();
  auto* name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  std::error_code failed;
  const std::string path = std::filesystem::canonical(library.dli_fname, failed).string();
  return name == nullptr ? path : path + ", kernels for " + name();
}

}  // namespace

std::string build_summary() {
  constexpr std::size_t name_width = 10;
  const std::string build =
      std::string(build_config::build_type) + ", " + build_config::instructions + " instructions";
  const std::string kernels = blas();
  const std::pair<std::string_view, std::string_view> lines[] = {
      {"commit", build_config::commit},
      {"compiler", build_config::compiler},
      {"build", build},
      {"OpenMP", build_config::openmp},
      {"CHOLMOD", build_config::cholmod},
      {"BLAS", kernels},
      {"METIS", build_config::metis},
      {"Eigen", build_config::eigen},
      {"MPI", build_config::mpi},
      {"gmsh", build_config::gmsh},
  };
  std::string text = "perilink " + program_version() + "\n";
  for (const auto& [name, value] : lines) {
    text += "  " + std::string(name) + std::string(name_width - name.size(), ' ');
    text += std::string(value) + "\n";
  }
  return text;
}

}  // namespace perilink
