#pragma once

#include <filesystem>

#include "analysis/dynamics/bonds/dynamic_relaxation.hpp"
#include "app/run/bond_run.hpp"

namespace perilink {

/// Options of a case with type = "relaxation".
RelaxationOptions relaxation_options(const CaseFile& input, int threads);

/// About as many iterations as the first load step takes: until the slowest vibration, damped
/// critically, has decayed to the tolerance.
double expected_iterations(const Model& model, const RelaxationOptions& options);

/// A run with type = "relaxation": bonds that are brought to rest.
class RelaxationRun final : public RunKind {
 public:
  RelaxationRun(const CaseFile& input, int threads, bool quiet);
  RunFiles& open(const std::filesystem::path& directory, bool quiet) override;
  void analyse() override {
    result_ = run_dynamic_relaxation(model_, relaxation_options(input_, threads_), *observer_);
  }
  Verdict verdict() override { return {result_.ending, result_.reason}; }
  std::vector<std::optional<std::string>> late_notes() const override {
    return {note_of_peaks(observer_->peaks())};
  }
  std::string outcome() const override;
  void tell(Summary& summary) const override;
  std::string rate() const override;
  const Model& model() const { return model_; }
  const RelaxationResult& result() const { return result_; }

 private:
  Model model_;
  std::optional<BondObserver> observer_;
  RelaxationResult result_;
};

}  // namespace perilink
