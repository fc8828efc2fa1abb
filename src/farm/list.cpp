// One command per line, for make, xargs, GNU parallel, cuecmd, Deadline, Afanasy.
#include "farm/writers.h"

namespace petzval::farm {

Result<FarmFile> list_file(const FarmShot& shot) {
    std::string text;
    for (const std::string& frames : chunks(shot, shot.chunk))
        text += shell_word(shot.folder + "/run.sh") + " " + frames + "\n";
    return FarmFile{"commands", text};
}

}  // namespace petzval::farm
