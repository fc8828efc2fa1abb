// Unfinished files: their names, their owners, and the removal of leftovers.
#pragma once

#include <string>

namespace petzval {

// ".NAME.PID-N.unfinished", a new one at each call.
std::string unfinished_name(const std::string& name);

// Marks an open file as being written, until it is closed: a lock, which ends with its process on whatever
// machine that runs. False: someone took the file for a leftover meanwhile; another name is needed.
bool claim_unfinished(int descriptor);

// Removes files of this user in the folder that nobody writes any more. Each folder once a process.
void remove_leftovers(const std::string& folder);

}  // namespace petzval
