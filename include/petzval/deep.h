// A deep picture: any number of samples per pixel, each with its own colour, coverage and depth.
//
// What samples mean and how they combine follows "Interpreting OpenEXR Deep Pixels" (F. Kainz, openexr.com).
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/workers.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace petzval {

// One surface in one pixel. Colour is premultiplied by the sample's OWN coverage `colour.a` (the area that
// it hides), not by its visible part.
struct DeepSample {
    Rgba colour;
    // Planar metres, +infinity for a miss; or signed radii in pixels, beside a picture whose depth is radii.
    float depth = 0;
    float depth_back = 0;  // end of a volumetric sample; equal to depth for a surface
};

// Samples of a width x height picture, nearest first within each pixel, rows top to bottom.
class DeepPicture {
public:
    DeepPicture() = default;
    // Requires: first.size() == width * height + 1, first.front() == 0, ascending, first.back() ==
    // samples.size().
    DeepPicture(int width, int height, std::vector<std::size_t> first, std::vector<DeepSample> samples)
        : width_(width), height_(height), first_(std::move(first)), samples_(std::move(samples)) {}

    // Built pixel by pixel: samples_at(x, y, samples) appends the samples of the pixel, nearest first.
    template <typename SamplesAt>
    static DeepPicture made_of(int width, int height, const SamplesAt& samples_at) {
        std::vector<std::size_t> first{0};
        std::vector<DeepSample> samples;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                samples_at(x, y, samples);
                first.push_back(samples.size());
            }
        return {width, height, std::move(first), std::move(samples)};
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return samples_.empty(); }
    std::size_t sample_count() const { return samples_.size(); }
    std::size_t bytes() const {
        return samples_.size() * sizeof(DeepSample) + first_.size() * sizeof(std::size_t);
    }
    std::span<const DeepSample> at(int x, int y) const {
        const std::size_t i = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        return {samples_.data() + first_[i], first_[i + 1] - first_[i]};
    }
    std::span<DeepSample> samples() { return samples_; }
    std::span<const DeepSample> samples() const { return samples_; }
    // Index of the first sample of pixel i = y * width + x; one more entry closes the last pixel.
    std::span<const std::size_t> first() const { return first_; }

private:
    int width_ = 0, height_ = 0;
    std::vector<std::size_t> first_;
    std::vector<DeepSample> samples_;
};

// One picture among several that share a frame.
struct PlacedDeep {
    const DeepPicture* picture = nullptr;
    Rect data_window;  // of the picture's size
};

// All samples of all parts in one picture that covers `window`, nearest first in each pixel. Samples at one
// depth are ordered by their values, so that the order of the parts changes no bit. Requires: no NaN.
PETZVAL_API DeepPicture merge_deep(const std::vector<PlacedDeep>& parts, const Rect& window);

// One sample per pixel of a flat picture with depth of the same size; empty pixels give none.
PETZVAL_API DeepPicture deep_from_flat(View<const Rgba> colour, View<const float> depth_m);

// Composites every pixel's samples into one colour and one depth. Colours are composited over each other,
// nearest first. The depth is the one at which the accumulated coverage first reaches half of the pixel's
// final coverage, so a wall behind thin fog keeps its depth. A pixel whose samples have no coverage (pure
// glow) has the depth of its nearest sample; a pixel without samples is a miss. Overlapping volumes are
// split first (image/deep_pixel.h). `workers` are a host's threads; without them, `threads` of our own run
// (0: all). The result is the same for any number of threads.
PETZVAL_API void flatten(const DeepPicture& deep, Picture& colour, Plane& depth, int threads = 0,
                         Workers* workers = nullptr);

}  // namespace petzval
