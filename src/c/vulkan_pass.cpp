// The pass for real time behind its C door.
#include "petzval/vulkan.h"

#include "c/handles.h"
#include "c/lent.h"
#include "device/vulkan/realtime/host_pass.h"
#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

struct petzval_pass {
    std::unique_ptr<petzval::device::vulkan::HostPass> host;
    // Its lens, which another size needs made anew: what diffracts or has surfaces has its shape from the
    // size of pixels.
    petzval::Lens lens;
    petzval::Camera camera;
    petzval::Quality quality = petzval::Quality::Standard;
    std::mutex mutex = {};  // of the lens, its camera, the quality and the size
};

namespace {

using namespace petzval;
using c::fail;
using c::guarded;
using c::missing;
using device::vulkan::HostPass;
using device::vulkan::RealtimeImages;
using device::vulkan::RealtimeResult;
using device::vulkan::RealtimeSettings;

Status check_size(std::uint32_t width, std::uint32_t height) {
    if (width >= 1 && height >= 1 && width <= 16384 && height <= 16384) return Done{};
    return Error{ErrorCode::InvalidArgument, "settings.width and height must be 1 to 16384 pixels, not " +
                                                 std::to_string(width) + " x " + std::to_string(height)};
}

Result<RealtimeSettings> settings_of(const petzval_pass_settings& given) {
    if (!given.get_instance_proc_addr || !given.instance || !given.physical_device || !given.device)
        return Error{ErrorCode::InvalidArgument,
                     "settings needs get_instance_proc_addr, instance, physical_device and device"};
    if (const Status size = check_size(given.width, given.height); !size) return size.error();
    RealtimeSettings settings;
    settings.width = given.width, settings.height = given.height;
    settings.slots = given.frames_in_flight == 0 ? 2 : given.frames_in_flight;
    if (settings.slots > 16)
        return Error{ErrorCode::InvalidArgument, "settings.frames_in_flight must be at most 16"};
    switch (given.result_format) {
        case VK_FORMAT_UNDEFINED:
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            settings.result = RealtimeResult::Half;
            break;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            settings.result = RealtimeResult::Float;
            break;
        case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
            settings.result = RealtimeResult::Packed;
            break;
        default:
            return Error{ErrorCode::InvalidArgument,
                         "settings.result_format must be R16G16B16A16_SFLOAT, R32G32B32A32_SFLOAT or "
                         "B10G11R11_UFLOAT_PACK32"};
    }
    settings.cache = given.pipeline_cache;
    settings.is_timed = given.measures_times != 0;
    settings.blurs_layers = given.blurs_layers != 0;
    settings.lent = {given.memory, given.memory_offset, given.memory_offset + given.memory_size};
    return settings;
}

petzval_status set_lens(petzval_pass& pass, const Lens& lens, const Camera& camera, Quality quality) {
    const std::lock_guard lock(pass.mutex);
    const RealtimeSettings& settings = pass.host->settings();
    const auto mounted = kernel::make_lens(lens, {camera, int(settings.width), int(settings.height)});
    if (!mounted) return fail(mounted.error());
    if (const Status done = pass.host->set_lens(**mounted, quality); !done) return fail(done.error());
    pass.lens = lens, pass.camera = camera, pass.quality = quality;
    return PETZVAL_OK;
}

petzval_status resize(petzval_pass& pass, std::uint32_t width, std::uint32_t height) {
    if (const Status size = check_size(width, height); !size) return fail(size.error());
    const std::lock_guard lock(pass.mutex);
    const auto mounted = kernel::make_lens(pass.lens, {pass.camera, int(width), int(height)});
    if (!mounted) return fail(mounted.error());
    const Status done = pass.host->resize(width, height, **mounted, pass.quality);
    return done ? PETZVAL_OK : fail(done.error());
}

RealtimeImages::Input input_of(const petzval_pass_image& given) {
    RealtimeImages::Input input;
    input.view = given.view;
    if (given.layout != VK_IMAGE_LAYOUT_UNDEFINED) input.layout = given.layout;
    return input;
}

petzval_status record(HostPass& host, const petzval_pass_frame& f) {
    if (!f.commands) return missing("frame.commands");
    if (!f.colour.view || !f.depth.view || !f.result)
        return fail(PETZVAL_INVALID_ARGUMENT, "frame needs colour, depth and result");
    if (!f.camera) return missing("frame.camera");
    if (f.layer_depth.view && !host.settings().blurs_layers)
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.layer_depth needs settings.blurs_layers");
    if (f.layer_depth.view && !f.layer.view)
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.layer_depth needs a layer");
    if (f.view < PETZVAL_PASS_PICTURE || f.view > PETZVAL_PASS_TILES)
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.view must be 0 to 5");
    if (f.slot >= host.settings().slots)
        return fail(PETZVAL_INVALID_ARGUMENT,
                    "frame.slot must be below frames_in_flight, " + std::to_string(host.settings().slots));
    const RealtimeSettings& opened = host.settings();
    const bool is_part = f.width != 0 || f.height != 0;
    if (is_part && (f.width == 0 || f.height == 0 || f.width > opened.width || f.height > opened.height))
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.width and height must be 1 to " +
                                                  std::to_string(opened.width) + " x " +
                                                  std::to_string(opened.height) + ", or both 0");
    const std::uint32_t width = is_part ? f.width : opened.width;
    const double aspect = f.pixel_aspect == 0 ? 1 : f.pixel_aspect;
    const double most_px = f.largest_radius_px == 0 ? double(width) / 20 : f.largest_radius_px;
    if (const Status ok = check(Place::whole({0, 0, 1, 1}, aspect)); !ok) return fail(ok.error());
    constexpr double kMostPx = 16384;
    if (!(most_px > 0 && most_px <= kMostPx))
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.largest_radius_px must be 0 to 16384");
    const auto optics = device::vulkan::optics_of(c::camera_of(c::taken(f.camera)), int(width),
                                                  {f.depth_scale, f.depth_bias}, most_px, aspect);
    if (!optics) return fail(optics.error());
    if (!(f.exposure >= 0 && f.exposure <= 1e6))
        return fail(PETZVAL_INVALID_ARGUMENT, "frame.exposure must be 0 to 1e6");
    const float exposure = f.exposure == 0 ? 1.0f : float(f.exposure);
    const std::uint32_t height = is_part ? f.height : opened.height;
    const RealtimeImages images{input_of(f.colour),
                                input_of(f.depth),
                                input_of(f.layer),
                                input_of(f.layer_depth),
                                f.result,
                                f.width,
                                f.height,
                                exposure,
                                device::vulkan::RealtimeField::whole(width, height),
                                device::vulkan::RealtimeView(f.view)};
    host.pass().record(f.commands, f.slot, images, *optics);
    return PETZVAL_OK;
}

}  // namespace

