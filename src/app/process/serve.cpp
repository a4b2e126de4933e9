#include "app/process/serve.hpp"

#include <exception>

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/quasistatic/ranks/team.hpp"
#include "base/memory.hpp"
#include "base/parcel.hpp"

namespace perilink {

void serve(Ranks& ranks) {
  TeamMember member(ranks);
  try {
    for (;;) {
      Parcel order(ranks.receive(0));
      switch (order.get<Service>()) {
        case Service::end: return;
        case Service::solve: member.obey(order); break;
        case Service::move_bonds: move_bonds_along(ranks, order); break;
      }
    }
  } catch (const std::exception& error) {
    ranks.abandon(failure_text(error));
  }
}

void dismiss(Ranks& ranks) {
  Parcel order;
  order.put(Service::end);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, order.bytes());
}

}  // namespace perilink
