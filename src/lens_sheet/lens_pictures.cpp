// Kernels, bokeh textures and volumes as EXR files that say how they were made, and as PNG files.
#include "petzval/files.h"
#include "petzval/lens_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>
#include <utility>

namespace petzval {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

std::string number(double value, int digits = 6) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
}

// Colour planes under a layer's name.
class Planes {
public:
    void add(const std::string& layer, const Picture& picture, bool with_alpha) {
        const std::string prefix = layer.empty() ? "" : layer + ".";
        add(prefix + "R", picture, &Rgba::r);
        add(prefix + "G", picture, &Rgba::g);
        add(prefix + "B", picture, &Rgba::b);
        if (with_alpha) add(prefix + "A", picture, &Rgba::a);
    }
    void add(const std::string& channel, Plane plane) { kept_.emplace_back(channel, std::move(plane)); }
    Status write(const std::string& path, Attributes attributes, bool overwrite) const {
        std::vector<NamedPlane> named;
        for (const auto& [channel, plane] : kept_) named.push_back({channel, plane.view()});
        WriteOptions options;
        options.type = PixelType::Float;
        options.overwrite = overwrite;
        options.attributes = std::move(attributes);
        return write_exr_planes(path, Place::whole(kept_[0].second.rect()), named, options);
    }

private:
    void add(const std::string& channel, const Picture& picture, float Rgba::*which) {
        Plane plane = Plane::uninitialised(picture.width(), picture.height());
        std::transform(picture.pixels(), picture.pixels() + picture.size(), plane.pixels(),
                       [which](const Rgba& light) { return light.*which; });
        add(channel, std::move(plane));
    }
    std::vector<std::pair<std::string, Plane>> kept_;
};

void add_mount(Attributes& attributes, const LensMount& mount) {
    attributes.emplace_back("petzval:pictureWidth", number(mount.width_px));
    attributes.emplace_back("petzval:focalLength", number(mount.camera.focal_length_mm, 9));
    attributes.emplace_back("petzval:fNumber", number(mount.camera.f_number, 9));
    attributes.emplace_back("petzval:sensorWidth", number(mount.camera.sensor_width_mm, 9));
}

// Measured bytes of a pixel: of a kernel while it is made, and of each kind of picture with its file.
constexpr std::size_t kKernelBytes = 24, kDiscBytes = 35, kTextureBytes = 39, kVolumeBytes = 50,
                      kTileKernelBytes = 48;

Status fits(const char* what, std::size_t width, std::size_t height, std::size_t bytes, std::size_t limit) {
    return fits_memory(std::string(what) + " of " + std::to_string(width) + " x " + std::to_string(height),
                       bytes, limit);
}

}  // namespace

Result<LensMount> mounted_on(const Lens& lens, const CameraChoice& choice, int width_px,
                             std::optional<int> height_px) {
    const auto own = own_camera(lens);
    if (!own) return own.error();
    LensMount mount;
    mount.width_px = width_px;
    mount.height_px = height_px.value_or(std::max(1, width_px * 9 / 16));
    Camera& camera = mount.camera;
    camera.focal_length_mm = choice.focal_length_mm.value_or(own->focal_length_mm);
    camera.f_number = choice.f_number.value_or(own->f_number);
    if (choice.aperture_diameter_mm) camera.f_number = camera.focal_length_mm / *choice.aperture_diameter_mm;
    camera.sensor_width_mm = choice.sensor_width_mm.value_or(own->sensor_width_mm);
    camera.focus_distance_m = choice.focus_distance_m.value_or(0);
    camera.image_scale = choice.image_scale;
    return mount;
}

// The kernel is made whole, also for a smaller picture.
Status lens_disc_fits(const Lens& lens, const LensMount& mount, double coc_radius_px, int size_px,
                      std::size_t limit_bytes) {
    const auto disc = largest_disc_px(lens, mount, coc_radius_px);
    if (!disc) return disc.error();
    const auto whole = std::size_t(*disc);
    const auto side = size_px > 0 ? std::size_t(size_px) : whole;
    return fits("a kernel", side, side, std::max(kKernelBytes * whole * whole, kDiscBytes * side * side),
                limit_bytes);
}

// Each thread makes the kernel of a column.
Status bokeh_texture_fits(const Lens& lens, const LensMount& mount, const BokehTextureSettings& settings,
                          std::size_t limit_bytes) {
    const auto most = most_texture_rows(lens, mount, settings);
    if (!most) return most.error();
    const auto rows = std::size_t(*most);
    const auto columns = std::size_t(settings.columns);
    const std::size_t kernels = std::thread::hardware_concurrency() * sizeof(Rgba) * 4 * rows * rows;
    return fits("a table", columns, rows, kTextureBytes * columns * rows + kernels, limit_bytes);
}

