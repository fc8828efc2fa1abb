// From a name to a lens: the registry.
#include "kernel/ideal_lens.h"
#include "kernel/lens_model.h"

namespace petzval::kernel {

Result<std::unique_ptr<const LensModel>> make_lens(const LensChoice& choice, const Mount& mount) {
    if (const Status status = check_aperture(choice); !status) return status.error();
    if (choice.name == "ideal") {
        std::unique_ptr<const LensModel> lens = std::make_unique<IdealLens>(choice, mount);
        return lens;
    }
    return Error{ErrorCode::InvalidArgument, "unknown lens \"" + choice.name + "\"; known lenses: ideal"};
}

}  // namespace petzval::kernel
