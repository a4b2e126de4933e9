#include "solver/ordering.hpp"

#include <gtest/gtest.h>

#include <sys/time.h>

#include <algorithm>
#include <csignal>

#include "support/spring_lattice.hpp"

namespace perilink {
namespace {

TEST(Ordering, IsAPermutationThatKeepsParticlesTogether) {
  const auto lattice = test::make_spring_lattice(20, 15, 3.0);

  const auto order = order_by_particles(lattice.lower, lattice.groups);

  auto sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (Index k = 0; k < lattice.size; ++k) ASSERT_EQ(sorted[k], k);
  for (std::size_t k = 0; k < order.size(); k += 2) EXPECT_EQ(order[k] + 1, order[k + 1]);
}

TEST(Ordering, IsTheSameInEveryRun) {
  const auto lattice = test::make_spring_lattice(20, 15, 3.0);
  EXPECT_EQ(order_by_particles(lattice.lower, lattice.groups),
            order_by_particles(lattice.lower, lattice.groups));
}

TEST(Ordering, HoldsForOneParticleAndForNoBonds) {
  const auto one = test::make_spring_lattice(1, 1, 1.0);
  EXPECT_EQ(order_by_particles(one.lower, one.groups), (std::vector<Index>{0, 1}));
  const auto loose = test::make_spring_lattice(3, 1, 0.5);
  EXPECT_EQ(order_by_particles(loose.lower, loose.groups).size(), 6u);
}

volatile std::sig_atomic_t terminations = 0;

extern "C" void on_termination(int) { terminations = terminations + 1; }
extern "C" void on_alarm(int) { std::raise(SIGTERM); }

/// METIS has a handler of its own for SIGTERM, which makes it give up, or hang or crash.
TEST(Ordering, HoldsWhereTheProgramIsToldToStop) {
  const auto lattice = test::make_spring_lattice(100, 100, 3.0);
  const auto undisturbed = order_by_particles(lattice.lower, lattice.groups);
  terminations = 0;
  const auto last_termination = std::signal(SIGTERM, SIG_DFL);
  const auto last_alarm = std::signal(SIGALRM, on_alarm);
  // Nearly all the time goes into METIS: one of these falls into it on any machine.
  int expected = 1;
  for (const int microseconds : {3'000, 10'000, 30'000, 100'000}) {
    std::signal(SIGTERM, on_termination);
    const itimerval once = {{0, 0}, {0, microseconds}};
    setitimer(ITIMER_REAL, &once, nullptr);
    EXPECT_EQ(order_by_particles(lattice.lower, lattice.groups), undisturbed);
    // The timer may run out after the ordering, and its signal come later still.
    for (int wait = 0; terminations < expected && wait < 5000; ++wait) usleep(1000);
    EXPECT_EQ(terminations, expected);
    ++expected;
  }
  std::signal(SIGALRM, last_alarm);
  std::signal(SIGTERM, last_termination);
}

}  // namespace
}  // namespace perilink
