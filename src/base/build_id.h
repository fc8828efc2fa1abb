// An id of the linked program: different programs have different ids.
#pragma once

#include <string>

namespace petzval {

// The linker's build id of the program or library that holds this code, as bytes; empty if it has none
// or the system is not Linux.
std::string build_id();

}  // namespace petzval
