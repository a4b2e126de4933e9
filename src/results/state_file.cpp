#include "results/state_file.hpp"

#include <optional>

#include "base/error.hpp"
#include "discretization/hosts/hosts.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/checkpoint/pack.hpp"

namespace perilink {

std::string fingerprint_of(const LoadedNetwork& problem) {
  const Network& network = problem.network;
  // With hosts the motion changes as they release their particles.
  const Unknowns& motion = problem.embedded ? problem.embedded->free : problem.unknowns;
  std::string text = fingerprint(network.particles.positions, network.particles.volumes,
                                 network.bonds.first, network.bonds.second, network.stiffness,
                                 network.critical_stretch, network.support_stiffness,
                                 problem.loads.forces, motion.number, motion.prescribed);
  for (const LoadCase& loads : problem.sets) {
    text += fingerprint(loads.loads.forces, loads.unknowns.number, loads.unknowns.prescribed);
  }
  if (problem.embedded) {
    const Hosts& hosts = problem.embedded->hosts;
    text += fingerprint(hosts.nodes, hosts.nodes_of.values, hosts.inside.offsets,
                        hosts.inside.values, hosts.weights);
  }
  return text;
}

void require_state_of(const LoadedNetwork& problem, const std::string& fingerprint,
                      const std::string& name) {
  if (fingerprint == fingerprint_of(problem)) return;
  throw FileError(name +
                  ": is the state of another problem\n"
                  "  give the case with the bodies, materials and loads that it was saved with");
}

void write_state(const std::string& path, const LoadedNetwork& problem, const DamageState& state) {
  write_checkpoint(path, {"", fingerprint_of(problem), pack(state)});
}

DamageState read_state(const std::string& path, const LoadedNetwork& problem) {
  const std::optional<Checkpoint> saved = read_checkpoint(path);
  if (!saved) throw FileError(path + ": there is no such file");
  require_state_of(problem, saved->model, path);
  DamageState state;
  unpack(saved->state, state);
  return state;
}

}  // namespace perilink
