// Evaluates the definition of a correct result (docs/conventions.md).
//
// For each output pixel and each of many pupil points u, the ray  q(c) = p - c u  is followed to the first
// surface it meets. Instead of walking every ray, the engine answers all rays of one pupil point at once:
// seen through u, a facet at signed radius c stands at its place + c u. The facets of a tile are drawn there,
// nearest in front, and every pixel looks up the facet that covers its centre. Facets are a pixel wide, which
// is the box filter, once. A facet that covers only a fraction of its pixel is present for that fraction of
// the pupil points; in a deep picture it lets the rest of every ray through to the next surface.
//
// Few pupil points would hit bright points, which would come out dotted. So these are taken out first and
// spread with the lens's exact kernel, each tap dimmed by the fraction of its rays that a nearer surface
// stops.
#include "engine/reference/reference.h"

#include "base/parallel.h"
#include "engine/reference/bright_points.h"
#include "engine/reference/lens_ray.h"
#include "engine/reference/surfaces.h"
#include "engine/waist/holdout.h"
#include "engine/waist/memory.h"
#include "kernel/model/radius_on_grid.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

namespace petzval::engine {
namespace {

constexpr int kTile = 128;
constexpr int kTileFieldVaries = 32;  // one set of rays for so many pixels on a side
constexpr double kShareOfRays = 0.8, kShareOfHighlights = 0.2;  // of the progress bar

double fraction(double x) { return x - std::floor(x); }

// Digits of k mirrored at the point (van der Corput), 0…1.
double radical_inverse(int k, int base) {
    double value = 0, digit = 1.0 / base;
    for (; k > 0; k /= base, digit /= base) value += (k % base) * digit;
    return value;
}

// One tile of the output, drawn once per pupil point.
class Tile {
public:
    Tile(const Surfaces& surfaces, CocSamplesView holdout, const Rect& area)
        : surfaces_(surfaces),
          holdout_(holdout),
          area_(area),
          nearest_(area.width(), area.height()),
          hit_(area.width(), area.height()),
          recent_(area.width(), area.height()),
          sum_(area.width(), area.height()),
          thin_(surfaces.dims_itself() ? sum_.size() : 0) {}

    void add(const kernel::PupilRay& ray, int k) {
        clear();
        for (int by = 0; by < surfaces_.blocks_y(); ++by)
            for (int bx = 0; bx < surfaces_.blocks_x(); ++bx)
                if (reaches(bx, by, ray)) draw_block(surfaces_.block_area(bx, by), ray, k);
        for (int y = 0; y < area_.height(); ++y)
            for (int x = 0; x < area_.width(); ++x) recent_(x, y) += arriving(x, y) * ray.weight;
        if (k % kRecent == kRecent - 1) settle();
    }

    const Picture& sum() {
        settle();
        return sum_;
    }

private:
    static constexpr std::uint32_t kNothing = 0xffffffff;
    // Thousands of small floats added to one large one lose digits; sums of this many first do not.
    static constexpr int kRecent = 64;

    void settle() {
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            sum_.pixels()[i] += recent_.pixels()[i];
            recent_.pixels()[i] = {};
        }
    }

    // A facet that a ray met.
    struct Met {
        float coc_px;
        std::uint32_t facet;
        bool operator<(const Met& other) const {
            return coc_px != other.coc_px ? coc_px < other.coc_px : facet < other.facet;
        }
    };

    // All that the ray under way brings to pixel (x, y): of each facet that dims what is behind it, its
    // share.
    Rgba arriving(int x, int y) {
        Rgba light;
        float open = 1;
        const Met stopped{nearest_(x, y), hit_(x, y)};
        if (surfaces_.dims_itself()) {
            std::vector<Met>& thin = thin_[std::size_t(y) * std::size_t(area_.width()) + std::size_t(x)];
            std::sort(thin.begin(), thin.end());
            for (const Met& m : thin) {
                if (!(m < stopped)) break;
                const float coverage = surfaces_.facets()[m.facet].coverage;
                light += open * coverage * held_back(m.facet, x, y);
                open *= 1 - coverage;
            }
        }
        if (stopped.facet != kNothing) light += open * held_back(stopped.facet, x, y);
        return light;
    }
    Rgba held_back(std::uint32_t index, int x, int y) const {
        const Facet& facet = surfaces_.facets()[index];
        return facet.colour * let_through(holdout_, area_.x0 + x, area_.y0 + y, facet.coc_px);
    }

