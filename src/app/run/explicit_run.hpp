#pragma once

#include <string>
#include <vector>

#include "app/run/run_kind.hpp"
#include "app/run/run_notes.hpp"
#include "app/run/run_warnings.hpp"

namespace perilink {

/// What explicit runs have in common, of bonds and of lattices.
class ExplicitRun : public RunKind {
 public:
  using RunKind::RunKind;
  Verdict verdict() override { return {result_.ending, result_.reason}; }
  std::vector<std::optional<std::string>> late_notes() const override {
    return {note_of_peaks(files().peaks())};
  }
  std::vector<std::string> doubts() const override;
  std::string outcome() const override;
  void tell(Summary& summary) const override;
  const ExplicitResult& result() const { return result_; }

 protected:
  virtual const RunFiles& files() const = 0;
  /// "3 broken bonds"
  virtual std::string cracks() const = 0;
  /// Adds what the particles of this kind of body went through.
  virtual void tell_cracks(Summary& summary) const = 0;
  /// Adds energies that only this kind of body has. \returns what they say in the line of energies
  virtual std::string tell_flow(Summary& /*summary*/) const { return ""; }
  virtual void tell_sizes(Summary& summary) const = 0;
  /// What doubts have to know: its longest side, whether pieces of it are held by nothing.
  virtual RunFacts facts() const = 0;

  /// Fills in what is known before the run.
  void plan_steps(const std::string& size, Index steps, double time_step, double critical);

  ExplicitResult result_;
  double fundamental_period_ = 0.0;  ///< 0: nothing asks for it [time]
};

}  // namespace perilink
