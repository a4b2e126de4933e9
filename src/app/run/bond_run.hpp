#pragma once

#include <filesystem>
#include <vector>

#include "analysis/dynamics/bonds/bond_analysis.hpp"
#include "app/run/explicit_run.hpp"
#include "base/csr.hpp"

namespace perilink {

/// What an explicit case of bonds adds to its model.
struct BondRunCase {
  Inertia inertia;
  BondRunRules rules;
  ExplicitOptions options;  ///< threads left at one
  Index steps = 0;
};

/// "3 broken bonds" or, of state-based particles, "3 cracked particles".
std::string cracks_text(const Model& model, const ExplicitRecord& record);

Strain strain_of(const AnalysisSection& analysis);

/// Masses and steps of a case with type = "explicit" whose body has bonds.
/// \throws InputError for a time step above the critical one, or too many steps
BondRunCase build_bond_run(const CaseFile& input, const Model& model);

/// Turns what happens in a run over time into files and progress: every row into the history, the
/// states at the times that the case asks for (and the first and the last) into field files, of a
/// dynamic relaxation those of all rows.
class BondObserver final : public BondRunObserver, public RunFiles {
 public:
  /// \param steps  in the whole run, for the progress
  BondObserver(const CaseFile& input, const Model& model, Index steps,
               std::filesystem::path directory, bool quiet);

  void on_row(const ExplicitRecord& record, const BondRunState& state) override;
  void on_end(const ExplicitRecord& last, const BondRunState& state) override;
  void on_iteration(Index load_step, Index iteration, double residual) override;
  bool stop_requested() override;

  /// Pieces of the broken body at the end that nothing holds.
  Index loose_pieces() const { return loose_pieces_; }

 private:
  void write_state(const ExplicitRecord& record, const BondRunState& state);

  const Model& model_;
  Index steps_;
  Csr families_;
  Index loose_pieces_ = 0;
};

/// A run with type = "explicit" of a body with bonds: they move instead of going from equilibrium
/// to equilibrium.
class BondRun final : public ExplicitRun {
 public:
  BondRun(const CaseFile& input, int threads, bool quiet);
  RunFiles& open(const std::filesystem::path& directory, bool quiet) override {
    return observer_.emplace(input_, model_, built_.steps, directory, quiet);
  }
  void analyse() override {
    result_ = run_explicit_bonds(model_, built_.inertia, built_.rules, built_.options, *observer_);
  }
  std::string rate() const override;
  const Model& model() const { return model_; }
  const BondRunCase& built() const { return built_; }

 protected:
  const RunFiles& files() const override { return *observer_; }
  std::string cracks() const override { return cracks_text(model_, result_.last); }
  void tell_cracks(Summary& summary) const override;
  void tell_sizes(Summary& summary) const override { tell_body(summary, model_); }
  RunFacts facts() const override;

 private:
  Model model_;
  BondRunCase built_;
  std::optional<BondObserver> observer_;
};

}  // namespace perilink
