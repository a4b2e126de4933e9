#include "results/state_file.hpp"

#include <optional>

#include "base/error.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/checkpoint/pack.hpp"

namespace perilink {
namespace {

std::string fingerprint_of(const LoadedNetwork& problem) {
  const Network& network = problem.network;
  return fingerprint({network.particles.positions, network.stiffness, network.critical_stretch,
                      problem.loads.forces, problem.unknowns.prescribed});
}

}  // namespace

void write_state(const std::string& path, const LoadedNetwork& problem, const DamageState& state) {
  write_checkpoint(path, {"", fingerprint_of(problem), pack(state)});
}

DamageState read_state(const std::string& path, const LoadedNetwork& problem) {
  const std::optional<Checkpoint> saved = read_checkpoint(path);
  if (!saved) throw FileError(path + ": there is no such file");
  if (saved->model != fingerprint_of(problem)) {
    throw FileError(path +
                    ": is the state of another problem\n"
                    "  give the case with the bodies, materials and loads that it was saved with");
  }
  DamageState state;
  unpack(saved->state, state);
  return state;
}

}  // namespace perilink