    void clear() {
        std::fill_n(nearest_.pixels(), nearest_.size(), 1e30f);
        std::fill_n(hit_.pixels(), hit_.size(), kNothing);
        for (std::vector<Met>& thin : thin_) thin.clear();
    }

    bool reaches(int bx, int by, const kernel::PupilRay& ray) const {
        const Surfaces::Bounds bounds = surfaces_.block(bx, by);
        if (bounds.min > bounds.max) return false;
        const Rect r = surfaces_.block_area(bx, by);
        const float ax = bounds.min * ray.x + ray.offset_x_px, bx_px = bounds.max * ray.x + ray.offset_x_px;
        const float ay = bounds.min * ray.y + ray.offset_y_px, by_px = bounds.max * ray.y + ray.offset_y_px;
        constexpr float kShift = 1;  // more than shifts differ from radii
        return float(r.x1) + std::max(ax, bx_px) + kShift >= float(area_.x0) &&
               float(r.x0) + std::min(ax, bx_px) - kShift < float(area_.x1) &&
               float(r.y1) + std::max(ay, by_px) + kShift >= float(area_.y0) &&
               float(r.y0) + std::min(ay, by_px) - kShift < float(area_.y1);
    }

    void draw_block(const Rect& block, const kernel::PupilRay& ray, int k) {
        // Base 11: unrelated to the sequences that lenses spread their rays by.
        const double chance = radical_inverse(k, 11);
        const float shift_x = ray.offset_x_px - 0.5f - float(area_.x0);
        const float shift_y = ray.offset_y_px - 0.5f - float(area_.y0);
        for (int y = block.y0; y < block.y1; ++y)
            for (int x = block.x0; x < block.x1; ++x) {
                std::uint32_t index = surfaces_.first(x, y);
                const double place = fraction(index * 0.7320508075688772);
                for (const Facet& facet : surfaces_.at(x, y)) {
                    if (surfaces_.dims_itself() || facet.takes(chance + place))
                        draw(facet, index, float(x) + shift_x, float(y) + shift_y, ray);
                    ++index;
                }
            }
    }

    // (left, top): corner of the facet's pixel, such that samples are at whole numbers.
    void draw(const Facet& facet, std::uint32_t index, float left, float top, const kernel::PupilRay& ray) {
        const float* c = facet.shift_px;
        const float bend = std::max({std::abs(c[0] - c[1]), std::abs(c[0] - c[2]), std::abs(c[0] - c[3])});
        if (bend < 1e-5f) {  // flat: a unit square holds exactly one sample
            const int x = int(std::ceil(left + c[0] * ray.x)), y = int(std::ceil(top + c[0] * ray.y));
            if (x >= 0 && x < area_.width() && y >= 0 && y < area_.height()) put(x, y, facet.coc_px, index);
            return;
        }
        const float x[4] = {left + c[0] * ray.x, left + 1 + c[1] * ray.x, left + c[2] * ray.x,
                            left + 1 + c[3] * ray.x};
        const float y[4] = {top + c[0] * ray.y, top + c[1] * ray.y, top + 1 + c[2] * ray.y,
                            top + 1 + c[3] * ray.y};
        const int x0 = std::max(0, int(std::ceil(std::min({x[0], x[1], x[2], x[3]}))));
        const int x1 = std::min(area_.width() - 1, int(std::floor(std::max({x[0], x[1], x[2], x[3]}))));
        const int y0 = std::max(0, int(std::ceil(std::min({y[0], y[1], y[2], y[3]}))));
        const int y1 = std::min(area_.height() - 1, int(std::floor(std::max({y[0], y[1], y[2], y[3]}))));
        for (int v = y0; v <= y1; ++v)
            for (int u = x0; u <= x1; ++u)
                if (in_triangle(float(u), float(v), x, y, 0, 1, 2) ||
                    in_triangle(float(u), float(v), x, y, 1, 3, 2))
                    put(u, v, facet.coc_px, index);
    }

