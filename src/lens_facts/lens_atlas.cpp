// Discs of a lens as tiles of one texture.
#include "petzval/lens_kernel.h"

#include "kernel/lenses/opened_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace petzval {
namespace {

constexpr int kSide = kAtlasTileSide, kRadii = kAtlasRadii;

// Light in 32 bits: nine of each colour, five of the exponent that they share, as Vulkan's
// E5B9G9R9_UFLOAT_PACK32 and WebGL's RGB9_E5 have it. Requires: r, g, b are finite. Negative light becomes 0.
class SharedExponent {
public:
    explicit SharedExponent(const Rgba& light) {
        std::array<float, 3> colour = {light.r, light.g, light.b};
        for (float& c : colour) c = std::clamp(c, 0.0f, 65408.0f);
        const float most = std::max({colour[0], colour[1], colour[2]});
        int exponent = std::max(-15, most > 0 ? std::ilogb(most) + 1 : -15);
        if (std::lround(std::ldexp(most, 9 - exponent)) > 511) ++exponent;
        for (int i = 0; i < 3; ++i) {
            const auto mantissa =
                std::uint32_t(std::lround(std::ldexp(colour[std::size_t(i)], 9 - exponent)));
            bits_ |= mantissa << (9 * i);
            stored_[std::size_t(i)] = std::ldexp(double(mantissa), exponent - 9);
        }
        bits_ |= std::uint32_t(exponent + 15) << 27;
    }
    std::uint32_t bits() const { return bits_; }
    const std::array<double, 3>& stored() const { return stored_; }

private:
    std::uint32_t bits_ = 0;
    std::array<double, 3> stored_ = {};
};

// Stores a disc as the tile of its zone and radius. Returns the sums of the stored red, green and blue.
std::array<double, 3> store(const Picture& disc, int zone, int radius, std::string& texels) {
    std::array<double, 3> sums = {};
    constexpr double kTexels = kSide * kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const SharedExponent light(float(kTexels) * disc(x, y));
            for (std::size_t i = 0; i < 3; ++i) sums[i] += light.stored()[i] / kTexels;
            const int at = (zone * kSide + y) * kRadii * kSide + radius * kSide + x;
            for (int byte = 0; byte < 4; ++byte)
                texels[std::size_t(4 * at + byte)] = char(light.bits() >> (8 * byte) & 255u);
        }
    return sums;
}

// A picture of so many more pixels that `side_px` of the camera's picture fill a tile.
LensMount tile_mount(const LensMount& mount, double side_px) {
    LensMount fine = mount;
    const double finer = kSide / side_px;
    fine.width_px = std::max(1, int(std::lround(fine.width_px * finer)));
    fine.height_px = std::max(1, int(std::lround(fine.height_px * finer)));
    return fine;
}

Result<LensDisc> tile_of(const Lens& lens, const LensMount& mount, double coc_px, double place,
                         double side_px) {
    const LensMount fine = tile_mount(mount, side_px);
    return lens_point_spread(lens, fine, coc_px * fine.width_px / mount.width_px, place, 0, kSide);
}

// Without aberrations, a disc of this radius fills seven tenths of its tile.
double least_side_px(double coc_px) { return std::max(4.0, std::abs(coc_px) / 0.35); }

constexpr double kMostLost = 0.02;  // of a tile's light

Status add_tile(const Lens& lens, const LensMount& mount, int zone, int radius, LensAtlas& atlas) {
    const double coc_px = atlas.radii_px[std::size_t(radius)], place = atlas.zones[std::size_t(zone)];
    double side_px = least_side_px(coc_px);
    auto disc = tile_of(lens, mount, coc_px, place, side_px);
    while (disc && disc->lost_share > kMostLost && side_px < kLargestDiscPx / 2.0)
        disc = tile_of(lens, mount, coc_px, place, side_px *= 1.3);
    if (!disc) return disc.error();
    atlas.lens = disc->lens;
    atlas.sides_px[std::size_t(zone)].push_back(side_px);
    atlas.sums[std::size_t(zone)].push_back(store(disc->weights, zone, radius, atlas.texels));
    return Done{};
}

