// Ctrl-C, SIGTERM and SIGHUP: remembered, asked for between pieces of work, never acted on in the middle of a
// file.
#pragma once

namespace petzval::cli {

// A second signal removes what is half-written and ends the program at once. Also lets a write beyond a file
// size limit fail as an error instead of killing us.
void watch_for_interrupts();

// The number of the signal that asked us to stop, or 0.
int interrupted_by();

}  // namespace petzval::cli
