// Contents of a Lens.
#pragma once

#include "petzval/lens.h"

#include "kernel/lenses/geometric_lens.h"
#include "kernel/model/lens_model.h"
#include "lens_files/lens_file.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace petzval {

namespace kernel {
// The last camera that a lens was mounted on; see model_on().
struct LastMount {
    std::mutex mutex;
    Mount mount;
    std::shared_ptr<const LensModel> model;
};
// The rays that were traced last through a lens, with any choice; the newest are last.
struct LastRays {
    struct Traced {
        Mount mount;
        std::shared_ptr<const GeometricLens> model;
    };
    static constexpr std::size_t kMost = 12;  // cameras; a strip of discs has one for each disc behind focus
    std::mutex mutex;
    std::vector<Traced> traced;

    std::size_t bytes();  // of all traced rays
    // Forgets the oldest until at most so many bytes are left.
    void trim(std::size_t most_bytes);
};
}  // namespace kernel

struct Lens::Contents {
    LensChoice choice;
    LensModelKind kind = LensModelKind::Ideal;
    // Shared by all that were opened from this one. Of lenses that ship as curves, and of the ideal one,
    // whose curves are straight, it holds the curves alone.
    std::shared_ptr<const lens_files::LensFile> file;
    std::string key;
    std::shared_ptr<kernel::LastMount> last_mount;  // never null; of this choice alone
    std::shared_ptr<kernel::LastRays> last_rays =
        std::make_shared<kernel::LastRays>();  // shared as the file is
};

namespace kernel {

// Null for lenses that are drawn.
const optics::Prescription* prescription_of(const Lens& lens);
// Null for lenses with surfaces.
const optics::AberrationCurves* curves_of(const Lens& lens);

// A key of everything that decides the kernels of a lens on a camera: the lens, the properties of the camera
// and of the picture's size that matter to it, and the program's build. Empty if the build has no id.
std::string lens_key(const Lens& lens, const Mount& mount);

}  // namespace kernel
}  // namespace petzval
