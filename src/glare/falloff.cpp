// Light lost towards the corners. cos^4 of the field angle: the pupil seen from there is smaller (cos) and
// farther away (cos^2), and the sensor is lit aslant (cos). Times the share of the pupil that is open.
#include "petzval/glare.h"

#include "base/parallel.h"
#include "kernel/draw/pupil.h"
#include "kernel/lenses/opened_lens.h"
#include "optics/aberrations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace petzval {
namespace {

constexpr int kRings = 24;        // radii at which a prescription is traced
constexpr int kGridColumns = 64;  // the frame is lit on a grid this wide, and between linearly

// The open share of the pupil at a place of the field (-1…1 of the half diagonal, y up), 1 in the middle.
using Opening = std::function<double(kernel::FieldPosition)>;

Opening barrel(const LensChoice& lens, const FalloffSettings& settings) {
    const Rect& display = settings.place.display_window;
    const kernel::Pupil pupil(
        lens, {settings.camera, display.width(), display.height(), settings.place.pixel_aspect});
    constexpr double kTolerance = 1e-3;
    const double whole = std::abs(kernel::area(pupil.outline({0, 0}, kTolerance)));
    return [=](kernel::FieldPosition field) {
        return std::abs(kernel::area(pupil.outline(field, kTolerance))) / whole;
    };
}

// Rays past the rims, by distance from the middle; half_diagonal_mm on the sensor.
Result<Opening> rims(const optics::Prescription& lens, const FalloffSettings& settings,
                     double half_diagonal_mm) {
    const auto own = optics::first_order(lens, lens.primary_um);
    if (!own) return own.error();
    optics::LensSetting setting;
    const Camera& camera = settings.camera;
    setting.f_number = camera.f_number > own->f_number ? camera.f_number : 0;
    if (camera.focus_distance_m > 0) setting.focus_distance_mm = 1000 * camera.focus_distance_m;
    const auto traced = optics::TracedLens::make(
        optics::scaled(lens, camera.focal_length_mm / own->focal_length_mm), setting);
    if (!traced) return traced.error();
    std::vector<double> share;
    for (int i = 0; i <= kRings; ++i) {
        const double field_rad = std::atan(half_diagonal_mm * i / kRings / camera.focal_length_mm);
        const auto beam = traced->beam(lens.primary_um, field_rad);
        share.push_back(beam ? optics::unvignetted_share(*beam, 48) : 0);
    }
    const double middle = share.front();
    if (!(middle > 0)) return Error{ErrorCode::InvalidArgument, lens.name + ": no light reaches the middle"};
    return Opening([share, middle](kernel::FieldPosition field) {
        const double at = std::min(std::hypot(field.x, field.y), 1.0) * kRings;
        const std::size_t i = std::min(std::size_t(at), share.size() - 2);
        const double t = at - double(i);
        return ((1 - t) * share[i] + t * share[i + 1]) / middle;
    });
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

}  // namespace

Result<Picture> add_falloff(View<const Rgba> picture, const FalloffSettings& settings) {
    const Camera& camera = settings.camera;
    if (!is_positive(camera.focal_length_mm) || !is_positive(camera.sensor_width_mm))
        return Error{ErrorCode::InvalidArgument,
                     "light falloff needs a focal length and a sensor width: give camera.focal_length_mm and "
                     "camera.sensor_width_mm (mm)"};
    if (picture.empty()) return Error{ErrorCode::InvalidArgument, "the picture is empty"};
    const auto lens = settings.opened_lens ? Result<Lens>(*settings.opened_lens) : Lens::open(settings.lens);
    if (!lens) return lens.error();
    Rect display = settings.place.display_window, data = settings.place.data_window;
    if (display.empty()) display = data = picture.rect();
    const double half_width = 0.5 * display.width();
    const double half_height = 0.5 * display.height() / settings.place.pixel_aspect;  // in widths of a pixel
    const double half_diagonal = std::hypot(half_width, half_height);
    const double mm_per_px = camera.sensor_width_mm / display.width();

    Opening opening = barrel(lens->choice(), settings);
    if (const optics::Prescription* surfaces = kernel::prescription_of(*lens)) {
        auto traced = rims(*surfaces, settings, half_diagonal * mm_per_px);
        if (!traced) return traced.error();
        opening = [cats_eye = std::move(opening), traced = std::move(*traced)](kernel::FieldPosition field) {
            return cats_eye(field) * traced(field);
        };
    }
    const auto reaching = [&](double x, double y) {  // pixels from the display window's corner
        const double right = x - half_width;
        const double up = half_height - y / settings.place.pixel_aspect;
        const double tangent = std::hypot(right, up) * mm_per_px / camera.focal_length_mm;
        const double cos_squared = 1 / (1 + tangent * tangent);
        return cos_squared * cos_squared * opening({right / half_diagonal, up / half_diagonal});
    };

    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    // The grid stands on the display window: where the data window begins decides nothing.
    const double step = std::max(1.0, double(display.width()) / kGridColumns);
    const int left = data.x0 - display.x0, top = data.y0 - display.y0;
    const int first_column = int(std::floor((left + 0.5) / step));
    const int first_row = int(std::floor((top + 0.5) / step));
    Plane grid(int(picture.width() / step) + 3, int(picture.height() / step) + 3);
    parallel_for(grid.height(), *workers, [&](int j) {
        for (int i = 0; i < grid.width(); ++i)
            grid(i, j) = float(reaching((first_column + i) * step, (first_row + j) * step));
    });
    Picture out = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(out.height(), *workers, [&](int y) {
        const double gy = (top + y + 0.5) / step;
        const int row = int(std::floor(gy)), j = row - first_row;
        const float t = float(gy - row);
        for (int x = 0; x < out.width(); ++x) {
            const double gx = (left + x + 0.5) / step;
            const int column = int(std::floor(gx)), i = column - first_column;
            const float s = float(gx - column);
            const float share = (1 - t) * ((1 - s) * grid(i, j) + s * grid(i + 1, j)) +
                                t * ((1 - s) * grid(i, j + 1) + s * grid(i + 1, j + 1));
            const Rgba c = picture(x, y);
            out(x, y) = {share * c.r, share * c.g, share * c.b, c.a};
        }
    });
    return out;
}

}  // namespace petzval
