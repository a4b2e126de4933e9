#pragma once

#include "analysis/dynamics/bonds/runs/bond_analysis.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "app/run/run_kind.hpp"
#include "base/csr.hpp"
#include "model/face_overlap.hpp"
#include "model/symmetry_damage.hpp"

namespace perilink {

/// Inertia and options of an explicit case of bonds.
struct BondRunCase {
  Inertia inertia;
  BondRunRules rules;
  ExplicitOptions options;  ///< with one thread
};

/// Builds masses and time steps of a case with type = "explicit" and bonds.
/// \throws InputError for a time step above the critical one, or too many steps
BondRunCase build_bond_run(const CaseFile& input, const Model& model);

/// A run of bonds in motion. Every row goes into the history. Field files hold the first, the last
/// and the requested states; in a dynamic relaxation all states.
class MovingBondsRun : public NetworkRun, protected BondRunObserver {
 public:
  MovingBondsRun(const CaseFile& of_case, int on_threads, const RunCallbacks& calls);

 protected:
  void on_row(const ExplicitRecord& record, const BondRunState& state) override;
  void on_end(const ExplicitRecord& last, const BondRunState& state) override;
  void on_iteration(Index load_step, Index iteration, double residual) override;
  bool stop_requested() override;
  bool wants_checkpoint(const ExplicitRecord& last) override;
  void on_checkpoint(const TimeState& state) override;
  void restore(const std::string& state) override;
  /// Warns of faces of pre-cracks that overlap, of damage along planes of symmetry and, but for
  /// impacts, of displacements too large for small strains.
  void warn_of_motion(Summary& summary, bool impact) const;
  void write_state(const ExplicitRecord& record, const BondRunState& state);
  /// \param motion  motion of the state, with the embedded points of bars
  void add_forces_and_cracks(VtuGrid& grid, const ExplicitRecord& record, const BondRunState& state,
                             const std::vector<double>& motion);

  Index steps_ = 0;                            ///< in the whole run
  Index checkpoint_rows_ = 0;                  ///< rows between checkpoints; 0: none
  std::optional<TimeState> from_;              ///< state to go on from
  std::vector<GrownCrack> cracks_;             ///< in the last field file
  FaceOverlap overlap_;                        ///< at the end
  std::optional<SymmetryDamage> on_symmetry_;  ///< at the end
  Index loose_pieces_ = 0;                     ///< unsupported parts of the broken body at the end

 private:
  Csr neighbourhoods_;
};

}  // namespace perilink
