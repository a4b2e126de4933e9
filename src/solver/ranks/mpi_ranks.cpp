#include "solver/ranks/mpi_ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include "base/error.hpp"

namespace perilink {
namespace {

/// Messages are cut into pieces because MPI counts in int.
constexpr std::size_t largest_message = 1 << 30;

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    // Waiting ranks yield the processor unless the user sets the variable.
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    if (MPI_Init(nullptr, nullptr) != MPI_SUCCESS) throw SolverError("MPI does not start");
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    MPI_Comm_rank(MPI_COMM_WORLD, &own_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int count() const override { return count_; }
  int own() const override { return own_; }

  void sum(std::span<double> values) override {
    for (std::size_t first = 0; first < values.size(); first += INT_MAX) {
      const int part = static_cast<int>(std::min<std::size_t>(values.size() - first, INT_MAX));
      MPI_Allreduce(MPI_IN_PLACE, values.data() + first, part, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    }
  }

  void send(int to, std::span<const std::byte> message) override {
    const std::size_t size = message.size();
    MPI_Send(&size, sizeof(size), MPI_BYTE, to, 0, MPI_COMM_WORLD);
    for (std::size_t first = 0; first < size; first += largest_message) {
      const int part = static_cast<int>(std::min(size - first, largest_message));
      MPI_Send(message.data() + first, part, MPI_BYTE, to, 0, MPI_COMM_WORLD);
    }
  }

  std::vector<std::byte> receive(int from) override {
    std::size_t size = 0;
    wait_for(from);
    MPI_Recv(&size, sizeof(size), MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    std::vector<std::byte> message(size);
    for (std::size_t first = 0; first < size; first += largest_message) {
      const int part = static_cast<int>(std::min(size - first, largest_message));
      MPI_Recv(message.data() + first, part, MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
    return message;
  }

  void exchange(std::span<Exchange> with) override {
    constexpr int tag = 1;
    std::vector<MPI_Request> sent(with.size());
    for (std::size_t k = 0; k < with.size(); ++k) {
      const std::span<const std::byte> out = with[k].out.bytes();
      if (out.size() > INT_MAX) abandon("a message is larger than MPI can count");
      MPI_Isend(out.data(), static_cast<int>(out.size()), MPI_BYTE, with[k].rank, tag,
                MPI_COMM_WORLD, &sent[k]);
    }
    for (Exchange& each : with) {
      MPI_Status status;
      int size = 0;
      MPI_Probe(each.rank, tag, MPI_COMM_WORLD, &status);
      MPI_Get_count(&status, MPI_BYTE, &size);
      std::vector<std::byte> in(static_cast<std::size_t>(size));
      MPI_Recv(in.data(), size, MPI_BYTE, each.rank, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      each.in = Parcel(std::move(in));
    }
    MPI_Waitall(static_cast<int>(sent.size()), sent.data(), MPI_STATUSES_IGNORE);
  }

  [[noreturn]] void abandon(const std::string& reason) override {
    std::fprintf(stderr, "perilink: rank %d of %d: %s\n", own_, count_, reason.c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, 3);
    std::abort();
  }

 private:
  /// Sleeps between probes: MPI_Recv would use a whole processor while the root sets up for
  /// minutes.
  void wait_for(int from) const {
    using namespace std::chrono_literals;
    constexpr auto longest_nap = 2000us;
    auto nap = 0us;
    for (int has_come = 0;;) {
      MPI_Iprobe(from, 0, MPI_COMM_WORLD, &has_come, MPI_STATUS_IGNORE);
      if (has_come) return;
      std::this_thread::sleep_for(nap);
      nap = std::min(nap + 10us, longest_nap);
    }
  }

  int count_ = 1, own_ = 0;
};

}  // namespace

std::unique_ptr<Ranks> start_mpi_ranks() { return std::make_unique<MpiRanks>(); }

}  // namespace perilink
