// Files that were opened, the last first, kept between windows.
#pragma once

#include <string>
#include <vector>

namespace petzval::view {

// In $XDG_STATE_HOME/petzval/recent, otherwise ~/.local/state/petzval/recent. Unreadable: none.
std::vector<std::string> recent_files();
// Puts the file first. A list that cannot be written stays as it is.
void note_recent(const std::string& path);

}  // namespace petzval::view
