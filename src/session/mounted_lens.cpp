#include "session/mounted_lens.h"

#include "petzval/session.h"

#include "base/user_folder.h"
#include "kernel/lenses/make_lens.h"
#include "kernel/lenses/opened_lens.h"

#include <optional>
#include <set>

namespace petzval {

std::string default_kernel_cache_folder() {
    const std::string folder =
        user_folder("PETZVAL_KERNEL_CACHE", "XDG_CACHE_HOME", "/.cache", "/petzval/kernels");
    return folder == "off" ? "" : folder;
}

kernel::Mount mount_of(const FrameRequest& request) {
    return {request.rendered.camera, request.rendered.place.display_window.width(),
            request.rendered.place.display_window.height(), request.rendered.place.pixel_aspect};
}

Status open_lens(FrameRequest& request) {
    if (!request.lens) {
        auto lens = Lens::open(request.look.lens);
        if (!lens) return lens.error();
        request.lens = std::move(*lens);
    }
    request.look.lens = request.lens->choice();
    if (request.look.lens.distortion == 0) return Done{};
    const auto model = kernel::make_lens(*request.lens, mount_of(request));
    return model ? Status(Done{}) : model.error();
}

namespace {

using LensLevels = std::vector<std::unique_ptr<const kernel::LensModel>>;

// The lens as engines see it: distortion comes last, of discs and picture at once.
Lens before_distortion(const FrameRequest& request, std::optional<LightSpectrum> light = {}) {
    LensChoice straight = request.lens->choice();
    straight.distortion = 0;
    if (light) straight.light = *light;
    return request.lens->with(straight).value();  // which asks for less than what was granted
}

std::string key_of_kernels(const FrameRequest& request) {
    return kernel::lens_key(before_distortion(request), mount_of(request));
}

// The largest radius in cells of the last level is 4, fewer than any engine needs.
constexpr int kLevels = 13;

// The lens on the picture's pixels, and on coarser ones for engines that work at several resolutions.
// first_number: of its levels in `remembered`.
Result<LensLevels> lens_levels(const FrameRequest& request, const std::shared_ptr<kernel::KernelStore>& store,
                               const std::shared_ptr<kernel::RememberedKernels>& remembered, int first_number,
                               std::optional<LightSpectrum> light = {}) {
    auto levels = kernel::make_lens_levels(before_distortion(request, light), mount_of(request), kLevels);
    if (!levels) return levels;
    for (std::size_t i = 0; i < levels->size(); ++i) {
        auto& lens = (*levels)[i];
        if (store) lens = kernel::kept(std::move(lens), store, int(i));
        lens = kernel::remembered(std::move(lens), remembered, first_number + int(i));
    }
    return levels;
}

// Null if no kernels are kept. The reference engine asks for a new radius with every point of light.
std::shared_ptr<kernel::KernelStore> store_for(const FrameRequest& request) {
    if (request.kernel_cache_folder.empty() || request.look.engine == "reference") return nullptr;
    return std::make_shared<kernel::KernelStore>(request.kernel_cache_folder, key_of_kernels(request),
                                                 request.kernel_cache_bytes);
}

// Spectra of the given points, except the picture's.
std::set<LightSpectrum> spectra_of_points(const FrameRequest& request) {
    std::set<LightSpectrum> spectra;
    if (request.rendered.lights)
        for (const LightPoint& p : *request.rendered.lights)
            if (p.spectrum && *p.spectrum != request.lens->choice().light) spectra.insert(*p.spectrum);
    return spectra;
}

}  // namespace

Result<std::shared_ptr<MountedLens>> MountedLens::make(const FrameRequest& request, std::size_t most_bytes) {
    constexpr std::size_t kMostRemembered = std::size_t(256) << 20;
    auto mounted = std::make_shared<MountedLens>();
    mounted->store = store_for(request);
    mounted->rays = request.lens->contents().last_rays;
    mounted->remembered = std::make_shared<kernel::RememberedKernels>(std::min(most_bytes, kMostRemembered));
    auto levels = lens_levels(request, mounted->store, mounted->remembered, 0);
    if (!levels) return levels.error();
    mounted->levels = std::move(*levels);
    for (const LightSpectrum light : spectra_of_points(request)) {
        const int first_number = kLevels * (1 + int(mounted->lamps.size()));
        auto seen = lens_levels(request, nullptr, mounted->remembered, first_number, light);
        if (!seen) return seen.error();
        mounted->lamps.push_back({light, std::move(*seen)});
    }
    return mounted;
}

std::string MountedLens::key_of(const FrameRequest& request) {
    std::string key = key_of_kernels(request);
    if (key.empty()) return key;
    const Rect& display = request.rendered.place.display_window;
    for (const int n : {display.width(), display.height(), int(request.look.quality)})
        key += " " + std::to_string(n);
    for (const LightSpectrum light : spectra_of_points(request)) key += " lamp " + std::to_string(int(light));
    return key + " " + request.look.engine + " " + request.kernel_cache_folder;
}

}  // namespace petzval
