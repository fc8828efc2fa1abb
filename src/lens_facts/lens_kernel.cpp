#include "petzval/lens_kernel.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "kernel/lenses/aberration_curves.h"
#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/make_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "optics/paraxial.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace {

using Model = std::shared_ptr<const kernel::LensModel>;

Error refuse(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

Result<Model> mounted(const Lens& lens, const LensMount& mount) {
    if (mount.width_px <= 0 || mount.height_px <= 0 ||
        !(mount.pixel_aspect > 0.01 && mount.pixel_aspect < 100))
        return refuse("the picture's width, height and pixel aspect must be above 0");
    return kernel::model_on(lens, {mount.camera, mount.width_px, mount.height_px, mount.pixel_aspect});
}

constexpr int kBorderPx = 2;  // pixels that a disc touches beyond its farthest ray

Status check_radius(const kernel::LensModel& lens, double coc_radius_px) {
    if (!std::isfinite(coc_radius_px)) return refuse("disc.coc_radius_px must be a finite number of pixels");
    if (!(2 * lens.reach_px(coc_radius_px) < kLargestDiscPx))
        return refuse("disc.coc_radius_px: this disc would be wider than " + std::to_string(kLargestDiscPx) +
                      " pixels");
    return Done{};
}

// The kernel in the middle of a square of `size` pixels; what does not fit is left out.
Picture centred(const kernel::PointSpread& spread, int size) {
    Picture picture(size, size);
    const Rect e = spread.extent;
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x)
            if (picture.rect().contains(x + size / 2, y + size / 2))
                picture(x + size / 2, y + size / 2) = spread.weights(x - e.x0, y - e.y0);
    return picture;
}

// Largest values of columns, averaged with their neighbours': thin rims flicker against the rows.
std::vector<float> brightest_smoothed(const std::vector<std::vector<Rgba>>& profiles) {
    constexpr int kHalf = 6;
    const int count = int(profiles.size());
    std::vector<float> brightest, smooth;
    for (const auto& profile : profiles) {
        float most = 0;
        for (const Rgba& w : profile) most = std::max({most, w.r, w.g, w.b});
        brightest.push_back(most);
    }
    for (int i = 0; i < count; ++i) {
        // Geometric mean, weighted by a triangle: brightness runs over decades near focus.
        double sum = 0, weights = 0;
        for (int k = std::max(0, i - kHalf); k <= std::min(count - 1, i + kHalf); ++k) {
            const double weight = kHalf + 1 - std::abs(k - i);
            sum += weight * std::log(double(brightest[std::size_t(k)]) + 1e-30), weights += weight;
        }
        smooth.push_back(float(std::exp(sum / weights)));
    }
    return smooth;
}

void fill(BokehTexture& texture, const std::vector<std::vector<Rgba>>& profiles) {
    std::size_t rows = 1;
    for (const auto& profile : profiles) rows = std::max(rows, profile.size());
    texture.energy = Picture(int(profiles.size()), int(rows));
    texture.view = Picture(int(profiles.size()), int(rows));
    const std::vector<float> brightest = brightest_smoothed(profiles);
    for (std::size_t i = 0; i < profiles.size(); ++i)
        for (std::size_t v = 0; v < profiles[i].size(); ++v) {
            texture.energy(int(i), int(v)) = profiles[i][v];
            texture.view(int(i), int(v)) = (1 / brightest[i]) * profiles[i][v];
        }
}

// Pixels of the kernel on the axis, from the source's own to the right.
std::vector<Rgba> axial_row(const kernel::LensModel& lens, double coc_radius_px, bool raw) {
    using kernel::RingColours;
    if (const auto* geometric = dynamic_cast<const kernel::GeometricLens*>(&lens))
        if (auto row = geometric->axial_row(coc_radius_px, raw ? RingColours::Raw : RingColours::InGamut))
            return std::move(*row);
    const kernel::PointSpread spread =
        raw ? lens.raw_point_spread(coc_radius_px, {}) : lens.point_spread(coc_radius_px, {});
    std::vector<Rgba> row;
    for (int x = 0; x < spread.extent.x1; ++x)
        row.push_back(spread.weights(x - spread.extent.x0, -spread.extent.y0));
    return row;
}

// Errors: Cancelled.
Status make_columns(const BokehTextureSettings& settings, const std::function<void(int)>& make_column) {
    Progress progress(settings.progress, settings.cancelled);
    const std::shared_ptr<Workers> own = workers_of(settings.threads, settings.workers);
    CancellableWorkers workers(*own, progress);
    const WorksFor these(workers);
    try {
        parallel_for(settings.columns, workers, [&](int i) {
            make_column(i);
            progress.advance(1.0 / settings.columns);
        });
    } catch (const Cancelled&) {
        return Error{ErrorCode::Cancelled, "cancelled"};
    }
    return Done{};
}

