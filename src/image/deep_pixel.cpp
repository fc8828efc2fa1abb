#include "image/deep_pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval {
namespace {

bool is_volume(const DeepSample& s) { return s.depth_back > s.depth && std::isfinite(s.depth_back); }

// Several volumes that fill the same interval: optical thicknesses add, and each glows in proportion to its
// own (Kainz, "Interpreting OpenEXR Deep Pixels": splitting and merging of volume samples).
class Mixture {
public:
    // The part `t` (0…1) of a volume's thickness.
    void add(const DeepSample& s, double t) {
        const double alpha = std::clamp(double(s.colour.a), 0.0, 1.0);
        if (alpha >= 1) {  // however thin a slice of it, it hides everything
            opaque_ += s.colour;
            ++opaque_count_;
            return;
        }
        const double thickness = -t * std::log1p(-alpha);
        // Light that the volume would send out if nothing in the interval were in its way.
        const double glow = alpha > 0 ? thickness / alpha : t;
        thickness_ += thickness;
        r_ += double(s.colour.r) * glow, g_ += double(s.colour.g) * glow, b_ += double(s.colour.b) * glow;
    }
    Rgba colour() const {
        if (opaque_count_ > 0) {
            Rgba mean = opaque_ * (1 / float(opaque_count_));
            mean.a = 1;
            return mean;
        }
        const double alpha = -std::expm1(-thickness_);
        const double seen = thickness_ > 0 ? alpha / thickness_ : 1;
        return {float(r_ * seen), float(g_ * seen), float(b_ * seen), float(alpha)};
    }

private:
    double thickness_ = 0, r_ = 0, g_ = 0, b_ = 0;
    Rgba opaque_;
    int opaque_count_ = 0;
};

float part_of(const DeepSample& s, float from_m, float to_m) {
    return float((double(to_m) - double(from_m)) / (double(s.depth_back) - double(s.depth)));
}

// Samples one over the other as they come, remembered as one at their mean depth as seen. In double: there
// may be very many, each of very little.
class Heap {
public:
    void add(Rgba colour, float depth_m) {
        const double alpha = std::clamp(double(colour.a), 0.0, 1.0);
        r_ += free_ * double(colour.r), g_ += free_ * double(colour.g), b_ += free_ * double(colour.b);
        const double weight = free_ * alpha + 1e-9;  // light without coverage has a place too
        if (std::isfinite(depth_m)) depth_ += weight * double(depth_m), weight_ += weight;
        free_ *= 1 - alpha;
        any_ = true;
    }
    void flush(std::vector<DeepSample>& out) {
        if (any_) {
            const float depth_m =
                weight_ > 0 ? float(depth_ / weight_) : std::numeric_limits<float>::infinity();
            out.push_back({{float(r_), float(g_), float(b_), float(1 - free_)}, depth_m, depth_m});
        }
        *this = {};
    }

private:
    double r_ = 0, g_ = 0, b_ = 0, free_ = 1, depth_ = 0, weight_ = 0;
    bool any_ = false;
};

// One sample for each interval between cuts. A volume is cut, but not compared with the others.
void sum_up(std::span<const DeepSample> pixel, std::span<const float> cuts_m, std::vector<DeepSample>& out) {
    std::vector<Heap> heaps(cuts_m.size() + 1);
    const auto interval_of = [&](float z) {
        return std::size_t(std::upper_bound(cuts_m.begin(), cuts_m.end(), z) - cuts_m.begin());
    };
    for (const DeepSample& s : pixel) {
        std::size_t i = interval_of(s.depth);
        if (!is_volume(s)) {
            heaps[i].add(s.colour, s.depth);
            continue;
        }
        for (float from_m = s.depth; from_m < s.depth_back; ++i) {
            const float to_m = i < cuts_m.size() ? std::min(cuts_m[i], s.depth_back) : s.depth_back;
            Mixture piece;
            piece.add(s, double(part_of(s, from_m, to_m)));
            heaps[i].add(piece.colour(), 0.5f * (from_m + to_m));
            from_m = to_m;
        }
    }
    for (Heap& heap : heaps) heap.flush(out);
}

// Every depth at which something begins or ends, and the cuts within volumes.
std::vector<float> boundaries_of(std::span<const DeepSample> pixel, std::span<const float> cuts_m) {
    std::vector<float> boundaries;
    for (const DeepSample& s : pixel) {
        boundaries.push_back(s.depth);
        if (!is_volume(s)) continue;
        boundaries.push_back(s.depth_back);
        const auto begin = std::upper_bound(cuts_m.begin(), cuts_m.end(), s.depth);
        boundaries.insert(boundaries.end(), begin, std::lower_bound(begin, cuts_m.end(), s.depth_back));
    }
    std::sort(boundaries.begin(), boundaries.end());
    boundaries.erase(std::unique(boundaries.begin(), boundaries.end()), boundaries.end());
    return boundaries;
}

// Walks from front to back; at each boundary first the surfaces that lie there, then what fills the interval
// behind.
void take_apart(std::span<const DeepSample> pixel, std::span<const float> cuts_m,
                std::vector<DeepSample>& out) {
    const std::vector<float> boundaries = boundaries_of(pixel, cuts_m);
    std::vector<const DeepSample*> open;  // volumes that reach beyond the boundary
    std::size_t next = 0;
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
        const float here_m = boundaries[i];
        std::erase_if(open, [&](const DeepSample* s) { return s->depth_back <= here_m; });
        for (; next < pixel.size() && pixel[next].depth <= here_m; ++next) {
            const DeepSample& s = pixel[next];
            if (is_volume(s))
                open.push_back(&s);
            else
                out.push_back({s.colour, s.depth, s.depth});
        }
        if (open.empty()) continue;
        Mixture mixture;
        for (const DeepSample* s : open) mixture.add(*s, double(part_of(*s, here_m, boundaries[i + 1])));
        out.push_back({mixture.colour(), here_m, boundaries[i + 1]});
    }
}

}  // namespace

bool has_overlaps(std::span<const DeepSample> pixel) {
    float farthest_back = -std::numeric_limits<float>::infinity();
    for (const DeepSample& s : pixel) {
        if (s.depth < farthest_back) return true;
        if (is_volume(s)) farthest_back = std::max(farthest_back, s.depth_back);
    }
    return false;
}

void tidy_pixel(std::span<const DeepSample> pixel, std::span<const float> cuts_m,
                std::vector<DeepSample>& out) {
    if (pixel.size() > kCrowdedSamples)
        sum_up(pixel, cuts_m, out);
    else if (std::any_of(pixel.begin(), pixel.end(), is_volume))
        take_apart(pixel, cuts_m, out);
    else
        for (const DeepSample& s : pixel) out.push_back({s.colour, s.depth, s.depth});
}

}  // namespace petzval
