// The narrow waist between optics and engines: whatever describes a lens ends as one thing engines use, the
// kernel for a signed defocus, an image position and a colour channel.
//
// A lens is seen in two ways that agree with each other:
//   * point_spread(): the kernel on the pixel grid, for engines that scatter or gather;
//   * rays(): points of the pupil with the place where their ray lands, for engines that trace.
// Both are in PIXEL orientation (x right, y DOWN): a source at the centre of pixel s, with signed CoC radius
// c, lands through pupil point (x, y) at   s + c (x, y) + (offset_x_px, offset_y_px). For c > 0 (behind
// focus) the aperture appears upright, for c < 0 turned by 180 degrees, by itself.
#pragma once

#include "petzval/camera.h"
#include "petzval/image.h"
#include "petzval/lens_choice.h"
#include "petzval/place.h"
#include "petzval/result.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace petzval::kernel {

using petzval::FieldPosition;

// One point-spread function on the pixel grid: the light of a source at the centre of pixel (0, 0).
struct PointSpread {
    Rect extent;  // offsets covered; weights(dx - extent.x0, dy - extent.y0) goes to offset (dx, dy)
    Image<Rgba>
        weights;  // non-negative; r, g, b each sum to 1; a is what alpha is blurred with and sums to 1 too
    bool neutral = true;  // r = g = b = a everywhere: one channel may stand for all
};

// One point of the pupil. Weights of all rays of a set sum to 1 per channel.
struct PupilRay {
    float x = 0, y = 0;                      // unit disc of the f-stop, y DOWN and times the pixel aspect
    float offset_x_px = 0, offset_y_px = 0;  // aberration: where the ray lands for c = 0
    Rgba weight;
};

// The mirrorings of field position that mirror the kernel too.
struct Mirrors {
    bool left_right = false;  // (-x, y) against (x, y)
    bool up_down = false;     // (x, -y) against (x, y)
};

// The camera and picture size that turn a lens's millimetres into pixels.
struct Mount {
    Camera camera;
    int display_width_px = 0, display_height_px = 0;
    double pixel_aspect = 1;  // vertical radii in pixels are multiplied by it
};

// A lens mounted on a camera, for pictures of one size. Immutable; safe to use from many threads.
class LensModel {
public:
    virtual ~LensModel() = default;

    // The weight of a pixel is the share of the aperture's light that lands in its square.
    virtual PointSpread point_spread(double coc_radius_px, FieldPosition field) const = 0;

    // The same before colours that no screen has are mapped into gamut: r, g or b may be negative in fringes.
    // This is what rays() sum to.
    virtual PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const {
        return point_spread(coc_radius_px, field);
    }

    // `count` low-discrepancy points over pupil and wavelengths, the same for the same count and seed.
    virtual std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const = 0;

    // Largest |displacement| in pixels of any light of a source with |coc| <= coc_radius_px, on either axis.
    virtual double reach_px(double coc_radius_px) const = 0;

    // False: point_spread and rays are the same for every field position.
    virtual bool varies_over_field() const = 0;

    virtual Mirrors mirrors() const { return {}; }

    virtual std::string description() const = 0;

    // True if kernels are made faster than they could be read from a disk.
    virtual bool is_quick() const { return !varies_over_field(); }

    // The same lens on the same camera, for pictures of another size of pixels, if that costs less than to
    // make it anew; else null.
    virtual std::unique_ptr<const LensModel> on_pixels(const Mount& mount) const {
        (void)mount;
        return nullptr;
    }
};

// A lens that knows another's kernels: it is that lens in all but how they are come by.
class LensOver : public LensModel {
public:
    PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const override {
        return lens_->raw_point_spread(coc_radius_px, field);
    }
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override {
        return lens_->rays(count, field, seed);
    }
    double reach_px(double coc_radius_px) const override { return lens_->reach_px(coc_radius_px); }
    bool varies_over_field() const override { return lens_->varies_over_field(); }
    Mirrors mirrors() const override { return lens_->mirrors(); }
    std::string description() const override { return lens_->description(); }
    bool is_quick() const override { return false; }

protected:
    explicit LensOver(std::unique_ptr<const LensModel> lens) : lens_(std::move(lens)) {}
    const LensModel& under() const { return *lens_; }

private:
    std::unique_ptr<const LensModel> lens_;
};

}  // namespace petzval::kernel
