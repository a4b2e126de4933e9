#pragma once

namespace perilink {

/// Makes Ctrl-C, SIGTERM and SIGHUP (a closed terminal) stop the run at its next event; ignored
/// signals stay ignored. A second Ctrl-C or SIGTERM ends the program at once. A closed output pipe
/// does not end it. Must be called before the first output.
void catch_stop_signals();
bool stop_signal_received();

}  // namespace perilink
