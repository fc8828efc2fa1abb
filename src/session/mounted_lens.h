// A lens on a camera, for pictures of one size and quality: its levels, and the kernels that an engine made
// of it.
#pragma once

#include "device/memory.h"
#include "engine/waist/engine.h"
#include "kernel/keep/kernel_store.h"
#include "kernel/keep/remembered_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "kernel/model/lens_model.h"
#include "session/request.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace petzval {

kernel::Mount mount_of(const FrameRequest& request);

// Opens the lens of a request that brings none. Errors: those of Lens::open(); a distortion that this lens
// cannot have.
Status open_lens(FrameRequest& request);

// Requests here have their lens opened.
struct MountedLens {
    // On the picture's pixels and coarser ones, for engines that work at several resolutions. most_bytes: of
    // the lens's own kernels that it remembers, during a frame too. Errors: those of the lens.
    static Result<std::shared_ptr<MountedLens>> make(const FrameRequest& request, std::size_t most_bytes);
    // Key of everything that decides an engine's kernels; empty if unknown.
    static std::string key_of(const FrameRequest& request);

    std::shared_ptr<kernel::KernelStore> store;  // on disk; null: none
    std::vector<std::unique_ptr<const kernel::LensModel>> levels;
    // The same for the light of given points that says what it is made of; each once.
    std::vector<engine::LampLens> lamps;
    device::Memory kernels{
        std::numeric_limits<std::size_t>::max()};           // of `levels`, and what engines know of them
    std::shared_ptr<kernel::RememberedKernels> remembered;  // of `levels` and `lamps`, before they are cut

    // Rays of the opened lens, for all cameras that it was used with.
    std::shared_ptr<kernel::LastRays> rays;

    // Kernels that are kept between frames.
    std::size_t bytes() const { return kernels.bytes() + remembered->bytes(); }
    // Those of `kernels` stay longest: drawing asks for them first.
    void trim(std::size_t bytes) {
        kernels.trim(bytes);
        remembered->trim(bytes - std::min(bytes, kernels.bytes()));
    }
};

}  // namespace petzval
