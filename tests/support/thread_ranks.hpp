#pragma once

#include <algorithm>
#include <barrier>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "solver/ranks.hpp"

namespace perilink::test {

/// Ranks as threads of this process, without MPI.
class ThreadRanks final : public Ranks {
 public:
  /// State shared by the ranks.
  class World {
   public:
    explicit World(int size) : count(size), meeting(size), values(size) {}
    const int count;
    std::barrier<> meeting;
    std::vector<std::vector<double>> values;  // by rank, while sums are taken
    std::mutex mutex;
    std::condition_variable arrived;
    std::map<std::pair<int, int>, std::deque<std::vector<std::byte>>> mail;  // by from, to
  };

  ThreadRanks(World& world, int own) : world_(world), own_(own) {}
  int count() const override { return world_.count; }
  int own() const override { return own_; }

  void sum(std::span<double> values) override {
    world_.values[own_].assign(values.begin(), values.end());
    world_.meeting.arrive_and_wait();
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = 0.0;
      for (const std::vector<double>& part : world_.values) values[k] += part[k];
    }
    world_.meeting.arrive_and_wait();
  }

  void send(int to, std::span<const std::byte> message) override {
    const std::lock_guard lock(world_.mutex);
    world_.mail[{own_, to}].emplace_back(message.begin(), message.end());
    world_.arrived.notify_all();
  }

  std::vector<std::byte> receive(int from) override {
    std::unique_lock lock(world_.mutex);
    auto& box = world_.mail[{from, own_}];
    world_.arrived.wait(lock, [&] { return !box.empty(); });
    std::vector<std::byte> message = std::move(box.front());
    box.pop_front();
    return message;
  }

  void exchange(std::span<Exchange> with) override {
    for (const Exchange& each : with) send(each.rank, each.out.bytes());
    for (Exchange& each : with) each.in = Parcel(receive(each.rank));
  }

  [[noreturn]] void abandon(const std::string& reason) override {
    throw std::runtime_error(reason);
  }

 private:
  World& world_;
  int own_;
};

/// Calls lead(ranks) in this thread and serve(ranks) in the threads of the other ranks.
inline void with_thread_ranks(int count, const std::function<void(Ranks&)>& lead,
                              const std::function<void(Ranks&)>& serve) {
  ThreadRanks::World world(count);
  std::vector<std::jthread> others;
  for (int rank = 1; rank < count; ++rank) {
    others.emplace_back([&world, &serve, rank] {
      ThreadRanks ranks(world, rank);
      serve(ranks);
    });
  }
  ThreadRanks first(world, 0);
  lead(first);
}

/// Returns the largest difference between the results of several ranks and of one process, over the
/// largest number of the latter.
inline double difference_of(const std::vector<double>& alone, const std::vector<double>& shared) {
  double size = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < alone.size(); ++k) {
    size = std::max(size, std::abs(alone[k]));
    difference = std::max(difference, std::abs(alone[k] - shared[k]));
  }
  return difference / size;
}

}  // namespace perilink::test