Status bokeh_volume_fits(const BokehVolumeSettings& settings, std::size_t limit_bytes) {
    const auto side = std::size_t(settings.side_px | 1);
    const auto slices = std::size_t(settings.slices);
    return fits("a volume", side, side * slices, kVolumeBytes * side * side * slices, limit_bytes);
}

// Measured (docs/results/memory.md).
Status lens_atlas_fits(const Lens& lens, const LensMount& mount, const LensAtlasSettings& settings,
                       std::size_t limit_bytes) {
    constexpr std::size_t kBeside = std::size_t(5) << 19;
    const auto disc = lens_atlas_disc_px(lens, mount, settings);
    if (!disc) return disc.error();
    const auto zones = std::size_t(settings.zones), whole = std::size_t(*disc);
    return fits_memory("an atlas of " + std::to_string(zones) + " zones",
                       kBeside + lens_atlas_bytes(settings) + kTileKernelBytes * whole * whole, limit_bytes);
}

Status lens_report_fits(std::size_t limit_bytes) {
    return fits_memory("a report of a lens", std::size_t(60) << 20, limit_bytes);
}

Status write_lens_disc(const std::string& path, const LensDisc& disc, double coc_radius_px, double field_x,
                       double field_y, bool overwrite) {
    Planes planes;
    planes.add("", disc.weights, true);
    return planes.write(path,
                        {{"petzval:lens", disc.lens},
                         {"petzval:coc", "signed radius, px, + is far: " + number(coc_radius_px)},
                         {"petzval:field", number(field_x) + "," + number(field_y)}},
                        overwrite);
}

Status write_bokeh_texture(const std::string& path, const BokehTexture& texture,
                           const BokehTextureSettings& settings, const LensMount& mount, bool overwrite) {
    Plane coc(texture.energy.width(), texture.energy.height());
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < coc.width(); ++x) coc(x, y) = float(texture.coc_radius_px[std::size_t(x)]);
    Planes planes;
    planes.add("", texture.energy, false);
    planes.add("view", texture.view, false);
    planes.add("coc.radius", std::move(coc));
    Attributes attributes{
        {"petzval:lens", texture.lens},
        {"petzval:coc", "signed radius, px, + is far"},
        {"petzval:columns", number(settings.columns)},
        {"petzval:columnSpacing", settings.dense_near_focus ? "square root of the radius" : "even"},
        {"petzval:largestRadius", number(settings.largest_coc_px, 9)},
        {"petzval:rowsPerPixel", number(settings.rows_per_px)}};
    add_mount(attributes, mount);
    return planes.write(path, std::move(attributes), overwrite);
}

Picture stacked_slices(const BokehVolume& volume) {
    const int side = volume.slices[0].width();
    Picture all(side, side * int(volume.slices.size()));
    for (std::size_t i = 0; i < volume.slices.size(); ++i)
        for (int y = 0; y < side; ++y) std::copy_n(volume.slices[i].row(y), side, all.row(int(i) * side + y));
    return all;
}

Status write_bokeh_volume(const std::string& path, const BokehVolume& volume, const LensMount& mount,
                          bool overwrite) {
    Planes planes;
    planes.add("", stacked_slices(volume), false);
    std::string radii;
    for (const double radius : volume.coc_radius_px) radii += (radii.empty() ? "" : ",") + number(radius, 9);
    Attributes attributes{{"petzval:lens", volume.lens},
                          {"petzval:radii", radii},
                          {"petzval:radiusInSides", number(kVolumeRadius)},
                          {"petzval:slices", number(double(volume.slices.size()))}};
    add_mount(attributes, mount);
    return planes.write(path, std::move(attributes), overwrite);
}

Picture exposed_to_white(Picture picture) {
    float brightest = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const Rgba& w = picture.pixels()[i];
        brightest = std::max({brightest, w.r, w.g, w.b});
    }
    for (std::size_t i = 0; i < picture.size(); ++i) {
        Rgba& w = picture.pixels()[i];
        w = (brightest > 0 ? 1 / brightest : 1) * w;
        w.a = 1;
    }
    return picture;
}

Status write_lens_view(const std::string& path, Picture picture, const DisplayChoice& display,
                       bool overwrite) {
    const Picture shown = exposed_to_white(std::move(picture));
    DevelopSettings settings = display.settings(false, std::nullopt, 0);
    if (!display.tone) settings.tone = ToneCurve::None;
    return write_developed(path, shown.view(), settings, overwrite);
}

}  // namespace petzval
