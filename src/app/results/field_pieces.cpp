#include "app/results/field_pieces.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>

#include "assembly/results/stress.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

std::string piece_name(const std::string& stem, int rank) {
  return fmt::format("{}_{:04}.vtu", stem, rank);
}

/// Fields of a part without those of ghosts, which come last and lack bonds.
VtuGrid own_grid(const PartSolver& solver, const PieceInput& input) {
  const BodyPart& part = solver.part();
  const Network& network = part.network;
  const Csr families = bonds_of_particles(network.bonds, network.particles.size());
  const std::span<const double> motion = solver.last_motion();
  VtuGrid grid = make_field_grid(network, part.secants(), motion, input.moment, {}, families);
  add_stresses(grid, particle_stresses({network, families, input.problem, input.hooke}, motion),
               network.dim());
  const auto owned = static_cast<std::size_t>(part.owned());
  grid.points.resize(3 * owned);
  for (VtuArray& array : grid.point_data) array.values.resize(owned * array.components);
  for (VtuArray& array : grid.cell_data) array.values.resize(owned * array.components);
  grid.types.resize(owned);
  grid.offsets.resize(owned);
  grid.connectivity.resize(owned);
  return grid;
}

/// Writes the piece of a rank. \return what went wrong; empty: nothing
std::string write_own(const std::string& stem, int rank, const VtuGrid& grid) {
  try {
    write_vtu(piece_name(stem, rank), grid);
    return "";
  } catch (const std::exception& error) {
    return failure_text(error);
  }
}

void put(Parcel& parcel, const std::string& text) {
  parcel.put(std::vector<char>(text.begin(), text.end()));
}

std::string get_text(Parcel& parcel) {
  std::vector<char> letters;
  parcel.get(letters);
  return {letters.begin(), letters.end()};
}

}  // namespace

void write_pieces(const Team& team, const std::string& stem, const PieceInput& input) {
  Ranks& ranks = team.ranks();
  std::vector<std::string> names;
  std::string fault;
  const VtuGrid grid = lead(ranks, [&] {
    Parcel order;
    order.put(Service::write_piece);
    put(order, stem);
    order.put(input.moment);
    order.put(input.problem);
    order.put(input.hooke);
    for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, order.bytes());
    VtuGrid own = own_grid(team.own(), input);
    fault = write_own(stem, 0, own);
    for (int rank = 0; rank < ranks.count(); ++rank) {
      names.push_back(std::filesystem::path(piece_name(stem, rank)).filename().string());
      if (rank == 0) continue;
      Parcel answer(ranks.receive(rank));
      const std::string other = get_text(answer);
      if (fault.empty()) fault = other;
    }
    return own;
  });
  if (!fault.empty()) throw SolverError(fault);
  write_pvtu(stem + ".pvtu", grid, names);
}

void write_piece_along(Ranks& ranks, const PartSolver& own, Parcel& order) {
  const std::string stem = get_text(order);
  PieceInput input;
  order.get(input.moment);
  order.get(input.problem);
  order.get(input.hooke);
  Parcel answer;
  put(answer, write_own(stem, ranks.own(), own_grid(own, input)));
  ranks.send(0, answer.bytes());
}

}  // namespace perilink
