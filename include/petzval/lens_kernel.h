// Images of a point of light through a lens.
#pragma once

#include "petzval/camera.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/lens.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace petzval {

// The camera and the picture size that express a lens in pixels.
struct LensMount {
    Camera camera;  // a focus distance of 0 means infinity here
    int width_px = 1920, height_px = 1080;
    double pixel_aspect = 1;
};

// The camera that a lens was built for, focused at infinity: its focal length, its largest aperture and the
// width of its format. For lenses of any size: 50 mm, f/2, sensor 36 mm. Errors: those of lens_facts().
PETZVAL_API Result<Camera> own_camera(const Lens& lens);

struct LensDisc {
    Picture weights;        // scene-linear; r, g, b and a each sum to 1; the source is in the middle pixel
    std::string lens;       // description of the lens that was used
    double lost_share = 0;  // share of the light (green) outside of a picture smaller than the disc
    int needed_px = 1;      // side of the smallest picture that contains the whole disc
};

// The kernel of a source of signed CoC radius `coc_radius_px` at a place of the picture: field_x, field_y in
// -1…1 of its half diagonal, x right, y up. size_px: sides of the picture, made odd; 0: as large as the disc.
// raw: colours outside the gamut are not mapped into it. Errors: those of the lens; InvalidArgument for
// numbers that are not finite, or a disc or picture larger than kLargestDiscPx.
PETZVAL_API Result<LensDisc> lens_point_spread(const Lens& lens, const LensMount& mount, double coc_radius_px,
                                               double field_x = 0, double field_y = 0, int size_px = 0,
                                               bool raw = false);
// Errors: also those of Lens::open().
PETZVAL_API Result<LensDisc> lens_point_spread(const LensChoice& lens, const LensMount& mount,
                                               double coc_radius_px, double field_x = 0, double field_y = 0,
                                               int size_px = 0, bool raw = false);
inline constexpr int kLargestDiscPx = 8192;
// Side of a picture that contains any disc of at most that radius, anywhere in the frame; no kernel is
// made. Errors: those of lens_point_spread().
PETZVAL_API Result<int> largest_disc_px(const Lens& lens, const LensMount& mount, double coc_radius_px);
// Several discs of one place, the lens mounted once. Errors: as above.
PETZVAL_API Result<std::vector<LensDisc>> lens_point_spreads(const Lens& lens, const LensMount& mount,
                                                             std::span<const double> coc_radii_px,
                                                             double field_x = 0, double field_y = 0);

struct BokehTextureSettings {
    int columns = 512;
    double largest_coc_px = 64;    // the first column has this radius in front of focus, the last behind
    bool dense_near_focus = true;  // radii grow with the square of the distance from the middle column
    int rows_per_px = 4;           // 1…16
    bool raw = false;
    int threads = 0;                            // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;                 // those of a host, in place of `threads`; null: our own
    std::function<bool(double)> progress = {};  // share done 0…1, one call at a time; false cancels
    std::function<bool()> cancelled = {};       // true cancels; called often, by any thread at any time
};

// The bokeh texture of M. Kawase (CEDEC 2008): each column is the radial profile of a disc, from its middle
// outwards, on the axis and with a round aperture. Row v is v / rows_per_px pixels from the middle. The
// talk squares the profile; here each value is the light that falls on a square pixel at that distance.
struct BokehTexture {
    Picture energy;                     // the disc of a column sums to 1 over its pixels
    Picture view;                       // the same, columns divided by their brightest channel (smoothed)
    std::vector<double> coc_radius_px;  // one per column
    std::string lens;
};

// Errors: as above; Cancelled.
PETZVAL_API Result<BokehTexture> bokeh_texture(const Lens& lens, const LensMount& mount,
                                               const BokehTextureSettings& settings = {});
// Number of rows that is enough for any such texture; no kernel is made. Errors: as above.
PETZVAL_API Result<int> most_texture_rows(const Lens& lens, const LensMount& mount,
                                          const BokehTextureSettings& settings = {});
PETZVAL_API Result<BokehTexture> bokeh_texture(const LensChoice& lens, const LensMount& mount,
                                               const BokehTextureSettings& settings = {});

struct BokehVolumeSettings {
    int slices = 32;             // 2…1024
    int side_px = 128;           // of a slice, 16…1024
    double largest_coc_px = 64;  // the first slice has nearly this radius in front of focus, the last behind
    double field_x = 0, field_y = 0;
};

// Radius of the circle of confusion in every slice, in sides of the slice.
inline constexpr double kVolumeRadius = 0.35;

// The bokeh texture with a third dimension: whole discs, for apertures that are not round (blades, dust,
// cat's eye). Slices are as large as their discs: light outside of a slice is lost. Radii grow with the
// square of the distance from the middle of the volume. The smallest radius is the first whose disc fits
// its slice, because nearer to focus the lens's own blur is wider than the disc.
struct BokehVolume {
    std::vector<Picture> slices;  // r, g, b each sum to 1, minus lost light
    std::vector<double> coc_radius_px;
    std::string lens;
};

// Errors: those of lens_point_spread(); InvalidArgument for settings out of range.
PETZVAL_API Result<BokehVolume> bokeh_volume(const Lens& lens, const LensMount& mount,
                                             const BokehVolumeSettings& settings = {});

// Discs by place in the frame and by radius, as one texture for shaders (docs/reference/lens-atlas.md): one
// row of tiles per zone, one tile per radius.
struct LensAtlasSettings {
    double largest_coc_px = 64;                 // radii from minus this to plus this, denser near focus
    int zones = 5;                              // rings of the frame from its middle to its corners, 1…64
    std::function<bool(double)> progress = {};  // share done 0…1; false cancels
};

inline constexpr int kAtlasTileSide = 31, kAtlasRadii = 14;

struct LensAtlas {
    // Light in 32 bits, nine of each colour and five of the exponent that they share (Vulkan's
    // E5B9G9R9_UFLOAT_PACK32, WebGL's RGB9_E5), little-endian, row by row. A texel is light times the
    // number of a tile's texels.
    std::string texels;
    int width = 0, height = 0;  // texels
    std::vector<double> zones;  // places, in half diagonals from the middle
    std::vector<double> radii_px;
    // The square that each tile covers has this side, in pixels; its stored r, g and b have these sums.
    // Both are listed by zone, then radius.
    std::vector<std::vector<double>> sides_px;
    std::vector<std::vector<std::array<double, 3>>> sums;
    std::string lens;
};

// Errors: InvalidArgument for settings out of range, and for a pupil that is not round with several zones:
// shaders turn the discs of a zone about the middle of the picture.
PETZVAL_API Status check(const LensAtlasSettings& settings, const LensChoice& lens);
// Size of the texels. Requires: zones in range.
PETZVAL_API std::size_t lens_atlas_bytes(const LensAtlasSettings& settings);
// A tile grows until at most 2 % of the light falls outside. Errors: those of check() and
// lens_point_spread(); InvalidArgument for pixels that are not square; Cancelled.
PETZVAL_API Result<LensAtlas> lens_atlas(const Lens& lens, const LensMount& mount,
                                         const LensAtlasSettings& settings = {});
// Largest side, in pixels, of the kernels that lens_atlas() draws for its tiles; an upper bound. Errors:
// those of largest_disc_px().
PETZVAL_API Result<int> lens_atlas_disc_px(const Lens& lens, const LensMount& mount,
                                           const LensAtlasSettings& settings = {});

}  // namespace petzval
