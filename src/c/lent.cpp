#include "c/lent.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace petzval::c {
namespace {

constexpr int kLargestSide = 1 << 20;  // pixels; keeps sizes and addresses far from overflow

Status check_size(int width, int height, const char* name) {
    if (width > 0 && height > 0 && width <= kLargestSide && height <= kLargestSide) return Done{};
    return refused(std::string(name) + " is " + std::to_string(width) + "x" + std::to_string(height) +
                   " pixels; each side must be 1 to " + std::to_string(kLargestSide));
}

SampleType type_of(petzval_sample sample) {
    return sample == PETZVAL_HALF ? SampleType::Half : SampleType::Float;
}

// Checks the strides of a host's pixels.
Status check_layout(int width, int height, petzval_sample sample, std::ptrdiff_t pixel_stride,
                    std::ptrdiff_t row_stride, const char* name) {
    if (sample != PETZVAL_FLOAT && sample != PETZVAL_HALF)
        return refused(std::string(name) + ": sample is neither PETZVAL_FLOAT nor PETZVAL_HALF");
    constexpr std::int64_t kFarthest = std::int64_t(1) << 40;  // times a side it is still an address
    const std::ptrdiff_t least = sample == PETZVAL_HALF ? 2 : 4;
    struct Stride {
        const char* called;
        std::ptrdiff_t bytes;
        int count;
    };
    for (const auto& [called, bytes, count] :
         {Stride{"pixel_stride", pixel_stride, width}, Stride{"row_stride", row_stride, height}})
        if (count > 1 && (bytes > kFarthest || bytes < -kFarthest || (bytes < least && bytes > -least)))
            return refused(std::string(name) + ": " + called + " is " + std::to_string(bytes) +
                           " bytes; samples of " + std::to_string(least) +
                           " bytes need at least that distance");
    return Done{};
}

// A host's functions behind our interface.
class LentWorkers final : public Workers {
public:
    explicit LentWorkers(const petzval_workers& lent)
        : lent_(lent), width_(std::max(1, lent.width(lent.host))) {}
    int width() const override { return width_; }
    void run(int count, FunctionRef<void(int)> body) override {
        lent_.run(
            lent_.host, count,
            [](void* context, int index) { (*static_cast<FunctionRef<void(int)>*>(context))(index); }, &body);
    }

private:
    petzval_workers lent_;
    int width_;
};

}  // namespace

Camera camera_of(const petzval_camera& c) {
    return {.focal_length_mm = c.focal_length_mm,
            .sensor_width_mm = c.sensor_width_mm,
            .f_number = c.f_number,
            .focus_distance_m = c.focus_distance_m,
            .image_scale = c.thin_lens != 0 ? ImageScale::ThinLens : ImageScale::Rendered};
}

Result<std::shared_ptr<Workers>> workers_of(const petzval_workers* given) {
    if (!given) return std::shared_ptr<Workers>();
    const petzval_workers lent = taken(given);
    if (!lent.width || !lent.run) return refused("workers: width or run is null");
    return std::shared_ptr<Workers>(std::make_shared<LentWorkers>(lent));
}

Result<SessionSettings> session_settings_of(const petzval_session_settings* given) {
    constexpr int kMostThreads = 1024;
    const petzval_session_settings s = taken(given);
    if (s.threads < 0 || s.threads > kMostThreads)
        return Error{ErrorCode::InvalidArgument, "session.threads is " + std::to_string(s.threads) +
                                                     "; it must be 0 (all) to " +
                                                     std::to_string(kMostThreads)};
    SessionSettings settings;
    settings.threads = s.threads;
    settings.max_memory_bytes = std::size_t(s.max_memory_bytes);
    if (s.kernel_folder) settings.kernel_cache_folder = s.kernel_folder;
    if (s.device) settings.device = s.device;
    auto workers = workers_of(s.workers);
    if (!workers) return workers.error();
    settings.workers = std::move(*workers);
    return settings;
}

Result<ColourView> colour_view(const petzval_pixels* given, const char* name) {
    if (!given) return refused(std::string(name) + " is null");
    const petzval_pixels p = taken(given);
    if (Status ok = check_size(p.width, p.height, name); !ok) return ok.error();
    if (!p.r || !p.g || !p.b) return refused(std::string(name) + ": r, g or b is null");
    if (Status ok = check_layout(p.width, p.height, p.sample, p.pixel_stride, p.row_stride, name); !ok)
        return ok.error();
    ColourView view{p.width, p.height, {}};
    void* const bases[4] = {p.r, p.g, p.b, p.a};
    for (std::size_t c = 0; c < 4; ++c)
        view.channels[c] = {type_of(p.sample), static_cast<std::byte*>(bases[c]), p.pixel_stride,
                            p.row_stride};
    return view;
}

Status check_plane(const petzval_plane* given, int width, int height, const char* name) {
    const petzval_plane p = taken(given);
    if (!p.data) return refused(std::string(name) + ": data is null");
    if (p.width == width && p.height == height)
        return check_layout(width, height, p.sample, p.pixel_stride, p.row_stride, name);
    return refused(std::string(name) + " is " + std::to_string(p.width) + "x" + std::to_string(p.height) +
                   " and colour " + std::to_string(width) + "x" + std::to_string(height) +
                   "; they must have the same size");
}

Plane read_plane(const petzval_plane* given) {
    const petzval_plane plane = taken(given);
    Plane read = Plane::uninitialised(plane.width, plane.height);
    read_pixels(PlaneView{type_of(plane.sample), static_cast<std::byte*>(plane.data), plane.pixel_stride,
                          plane.row_stride},
                read);
    return read;
}

}  // namespace petzval::c
