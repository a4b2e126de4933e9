#include "app/results/field_pieces.hpp"

#include <exception>

#include "assembly/results/stress.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

enum class FieldJob : int { write_piece, send_stresses };

/// Stresses at all particles that a rank knows.
std::vector<double> stresses_of(const PartSolver& solver, const Csr& neighbourhoods,
                                const PieceInput& input) {
  return particle_stresses({solver.part().network, neighbourhoods, input.problem, input.hooke},
                           solver.last_motion());
}

Csr neighbourhoods_of(const Network& network) {
  return bonds_of_particles(network.bonds, network.particles.size());
}

/// Fields of a part without those of ghosts, which come last and lack bonds.
VtuGrid own_grid(const PartSolver& solver, const PieceInput& input) {
  const BodyPart& part = solver.part();
  const Network& network = part.network;
  const Csr neighbourhoods = neighbourhoods_of(network);
  VtuGrid grid = make_field_grid(network, part.secants(), solver.last_motion(), input.moment, {},
                                 neighbourhoods);
  add_stresses(grid, stresses_of(solver, neighbourhoods, input), network.dim());
  const auto owned = static_cast<std::size_t>(part.owned());
  grid.points.resize(3 * owned);
  for (VtuArray& array : grid.point_data) array.values.resize(owned * array.components);
  for (VtuArray& array : grid.cell_data) array.values.resize(owned * array.components);
  grid.types.resize(owned);
  grid.offsets.resize(owned);
  grid.connectivity.resize(owned);
  return grid;
}

std::vector<double> own_stresses(const PartSolver& solver, const PieceInput& input) {
  std::vector<double> stresses =
      stresses_of(solver, neighbourhoods_of(solver.part().network), input);
  stresses.resize(static_cast<std::size_t>(solver.part().owned()) * Stress{}.size());
  return stresses;
}

/// Writes the piece of a rank. \return what went wrong; empty: nothing
std::string write_own(const std::string& stem, int rank, const VtuGrid& grid) {
  try {
    write_vtu(piece_of_vtu(stem, rank), grid);
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

/// Sends an order to all other ranks.
void give_order(Ranks& ranks, FieldJob job, const PieceInput& input, const std::string& stem) {
  Parcel order;
  order.put(Service::show_fields);
  order.put(job);
  order.put(input.moment);
  order.put(input.problem);
  order.put(input.hooke);
  put(order, stem);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, order.bytes());
}

}  // namespace

void write_pieces(const Team& team, const std::string& stem, const PieceInput& input) {
  Ranks& ranks = team.ranks();
  std::string fault;
  const VtuGrid grid = lead(ranks, [&] {
    give_order(ranks, FieldJob::write_piece, input, stem);
    VtuGrid own = own_grid(team.own(), input);
    fault = write_own(stem, 0, own);
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel answer(ranks.receive(rank));
      const std::string other = get_text(answer);
      if (fault.empty()) fault = other;
    }
    return own;
  });
  if (!fault.empty()) throw SolverError(fault);
  write_pvtu(stem, grid, ranks.count());
}

std::vector<double> stresses_of_parts(const Team& team, Index particles, const PieceInput& input) {
  constexpr std::size_t width = Stress{}.size();
  Ranks& ranks = team.ranks();
  return lead(ranks, [&] {
    give_order(ranks, FieldJob::send_stresses, input, "");
    std::vector<double> all(static_cast<std::size_t>(particles) * width, 0.0);
    team.put_in_place(0, own_stresses(team.own(), input), width, all);
    for (int rank = 1; rank < ranks.count(); ++rank) {
      std::vector<double> own;
      Parcel(ranks.receive(rank)).get(own);
      team.put_in_place(rank, own, width, all);
    }
    return all;
  });
}

void show_fields_along(Ranks& ranks, const PartSolver& own, Parcel& order) {
  const auto job = order.get<FieldJob>();
  PieceInput input;
  order.get(input.moment);
  order.get(input.problem);
  order.get(input.hooke);
  const std::string stem = get_text(order);
  Parcel answer;
  if (job == FieldJob::write_piece) {
    put(answer, write_own(stem, ranks.own(), own_grid(own, input)));
  } else {
    answer.put(own_stresses(own, input));
  }
  ranks.send(0, answer.bytes());
}

}  // namespace perilink
