#pragma once

#include <filesystem>

#include "app/model/from_case/lattice_case.hpp"
#include "app/run/explicit_run.hpp"

namespace perilink {

/// Turns what happens in an explicit run of a lattice into files and progress: every row into the
/// history, the states at the times that the case asks for (and the first and the last) into field
/// files.
class LatticeObserver final : public ExplicitObserver, public RunFiles {
 public:
  LatticeObserver(const CaseFile& input, const ExplicitCase& built, std::filesystem::path directory,
                  bool quiet)
      : RunFiles(input, std::move(directory), quiet), built_(built) {}

  void on_row(const ExplicitRecord& record, const ExplicitState& state) override;
  void on_end(const ExplicitRecord& last, const ExplicitState& state) override {
    write_state(last, state);
  }
  bool stop_requested() override;

 private:
  void write_state(const ExplicitRecord& record, const ExplicitState& state);

  const ExplicitCase& built_;
};

/// A run with type = "explicit" of a body with model = "lattice".
class LatticeRun final : public ExplicitRun {
 public:
  LatticeRun(const CaseFile& input, int threads);
  RunFiles& open(const std::filesystem::path& directory, bool quiet) override {
    return observer_.emplace(input_, built_, directory, quiet);
  }
  void analyse() override;
  std::string rate() const override;
  const ExplicitCase& built() const { return built_; }

 protected:
  const RunFiles& files() const override { return *observer_; }
  std::string cracks() const override;
  void tell_cracks(Summary& summary) const override;
  std::string tell_flow(Summary& summary) const override;
  void tell_sizes(Summary& summary) const override;
  RunFacts facts() const override;

 private:
  double particle_steps() const;

  ExplicitCase built_;
  std::optional<LatticeObserver> observer_;
};

}  // namespace perilink
