#pragma once

#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/run/quasistatic_run.hpp"

namespace perilink {

/// The elastic equilibrium of a body at load factor 1.
struct ElasticAnswer {
  Ending ending = Ending::completed;
  std::string reason;
  ElasticResult solution;
  StepRecord row;  ///< of its history
  PeakWatch peaks;

  Equilibria found() const;
};

/// \throws SolverError when the stiffness matrix is not positive definite
ElasticAnswer solve_elastic(const Model& model, int threads);

/// A run with type = "elastic".
class ElasticRun final : public QuasistaticRun {
 public:
  using QuasistaticRun::QuasistaticRun;
  RunFiles& open(const std::filesystem::path& directory, bool quiet) override {
    return files_.emplace(input_, directory, quiet);
  }
  void analyse() override;
  Verdict verdict() override { return {answer_.ending, answer_.reason}; }
  const ElasticAnswer& answer() const { return answer_; }

 protected:
  Equilibria found() const override { return answer_.found(); }
  const std::vector<PlaceForce>& places() const override { return places_; }

 private:
  ElasticAnswer answer_;
  std::vector<PlaceForce> places_;
  std::optional<RunFiles> files_;
};

}  // namespace perilink
