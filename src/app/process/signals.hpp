#pragma once

namespace perilink {

/// Makes Ctrl-C, SIGTERM and SIGHUP (a terminal that is closed) ask the run to stop at its next
/// event; those that are ignored stay so. A second Ctrl-C or SIGTERM ends the program at once.
/// Output that nobody reads any more ends nothing. To be called before anything is printed on
/// standard output.
void catch_stop_signals();
bool stop_signal_received();

}  // namespace perilink