    // Either way round: a surface seen from a far side of the pupil may be turned over.
    static bool in_triangle(float u, float v, const float* x, const float* y, int a, int b, int c) {
        const auto side = [&](int i, int j) {
            return (x[j] - x[i]) * (v - y[i]) - (y[j] - y[i]) * (u - x[i]);
        };
        const float ab = side(a, b), bc = side(b, c), ca = side(c, a);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    }

    void put(int x, int y, float coc_px, std::uint32_t index) {
        if (coc_px >= nearest_(x, y)) return;
        if (surfaces_.dims_itself() && surfaces_.facets()[index].coverage < 1)
            return thin_[std::size_t(y) * std::size_t(area_.width()) + std::size_t(x)].push_back(
                {coc_px, index});
        nearest_(x, y) = coc_px;
        hit_(x, y) = index;
    }

    const Surfaces& surfaces_;
    CocSamplesView holdout_;
    Rect area_;
    Plane nearest_;
    Image<std::uint32_t> hit_;
    Picture recent_, sum_;
    std::vector<std::vector<Met>> thin_;  // of each pixel, where facets dim what is behind them
};

std::vector<Rect> tiles_of(const Rect& area, int size) {
    std::vector<Rect> tiles;
    for (int y = area.y0; y < area.y1; y += size)
        for (int x = area.x0; x < area.x1; x += size)
            tiles.push_back(Rect{x, y, x + size, y + size}.intersected(area));
    return tiles;
}

void trace_base(const EngineView& input, const Surfaces& surfaces, View<Rgba> out) {
    const bool varies = input.lens.level(0).varies_over_field();
    const std::vector<Rect> tiles = tiles_of(out.rect(), varies ? kTileFieldVaries : kTile);
    const auto rays_at = [&](const Rect& r) {
        return input.lens.level(0).rays(input.options.of<ReferenceOwn>().pupil_points,
                                        input.lens.field_at(0.5 * (r.x0 + r.x1 - 1), 0.5 * (r.y0 + r.y1 - 1)),
                                        input.options.of<ReferenceOwn>().seed);
    };
    const std::vector<kernel::PupilRay> everywhere = rays_at(out.rect());
    parallel_for(int(tiles.size()), *input.services.workers, [&](int i) {
        if (input.services.progress->cancelled()) return;
        const Rect& area = tiles[std::size_t(i)];
        const std::vector<kernel::PupilRay> here = varies ? rays_at(area) : std::vector<kernel::PupilRay>{};
        const std::vector<kernel::PupilRay>& rays = varies ? here : everywhere;
        Tile tile(surfaces, input.samples.holdout, area);
        for (int k = 0; k < int(rays.size()) && !input.services.progress->cancelled(); ++k)
            tile.add(rays[std::size_t(k)], k);
        const Picture& sum = tile.sum();
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x) out(x, y) = sum(x - area.x0, y - area.y0);
        input.services.progress->advance(kShareOfRays / double(tiles.size()));
    });
}

void spread_points(const EngineView& input, const Surfaces& surfaces, const std::vector<BrightPoint>& points,
                   View<Rgba> out) {
    // Kernels are made in parallel, batch by batch, and added in the order of the list: the same bits for any
    // threads.
    constexpr int kBatch = 512;
    const int count = int(points.size());
    for (int begin = 0; begin < count && !input.services.progress->cancelled(); begin += kBatch) {
        const int size = std::min(kBatch, count - begin);
        std::vector<kernel::PointSpread> spreads(static_cast<std::size_t>(size));
        parallel_for(size, *input.services.workers, [&](int i) {
            const BrightPoint& p = points[std::size_t(begin + i)];
            spreads[std::size_t(i)] =
                visible_point_spread(surfaces, input.lens.level(0), input.lens.field_at(p.x, p.y), p,
                                     std::max(1.0, input.lens.pixel_aspect));
        });
        constexpr int kBand = 32;
        parallel_for((out.height() + kBand - 1) / kBand, *input.services.workers, [&](int band) {
            const Rect rows = Rect{0, band * kBand, out.width(), (band + 1) * kBand}.intersected(out.rect());
            for (int i = 0; i < size; ++i) {
                const BrightPoint& p = points[std::size_t(begin + i)];
                const kernel::PointSpread& spread = spreads[std::size_t(i)];
                const Rect e = spread.extent;
                const Rect place = Rect{p.x + e.x0, p.y + e.y0, p.x + e.x1, p.y + e.y1}.intersected(rows);
                for (int y = place.y0; y < place.y1; ++y)
                    for (int x = place.x0; x < place.x1; ++x)
                        out(x, y) += spread.weights(x - p.x - e.x0, y - p.y - e.y0) * p.light *
                                     let_through(input.samples.holdout, x, y, p.coc_px);
            }
        });
        input.services.progress->advance(kShareOfHighlights * size / count);
    }
}