double tile_radius_px(int radius, const LensAtlasSettings& settings) {
    const double t = 2.0 * radius / (kRadii - 1) - 1;
    return settings.largest_coc_px * t * std::abs(t);
}

LensAtlas empty_atlas(const LensAtlasSettings& settings) {
    LensAtlas atlas;
    atlas.width = kRadii * kSide;
    atlas.height = settings.zones * kSide;
    atlas.texels.resize(lens_atlas_bytes(settings));
    for (int radius = 0; radius < kRadii; ++radius)
        atlas.radii_px.push_back(tile_radius_px(radius, settings));
    for (int zone = 0; zone < settings.zones; ++zone)
        atlas.zones.push_back(settings.zones > 1 ? double(zone) / (settings.zones - 1) : 0);
    atlas.sides_px.resize(atlas.zones.size());
    atlas.sums.resize(atlas.zones.size());
    return atlas;
}

// The field that makes the pupil of a lens not round; null if it is round.
const char* not_round(const LensChoice& lens) {
    if (lens.aperture.blades != 0) return "lens.blades";
    if (lens.aperture.squeeze != 1) return "lens.squeeze";
    if (lens.barn_doors != BarnDoors{}) return "lens.barn_doors";
    if (lens.texture.image) return "lens.aperture_image";
    if (lens.kernel_images != KernelImages{}) return "lens.kernel_image";
    if (lens.texture.dust != 0) return "lens.dust";
    return lens.texture.scratches != 0 ? "lens.scratches" : nullptr;
}

Error refused(const std::string& field, const std::string& why) {
    return {ErrorCode::InvalidArgument, field + why, field};
}

}  // namespace

Status check(const LensAtlasSettings& settings, const LensChoice& lens) {
    if (settings.zones < 1 || settings.zones > 64)
        return refused("atlas.zones", " " + std::to_string(settings.zones) + ": must be 1 to 64");
    if (!(settings.largest_coc_px > 0 && std::isfinite(settings.largest_coc_px)))
        return refused("atlas.largest_coc_px", " must be above 0");
    const char* const field = settings.zones > 1 ? not_round(lens) : nullptr;
    if (!field) return Done{};
    return refused(field,
                   " makes a pupil that is not round, and zones are rings that shaders turn about the "
                   "middle; give atlas.zones 1");
}

std::size_t lens_atlas_bytes(const LensAtlasSettings& settings) {
    return std::size_t(4 * kSide * kSide * kRadii) * std::size_t(settings.zones);
}

Result<LensAtlas> lens_atlas(const Lens& lens, const LensMount& mount, const LensAtlasSettings& settings) {
    if (const Status fine = check(settings, lens.choice()); !fine) return fine.error();
    const optics::Prescription* const prescription = kernel::prescription_of(lens);
    if (settings.zones > 1 && prescription && !optics::is_round(*prescription))
        return refused("lens.name",
                       " has cylinders: its discs do not turn about the middle with the zones of "
                       "an atlas; give atlas.zones 1");
    if (mount.pixel_aspect != 1) return refused("mount.pixel_aspect", " must be 1: tiles are squares");
    LensAtlas atlas = empty_atlas(settings);
    const auto go_on = [&](double done) { return !settings.progress || settings.progress(done); };
    for (int zone = 0; zone < settings.zones; ++zone)
        for (int radius = 0; radius < kRadii; ++radius) {
            if (!go_on((zone + double(radius) / kRadii) / settings.zones))
                return Error{ErrorCode::Cancelled, "stopped"};
            if (const Status done = add_tile(lens, mount, zone, radius, atlas); !done) return done.error();
        }
    go_on(1);
    return atlas;
}

// A tile that grows is drawn on fewer pixels: its first kernel is the largest.
Result<int> lens_atlas_disc_px(const Lens& lens, const LensMount& mount, const LensAtlasSettings& settings) {
    int largest = 0;
    for (int radius = 0; radius < kRadii; ++radius) {
        const double coc_px = tile_radius_px(radius, settings);
        const LensMount fine = tile_mount(mount, least_side_px(coc_px));
        const auto disc = largest_disc_px(lens, fine, coc_px * fine.width_px / mount.width_px);
        if (!disc) return disc.error();
        largest = std::max(largest, *disc);
    }
    return largest;
}

}  // namespace petzval
