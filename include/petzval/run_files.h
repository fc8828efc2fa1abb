// All files that a run reads and writes, checked before the work begins. Component
// petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

class PETZVAL_API RunFiles {
public:
    // A name with a frame number (frames.h) stands for every existing file of that pattern, because a frame
    // may be read as a neighbour of another. A name that is not a file, such as a lens, is ignored.
    void reads(const std::string& path);
    // Empty names and names with a frame number are ignored: each frame's own name is added once the frames
    // are known.
    void writes(const std::string& path);

    // check_outputs() of all of them. Errors: as there; InvalidFile for a folder of inputs that cannot be
    // listed.
    Status check() const;

private:
    std::vector<std::string> read_, written_;
};

}  // namespace petzval
