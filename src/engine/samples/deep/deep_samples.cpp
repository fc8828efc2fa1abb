#include "engine/samples/deep/deep_samples.h"

#include "base/parallel.h"
#include "image/deep_pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {
namespace {

DeepSample sound(DeepSample s, bool in_radii) {
    const auto finite = [](float v) { return std::isfinite(v) ? v : 0.0f; };
    const auto depth = [&](float z) {
        return (in_radii ? !std::isnan(z) : z > 0) ? z : std::numeric_limits<float>::infinity();
    };
    s.colour = {finite(s.colour.r), finite(s.colour.g), finite(s.colour.b),
                std::clamp(finite(s.colour.a), 0.0f, 1.0f)};
    s.depth = depth(s.depth), s.depth_back = std::max(s.depth, depth(s.depth_back));
    return s;
}

// Sizes of radius at which volumes are cut: every pixel near focus, every eighth of an octave further out.
// These are the ends of the intervals that the scatter engine composites one by one.
float cut_radius(int i) {
    constexpr int kLinear = 8;
    if (i < kLinear) return float(i) + 0.5f;
    return float(kLinear) * std::exp2((float(i - kLinear) + 0.5f) / 8);
}

// The depth in [near, far] at which the radius reaches `radius`.
float depth_of(float radius, const std::function<float(float)>& radius_px, float near, float far) {
    for (int i = 0; i < 60; ++i) {
        const float middle = near + 0.5f * (far - near);
        (radius_px(middle) < radius ? near : far) = middle;
    }
    return far;
}

// Depths at which the volumes of a picture are cut, ascending. Crowded pixels are summed up between them, so
// they span all finite depths.
std::vector<float> cuts_of(const DeepPicture& deep, const StatedDepth& meaning) {
    const auto& radius_px = radius_of(meaning);
    float near = std::numeric_limits<float>::max(), far = std::numeric_limits<float>::lowest();
    bool thick = false;
    for (const DeepSample& stored : deep.samples()) {
        const DeepSample s = sound(stored, is_in_radii(meaning));
        thick = thick || s.depth_back > s.depth;
        for (const float z : {s.depth, s.depth_back})
            if (std::isfinite(z)) near = std::min(near, z), far = std::max(far, z);
    }
    for (std::size_t i = 1; !thick && i < deep.first().size(); ++i)
        thick = deep.first()[i] - deep.first()[i - 1] > kCrowdedSamples;
    std::vector<float> cuts;
    if (!thick || near >= far) return cuts;
    const float least = radius_px(near), most = radius_px(far);
    const auto cut_at = [&](float radius) {
        if (radius > least && radius < most) cuts.push_back(depth_of(radius, radius_px, near, far));
    };
    for (int i = 0; cut_radius(i) < std::max(std::abs(least), std::abs(most)); ++i)
        cut_at(-cut_radius(i)), cut_at(cut_radius(i));
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
}

}  // namespace

CocSamples deep_samples(const DeepPicture& deep, const StatedDepth& meaning, Workers& workers) {
    const std::vector<float> cuts = cuts_of(deep, meaning);
    const auto& radius_px = radius_of(meaning);
    const bool in_radii = is_in_radii(meaning);
    const std::size_t width = std::size_t(deep.width());
    CocSamples all;
    all.width = deep.width();
    all.first.assign(width * std::size_t(deep.height()) + 1, 0);
    std::vector<std::vector<CocSample>> rows(static_cast<std::size_t>(deep.height()));
    const auto nearer = [](const DeepSample& p, const DeepSample& q) { return p.depth < q.depth; };
    parallel_for(deep.height(), workers, [&](int y) {
        std::vector<CocSample>& row = rows[std::size_t(y)];
        std::vector<DeepSample> pixel, tidy;
        for (int x = 0; x < deep.width(); ++x) {
            pixel.clear(), tidy.clear();
            for (const DeepSample& s : deep.at(x, y)) {
                const DeepSample own = sound(s, in_radii);
                if (!(own.colour == Rgba{})) pixel.push_back(own);  // others hide nothing
            }
            std::stable_sort(pixel.begin(), pixel.end(), nearer);
            tidy_pixel(pixel, cuts, tidy);
            for (const DeepSample& s : tidy) {
                const float front = radius_px(s.depth), back = radius_px(s.depth_back);
                const float middle = 0.5f * (front + back);
                row.push_back({s.colour, middle, middle});
            }
            all.first[std::size_t(y) * width + std::size_t(x) + 1] = row.size();
        }
    });
    for (std::size_t y = 0; y < rows.size(); ++y) {
        for (std::size_t i = 1; i <= width; ++i) all.first[y * width + i] += all.samples.size();
        all.samples.insert(all.samples.end(), rows[y].begin(), rows[y].end());
        rows[y] = {};
    }
    return all;
}

}  // namespace petzval::engine
