#pragma once

namespace perilink {

/// Makes Ctrl-C and SIGTERM ask the run to stop at its next event. A second signal ends the program
/// at once.
void catch_stop_signals();
bool stop_signal_received();

}  // namespace perilink
