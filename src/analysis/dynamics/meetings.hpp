#pragma once

#include <vector>

#include "base/parcel.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// What the first rank asks for in a meeting; no number is that of a Service.
enum class Wish : int { motion = 100, secants, fields, go_on, leave };

/// How ranks that share an explicit run meet every few steps: the first takes what the others have
/// found since they met last, may ask for more, and tells them whether to go on. Each has pieces of
/// the body (blocks or rows) which follow those of the ranks before it.
class Meetings {
 public:
  /// \param count  how many of the ranks take part, from the first one on
  Meetings(Ranks& ranks, int count) : ranks_(ranks), count_(count) {}

  /// Once in every step: reactions of supports [force], which the first rank looks at when they
  /// meet.
  /// \param held  own pieces in which something is held, ascending
  /// \param supports_of  gives the reaction of a piece
  template <class SupportsOf>
  void note_step(const std::vector<Index>& held, SupportsOf supports_of) {
    for (const Index piece : held) supports_.push_back(supports_of(piece));
    ++steps_;
  }

  /// Begins a meeting for the first rank, or comes after its last step.
  /// \param take  take(rank, parcel) reads what a rank has reported
  /// \return reactions of supports in each step since the last time, summed in the order of pieces
  ///         so that they are those of one process [force]
  template <class Take>
  std::vector<double> collect(Take take) {
    std::vector<double> supports(static_cast<std::size_t>(steps_), 0.0);
    add_supports(supports_, supports);
    for (int rank = 1; rank < count_; ++rank) {
      Parcel parcel(ranks_.receive(rank));
      std::vector<double> of_rank;
      parcel.get(of_rank);
      add_supports(of_rank, supports);
      take(rank, parcel);
    }
    forget_supports();
    return supports;
  }
  /// During a meeting: asks the others. \param take  take(rank, parcel) reads their answers
  template <class Take>
  void ask(Wish wish, Take take) {
    tell(wish);
    for (int rank = 1; rank < count_; ++rank) {
      Parcel answer(ranks_.receive(rank));
      take(rank, answer);
    }
  }
  /// Ends a meeting.
  void tell(bool goes_on) { tell(goes_on ? Wish::go_on : Wish::leave); }

  /// Begins a meeting for the others, or comes after their last step.
  /// \param add  add(parcel) puts in what the first rank takes
  template <class Add>
  void report(Add add) {
    Parcel parcel;
    parcel.put(supports_);
    forget_supports();
    add(parcel);
    ranks_.send(0, parcel.bytes());
  }
  /// \param answer  answer(wish, parcel) puts in what the first rank asks for
  /// \return whether the run goes on
  template <class Answer>
  bool obey(Answer answer) {
    for (;;) {
      const Wish wish = receive_wish();
      if (wish == Wish::go_on || wish == Wish::leave) return wish == Wish::go_on;
      Parcel parcel;
      answer(wish, parcel);
      ranks_.send(0, parcel.bytes());
    }
  }

  Ranks& ranks() const { return ranks_; }

 private:
  void tell(Wish wish);
  Wish receive_wish();
  static void add_supports(const std::vector<double>& of_rank, std::vector<double>& of_steps);
  void forget_supports();

  Ranks& ranks_;
  int count_;
  Index steps_ = 0;               ///< since they met last
  std::vector<double> supports_;  ///< in these, shape (steps, held pieces)
};

}  // namespace perilink
