#include "analysis/quasistatic/observer.hpp"

namespace perilink {

std::string to_string(Termination termination) {
  switch (termination) {
    case Termination::completed: return "completed";
    case Termination::collapsed: return "collapsed";
    case Termination::nothing_breaks: return "nothing_breaks";
    case Termination::interrupted: return "interrupted";
    case Termination::failed: return "failed";
  }
  return "unknown";
}

}  // namespace perilink