Result<LensDisc> disc_of(const kernel::LensModel& lens, double coc_radius_px, FieldPosition field,
                         int size_px, bool raw) {
    if (const Status status = check_radius(lens, coc_radius_px); !status) return status.error();
    if (!(std::hypot(field.x, field.y) <= 1.001))
        return refuse("disc.field must lie within the half diagonal, such as 0.5,-0.3");
    if (size_px < 0 || size_px > kLargestDiscPx)
        return refuse("disc.size_px must be 0 (as the disc needs) to " + std::to_string(kLargestDiscPx));
    const kernel::PointSpread spread =
        raw ? lens.raw_point_spread(coc_radius_px, field) : lens.point_spread(coc_radius_px, field);
    const Rect e = spread.extent;
    const int needed = 2 * std::max({-e.x0, -e.y0, e.x1 - 1, e.y1 - 1, 0}) + 1;
    LensDisc disc{centred(spread, size_px == 0 ? needed : size_px | 1), lens.description(), 1, needed};
    for (std::size_t i = 0; i < disc.weights.size(); ++i)
        disc.lost_share -= double(disc.weights.pixels()[i].g);
    if (std::abs(disc.lost_share) < 1e-5) disc.lost_share = 0;
    return disc;
}

}  // namespace

Result<LensDisc> lens_point_spread(const Lens& lens, const LensMount& mount, double coc_radius_px,
                                   double field_x, double field_y, int size_px, bool raw) {
    const auto model = mounted(lens, mount);
    if (!model) return model.error();
    return disc_of(**model, coc_radius_px, {field_x, field_y}, size_px, raw);
}

Result<std::vector<LensDisc>> lens_point_spreads(const Lens& lens, const LensMount& mount,
                                                 std::span<const double> coc_radii_px, double field_x,
                                                 double field_y) {
    const auto model = mounted(lens, mount);
    if (!model) return model.error();
    std::vector<LensDisc> discs;
    for (const double radius : coc_radii_px) {
        auto disc = disc_of(**model, radius, {field_x, field_y}, 0, false);
        if (!disc) return disc.error();
        discs.push_back(std::move(*disc));
    }
    return discs;
}

Result<Camera> own_camera(const Lens& lens) {
    Camera camera{.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 0};
    if (lens.kind() == LensModelKind::Ideal) return camera;
    double focal_length_mm = 0, sensor_width_mm = 0, f_number = 0;
    if (const auto* curves = kernel::curves_of(lens)) {
        focal_length_mm = curves->focal_length_mm;
        sensor_width_mm = curves->sensor_width_mm;
        f_number = curves->f_number;
    } else {
        const optics::Prescription& surfaces = *kernel::prescription_of(lens);
        const auto first = optics::first_order(surfaces, surfaces.primary_um);
        if (!first) return Error{ErrorCode::InvalidFile, lens.name() + ": " + first.error().message};
        focal_length_mm = first->focal_length_mm;
        sensor_width_mm = optics::format_width_mm(surfaces, *first);
        f_number = first->f_number;
    }
    if (focal_length_mm > 0) camera.focal_length_mm = focal_length_mm;
    if (sensor_width_mm > 0) camera.sensor_width_mm = sensor_width_mm;
    // Rounded up, so that the lens has it.
    if (f_number > 0) camera.f_number = f_number * (1 + 1e-9);
    return camera;
}

Result<int> largest_disc_px(const Lens& lens, const LensMount& mount, double coc_radius_px) {
    const auto model = mounted(lens, mount);
    if (!model) return model.error();
    if (const Status status = check_radius(**model, coc_radius_px); !status) return status.error();
    return 2 * (int(std::ceil((*model)->reach_px(coc_radius_px))) + kBorderPx) + 1;
}

namespace {

// A lens that looks alike from everywhere, on a sensor of pixels so much finer.
struct TextureLens {
    Model lens;
    double finer = 1;
    static Result<TextureLens> make(const Lens& opened, const LensMount& mount,
                                    const BokehTextureSettings& settings);
};

Result<TextureLens> TextureLens::make(const Lens& opened, const LensMount& mount,
                                      const BokehTextureSettings& settings) {
    if (settings.columns < 2 || settings.columns > 16384) return refuse("disc.columns must be 2 to 16384");
    if (settings.rows_per_px < 1 || settings.rows_per_px > 16)
        return refuse("rows per pixel must be 1 to 16");
    LensChoice round = opened.choice();
    round.aperture = {};
    round.cats_eye = 0, round.barrel = {}, round.barn_doors = {}, round.texture = {},
    round.kernel_images = {};
    LensMount fine = mount;
    fine.width_px *= settings.rows_per_px, fine.height_px *= settings.rows_per_px;
    const auto round_lens = opened.with(round);
    if (!round_lens) return round_lens.error();
    auto lens = mounted(*round_lens, fine);
    if (!lens) return lens.error();
    if (!(settings.largest_coc_px > 0)) return refuse("disc.coc_radius_px must be above 0");
    const double finer = settings.rows_per_px;
    if (const Status status = check_radius(**lens, finer * settings.largest_coc_px); !status)
        return status.error();
    return TextureLens{std::move(*lens), finer};
}

// The smallest radius whose disc fits a slice, with the lens's own blur around it; at most half the largest.
double least_radius_px(const kernel::LensModel& lens, const BokehVolumeSettings& settings) {
    const auto fits = [&](double radius_px) {
        const double reach = std::max(lens.reach_px(radius_px), lens.reach_px(-radius_px));
        return kVolumeRadius * reach <= 0.5 * radius_px;
    };
    double least = settings.largest_coc_px / settings.slices / settings.slices;
    while (!fits(least) && least < settings.largest_coc_px / 2) least *= 1.1;
    return std::min(least, settings.largest_coc_px / 2);
}

}  // namespace

