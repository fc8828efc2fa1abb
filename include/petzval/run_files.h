// The guard of a run: every file that it reads and writes, known before the work begins. Component
// petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

class PETZVAL_API RunFiles {
public:
    // A name with a place for a frame number (frames.h) is every file of that pattern that is there: a frame
    // may be read as a neighbour of another. A name that is not a file, as that of a lens, guards nothing.
    void reads(const std::string& path);
    // Empty names are passed over, and so are names with a place for a frame number: each frame's own name
    // is added once the frames are known.
    void writes(const std::string& path);

    // check_outputs() of all of them. Errors: as there; InvalidFile for a folder of inputs that cannot be
    // listed.
    Status check() const;

private:
    std::vector<std::string> read_, written_;
};

}  // namespace petzval
