#include "analysis/quasistatic/observer.hpp"

namespace perilink {

std::string to_string(Ending ending) {
  switch (ending) {
    case Ending::completed: return "completed";
    case Ending::collapsed: return "collapsed";
    case Ending::nothing_breaks: return "nothing_breaks";
    case Ending::interrupted: return "interrupted";
    case Ending::failed: return "failed";
  }
  return "unknown";
}

}  // namespace perilink