Result<int> most_texture_rows(const Lens& lens, const LensMount& mount,
                              const BokehTextureSettings& settings) {
    const auto made = TextureLens::make(lens, mount, settings);
    if (!made) return made.error();
    return int(std::ceil(made->lens->reach_px(made->finer * settings.largest_coc_px))) + kBorderPx + 1;
}

Result<BokehTexture> bokeh_texture(const Lens& lens, const LensMount& mount,
                                   const BokehTextureSettings& settings) {
    const auto made = TextureLens::make(lens, mount, settings);
    if (!made) return made.error();
    BokehTexture texture;
    texture.lens = made->lens->description();
    for (int i = 0; i < settings.columns; ++i) {
        const double t = 2.0 * i / (settings.columns - 1) - 1;
        texture.coc_radius_px.push_back(settings.largest_coc_px *
                                        (settings.dense_near_focus ? t * std::abs(t) : t));
    }
    std::vector<std::vector<Rgba>> profiles(texture.coc_radius_px.size());
    const auto make_column = [&](int i) {
        const double coc = made->finer * texture.coc_radius_px[std::size_t(i)];
        std::vector<Rgba>& profile = profiles[std::size_t(i)];
        profile = axial_row(*made->lens, coc, settings.raw);
        for (Rgba& light : profile) light *= float(made->finer * made->finer);  // so many fine pixels to one
    };
    if (Status done = make_columns(settings, make_column); !done) return done.error();
    fill(texture, profiles);
    return texture;
}

Result<LensDisc> lens_point_spread(const LensChoice& lens, const LensMount& mount, double coc_radius_px,
                                   double field_x, double field_y, int size_px, bool raw) {
    const auto opened = Lens::open(lens);
    if (!opened) return opened.error();
    return lens_point_spread(*opened, mount, coc_radius_px, field_x, field_y, size_px, raw);
}

Result<BokehTexture> bokeh_texture(const LensChoice& lens, const LensMount& mount,
                                   const BokehTextureSettings& settings) {
    const auto opened = Lens::open(lens);
    if (!opened) return opened.error();
    return bokeh_texture(*opened, mount, settings);
}

Result<BokehVolume> bokeh_volume(const Lens& lens, const LensMount& mount,
                                 const BokehVolumeSettings& settings) {
    if (settings.slices < 2 || settings.slices > 1024) return refuse("disc.slices must be 2 to 1024");
    if (settings.side_px < 16 || settings.side_px > 1024) return refuse("disc.side_px must be 16 to 1024");
    if (!(settings.largest_coc_px > 0 && settings.largest_coc_px < kLargestDiscPx))
        return refuse("disc.coc_radius_px must be above 0, and no larger than a disc can be");
    const auto model = mounted(lens, mount);
    if (!model) return model.error();
    const double least = least_radius_px(**model, settings);
    BokehVolume volume;
    for (int i = 0; i < settings.slices; ++i) {
        const double t = (2.0 * i + 1) / settings.slices - 1;
        const double radius = std::copysign(least + (settings.largest_coc_px - least) * t * t, t);
        // The same disc on a picture of so many more pixels that it fills the slice.
        const double finer = kVolumeRadius * settings.side_px / std::abs(radius);
        LensMount fine = mount;
        fine.width_px = std::max(1, int(std::lround(mount.width_px * finer)));
        fine.height_px = std::max(1, int(std::lround(mount.height_px * finer)));
        const double coc_px = radius * fine.width_px / mount.width_px;
        auto disc =
            lens_point_spread(lens, fine, coc_px, settings.field_x, settings.field_y, settings.side_px | 1);
        if (!disc) return disc.error();
        volume.lens = disc->lens;
        volume.coc_radius_px.push_back(radius);
        volume.slices.push_back(std::move(disc->weights));
    }
    return volume;
}

}  // namespace petzval