petzval_status petzval_pass_open(const petzval_pass_settings* given, petzval_pass** pass) {
    if (!pass) return missing("pass");
    *pass = nullptr;
    if (!given) return missing("settings");
    return guarded([&] {
        const petzval_pass_settings s = c::taken(given);
        const auto settings = settings_of(s);
        if (!settings) return fail(settings.error());
        auto host =
            HostPass::open({s.get_instance_proc_addr, s.instance, s.physical_device, s.device}, *settings);
        if (!host) return fail(host.error());
        const Camera camera{50, 36, 2, 2};
        const auto lens = Lens::open({});
        if (!lens) return fail(lens.error());
        std::unique_ptr<petzval_pass> made(new petzval_pass{std::move(*host), *lens, camera});
        const petzval_status status = set_lens(*made, *lens, camera, Quality::Standard);
        if (status == PETZVAL_OK) *pass = made.release();
        return status;
    });
}

petzval_status petzval_pass_needs(const petzval_pass_settings* given, VkMemoryRequirements* needed) {
    if (!given) return missing("settings");
    if (!needed) return missing("needed");
    return guarded([&] {
        const petzval_pass_settings s = c::taken(given);
        const auto settings = settings_of(s);
        if (!settings) return fail(settings.error());
        const auto found =
            HostPass::needs({s.get_instance_proc_addr, s.instance, s.physical_device, s.device}, *settings);
        if (!found) return fail(found.error());
        *needed = *found;
        return PETZVAL_OK;
    });
}

petzval_status petzval_pass_resize(petzval_pass* pass, uint32_t width, uint32_t height) {
    if (!pass) return missing("pass");
    return guarded([&] { return resize(*pass, width, height); });
}

void petzval_pass_close(petzval_pass* pass) { delete pass; }

petzval_status petzval_pass_set_lens(petzval_pass* pass, const petzval_look* look,
                                     const petzval_camera* camera) {
    if (!pass) return missing("pass");
    if (!look) return missing("look");
    if (!camera) return missing("camera");
    return guarded([&] {
        if (const Status ok = c::check_pictures(look->look); !ok) return fail(ok.error());
        const auto lens = c::lens_of(*look);
        if (!lens) return fail(lens.error());
        return set_lens(*pass, *lens, c::camera_of(c::taken(camera)), look->look.quality);
    });
}

petzval_status petzval_pass_record(petzval_pass* pass, const petzval_pass_frame* frame) {
    if (!pass) return missing("pass");
    if (!frame) return missing("frame");
    return guarded([&] { return record(*pass->host, c::taken(frame)); });
}

petzval_status petzval_pass_times(const petzval_pass* pass, uint32_t slot, double* milliseconds) {
    if (!pass) return missing("pass");
    if (!milliseconds) return missing("milliseconds");
    return guarded([&] {
        const RealtimeSettings& settings = pass->host->settings();
        if (!settings.is_timed)
            return fail(PETZVAL_INVALID_ARGUMENT, "the pass was opened without settings.measures_times");
        if (slot >= settings.slots)
            return fail(PETZVAL_INVALID_ARGUMENT,
                        "slot must be below frames_in_flight, " + std::to_string(settings.slots));
        const auto times = pass->host->times_ms(slot);
        if (!times) return fail(times.error());
        std::copy(times->begin(), times->end(), milliseconds);
        return PETZVAL_OK;
    });
}
