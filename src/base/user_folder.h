// Folders that belong to the user who runs the program.
#pragma once

#include <cstdlib>
#include <string>

namespace petzval {

// $own_variable; otherwise `below` in $xdg_variable, if that is absolute, as the XDG base directory
// specification has it; otherwise `below` in `usual` in the home folder. Empty without a home folder.
inline std::string user_folder(const char* own_variable, const char* xdg_variable, const std::string& usual,
                               const std::string& below) {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string own = variable(own_variable); !own.empty()) return own;
    if (const std::string xdg = variable(xdg_variable); !xdg.empty() && xdg[0] == '/') return xdg + below;
    const std::string home = variable("HOME");
    return home.empty() ? "" : home + usual + below;
}

}  // namespace petzval
