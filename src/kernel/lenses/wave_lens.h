// Diffraction: the kernel as the square of the Fourier transform of the pupil.
//
// The rays of a lens are the gradient of its wavefront: light that lands at d(u) millimetres from the
// source's image comes from pupil point u with the phase  2 pi/wavelength * W(u),  W(u) = 1/(2N) * integral
// of d . du  from the axis out (N the f-number; d in the scale of a unit pupil). The intensity at x is
//     I(x) = | integral over the pupil of  sqrt(T(u)) exp(2 pi i W(u)/wavelength) exp(-2 pi i x.u/(2 N
//     wavelength)) du |^2
// (Goodman, Introduction to Fourier Optics, ch. 5), evaluated by FFT with at least two samples per wavelength
// x N and summed over the squares of the pixels. Where that would take more than kLargestGrid samples a side,
// or more than kMostInPixel in a pixel, diffraction is far below a pixel: then the kernel of rays is
// convolved with the diffraction figure of the focus.
#pragma once

#include "kernel/lenses/geometric_lens.h"

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace petzval::kernel {

class WaveLens final : public LensModel {
public:
    static constexpr int kLargestGrid = 1024;
    static constexpr int kMostInPixel = 48;  // samples a side

    // wavelengths: bands of the spectrum; 0: 21.
    WaveLens(std::unique_ptr<const GeometricLens> lens, const Mount& mount, int wavelengths = 0,
             LightSpectrum light = LightSpectrum::Daylight);

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const override;
    // Rays of the lens without diffraction: rays do not bend at rims.
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override {
        return lens_->rays(count, field, seed);
    }
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override { return lens_->varies_over_field(); }
    Mirrors mirrors() const override { return lens_->mirrors(); }
    bool is_quick() const override { return false; }
    std::string description() const override { return lens_->description() + ", with diffraction"; }

    // One wavelength. Weights sum to 1 in every channel. `extent` is what the kernel is wanted on.
    PointSpread monochromatic(double wavelength_nm, double coc_radius_px, FieldPosition field,
                              const Rect& extent) const;
    // True if the wave itself is computed for this radius, false if its figure at focus is laid over the
    // rays.
    bool is_wave_at(double coc_radius_px) const;

private:
    Rect extent_at(double coc_radius_px) const;
    double tail_px() const;
    int samples_per_pixel() const;
    // A pixel in wavelengths x 2 N: phases of a wavefront in pixels x pupil radii times this are in turns.
    double pixel_waves(double wavelength_nm) const;
    struct PupilGrid;
    // The grid for an extent. All longer wavelengths may use it too: fewer of its samples make a pixel.
    PupilGrid pupil_grid(double wavelength_nm, FieldPosition field, const Rect& extent) const;
    PointSpread band(const PupilGrid& grid, double wavelength_nm, double coc_radius_px, FieldPosition field,
                     const Rect& extent) const;
    PointSpread made_figure(FieldPosition field) const;
    PointSpread sum_of_bands(const Rect& extent, const std::function<PointSpread(double)>& one_band) const;

    struct FocusFigure {
        std::mutex mutex;
        std::shared_ptr<const PointSpread> spread;
    };
    std::shared_ptr<const PointSpread> focus_figure(FieldPosition field) const;

    std::unique_ptr<const GeometricLens> lens_;
    double f_number_, pixel_mm_, pixel_aspect_;
    int wavelengths_;
    LightSpectrum light_;

    mutable std::mutex figures_mutex_;
    mutable std::map<std::pair<int, int>, std::shared_ptr<FocusFigure>> figures_;
};

}  // namespace petzval::kernel