double largest_radius(const EngineView& input) {
    float largest = 0;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x)
            largest = std::max(largest, std::abs(input.samples.coc_px(x, y)));
    for (const CocSample& s : input.samples.deep.samples()) largest = std::max(largest, std::abs(s.coc_px));
    return largest;
}

// Refuses radii that take too much memory, before any work: the scene continues beyond the picture as far as
// a ray may come from.
Status surfaces_fit(const EngineView& input, const CocSamples& samples, int margin) {
    constexpr double kMost = double(std::size_t(8) << 30);
    const double pixels = double(input.width()) * input.height();
    const double cells = (double(input.width()) + 2.0 * margin) * (double(input.height()) + 2.0 * margin);
    const double per_cell =
        sizeof(std::uint32_t) + sizeof(Facet) * std::max(1.0, double(samples.samples.size()) / pixels);
    const double bytes = cells * per_cell + double(held_bytes(input));
    const double most = input.services.max_memory_bytes > 0 ? double(input.services.max_memory_bytes) : kMost;
    if (bytes <= most) return Done{};
    Error error = too_little_memory("reference", std::size_t(bytes));
    if (input.services.max_memory_bytes == 0)
        error.message = "engine reference takes about " + std::to_string(std::size_t(bytes) >> 20) +
                        "M for this picture and blur; cut radii with focus.max_radius_px, or allow it with "
                        "job.max_memory_bytes";
    return error;
}

// Warns that rays end in emptiness where the lens sees past a near surface and no hidden layer is given.
void say_what_is_not_known(const EngineView& input, Output& output) {
    constexpr float kCovered = 0.98f;
    if (!input.samples.deep.empty()) return;
    std::size_t empty = 0;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            if (input.samples.colour(x, y).a != 1) return;  // emptiness may be meant
            empty += output.image(x, y).a < kCovered;
        }
    if (empty == 0) return;
    const double percent = 100.0 * double(empty) / double(output.image.size());
    output.warnings.push_back(std::to_string(std::max(1, int(percent))) +
                              " % of the picture show hidden background, which is unknown and stays empty; "
                              "supply it as shot.behind");
}

}  // namespace

Result<Output> run_reference(const EngineView& input, Spare) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };

    CocSamples samples = stated_samples(input.samples);
    const std::vector<BrightPoint> points = take_bright_points(samples, input);
    // A ray may come from as far as the largest radius on either side of focus.
    const int margin = int(std::ceil(input.lens.level(0).reach_px(largest_radius(input)))) + 2;
    if (const Status fits = surfaces_fit(input, samples, margin); !fits) return fits.error();
    const Surfaces surfaces =
        Surfaces::make(samples, input.window.open_edges, margin, input.samples.deep_dims_itself,
                       kernel::blurs_in_focus(input.lens.level(0)), *input.services.workers);
    const double prepared = seconds();

    Output output;
    output.image = Picture(input.width(), input.height());
    trace_base(input, surfaces, output.image);
    const double traced = seconds();
    spread_points(input, surfaces, points, output.image);
    if (input.services.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    say_what_is_not_known(input, output);
    output.stages = {{"surfaces", prepared}, {"rays", traced - prepared}, {"highlights", seconds() - traced}};
    return output;
}

}  // namespace petzval::engine
