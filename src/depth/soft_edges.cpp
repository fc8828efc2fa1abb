#include "depth/soft_edges.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace petzval {
namespace {

constexpr float kLeastStep = 0.05f;  // of the range: lesser ones tell nothing
constexpr int kWidestRamp = 24;      // px; what changes for longer is a surface
constexpr int kFew = 16;             // edges: they tell nothing about the others

// The range of all values but the outermost hundredths.
float range_of(View<const float> values) {
    std::vector<float> some;
    const int every = 1 + int(std::sqrt(double(values.width()) * values.height() / 65536));
    for (int y = every / 2; y < values.height(); y += every)
        for (int x = every / 2; x < values.width(); x += every) some.push_back(values(x, y));
    if (some.empty()) return 0;
    const auto at = [&](double share) {
        const auto i = std::ptrdiff_t(share * double(some.size() - 1));
        std::nth_element(some.begin(), some.begin() + i, some.end());
        return some[std::size_t(i)];
    };
    const float low = at(0.01), high = at(0.99);
    return high - low;
}

// A copy of a row or a column of values.
class Line {
public:
    Line(View<const float> values, int number) {
        const int column = number - values.height();
        if (column < 0) {
            values_.assign(values.row(number), values.row(number) + values.width());
        } else {
            values_.reserve(std::size_t(values.height()));
            for (int y = 0; y < values.height(); ++y) values_.push_back(values(column, y));
        }
    }
    int size() const { return int(values_.size()); }
    float at(int i) const { return values_[std::size_t(std::clamp(i, 0, size() - 1))]; }
    // Requires: i and i + 1 lie on the line.
    float step(int i) const { return values_[std::size_t(i) + 1] - values_[std::size_t(i)]; }

private:
    std::vector<float> values_;
};

// A run of steps of one sign around their largest.
struct Run {
    int first, last;
    bool is_edge = false;
    float deviation_px = 0;
};

Run run_around(const Line& line, int i, float least) {
    constexpr float kTail = 0.1f;     // of the largest step: less is a plateau
    constexpr float kPlateau = 0.2f;  // of the run: a slope goes on changing
    const float peak = line.step(i);
    Run run{i, i};
    const auto goes_on = [&](int j) { return line.step(j) / peak > kTail; };
    while (run.first > 0 && goes_on(run.first - 1) && run.last - run.first < kWidestRamp) --run.first;
    while (run.last + 2 < line.size() && goes_on(run.last + 1) && run.last - run.first < kWidestRamp)
        ++run.last;
    if (run.last - run.first >= kWidestRamp || run.first == 0 || run.last + 2 >= line.size()) return run;
    double sum = 0, mean = 0, square = 0;
    for (int j = run.first; j <= run.last; ++j) {
        const double step = double(line.step(j));
        sum += step, mean += step * (j - i), square += step * (j - i) * (j - i);
    }
    const float all = std::abs(float(sum));
    const int beyond = std::max(2, (run.last - run.first) / 2);
    const auto changes = [&](int a, int b) { return std::abs(line.at(a) - line.at(b)) > kPlateau * all; };
    run.is_edge = all >= least && !changes(run.first, run.first - beyond) &&
                  !changes(run.last + 1, run.last + 1 + beyond);
    run.deviation_px = float(std::sqrt(std::max(0.0, square / sum - mean * mean / (sum * sum))));
    return run;
}

// The deviation of each edge of a line.
std::vector<float> edges_of(const Line& line, float least) {
    std::vector<float> deviations;
    for (int i = 0; i + 1 < line.size(); ++i) {
        const float peak = std::abs(line.step(i));
        if (peak < least / kWidestRamp) continue;
        if (i > 0 && std::abs(line.step(i - 1)) > peak) continue;
        if (i + 2 < line.size() && std::abs(line.step(i + 1)) >= peak) continue;
        const Run run = run_around(line, i, least);
        if (run.is_edge) deviations.push_back(run.deviation_px), i = run.last;
    }
    return deviations;
}

float square(float v) { return v * v; }

// Squared difference of two lights, relative to their brightness.
float unlike(Rgba a, Rgba b) {
    const float difference = square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b) + square(a.a - b.a);
    const float size = square(a.r + b.r) + square(a.g + b.g) + square(a.b + b.b);
    return difference / (0.25f * size + 1e-5f);
}

// A pixel between two plateaus, and their values; one that is too thin to be reached anywhere is none yet.
struct Ramp {
    int x, y;
    float low, high;
    bool low_is_plateau, high_is_plateau;
    float by_place;  // how far up it lies: -1 low … 1 high
};

class Snapper {
public:
    Snapper(View<const Rgba> colour, View<const float> values, const EdgeSoftness& softness, Workers& workers)
        : colour_(colour),
          values_(values),
          workers_(workers),
          deviation_px_(std::clamp(softness.deviation_px, 0.5f, kWidestDeviationPx)),
          reach_(int(std::ceil(3 * deviation_px_)) + 1),
          stride_(std::max(1, int(deviation_px_ / 1.5f))),
          least_(0.03f * softness.range) {
        lowest_ = highest_ = values(0, 0);
        for (int y = 0; y < values.height(); ++y)
            for (int x = 0; x < values.width(); ++x)
                lowest_ = std::min(lowest_, values(x, y)), highest_ = std::max(highest_, values(x, y));
        find_flat();
        find_ramps();
    }
    Plane snapped() {
        constexpr int kRounds = 3;
        for (int i = 0; i < kRounds; ++i) vote();
        raise_thin_ones();
        Plane out = Plane::uninitialised(values_.width(), values_.height());
        parallel_for(out.height(), workers_, [&](int y) {
            for (int x = 0; x < out.width(); ++x) {
                const Ramp* const r = ramp_at(x, y);
                out(x, y) = !r ? values_(x, y) : side_(x, y) > 0 ? r->high : r->low;
            }
        });
        return out;
    }

private:
    static constexpr float kWidestDeviationPx = 6;

    const Ramp* ramp_at(int x, int y) const {
        return index_(x, y) < 0 ? nullptr : &ramps_[std::size_t(index_(x, y))];
    }
    template <typename Body>
    void for_each_around(int x, int y, int stride, const Body& body) const {
        const int reach = reach_ / stride * stride;
        for (int v = y - reach; v <= y + reach; v += stride) {
            if (v < 0 || v >= values_.height()) continue;
            for (int u = x - reach; u <= x + reach; u += stride)
                if (u >= 0 && u < values_.width()) body(u, v, float((u - x) * (u - x) + (v - y) * (v - y)));
        }
    }
    template <typename Body>
    void for_each_ramp(const Body& body) const {
        constexpr int kBatch = 256;
        const int count = int(ramps_.size());
        parallel_for((count + kBatch - 1) / kBatch, workers_, [&](int batch) {
            for (int i = batch * kBatch; i < std::min(count, (batch + 1) * kBatch); ++i) body(std::size_t(i));
        });
    }

    float change_at(int x, int y) const {
        const float dx = values_.clamped(x + 1, y) - values_.clamped(x - 1, y),
                    dy = values_.clamped(x, y + 1) - values_.clamped(x, y - 1);
        return 0.5f * std::sqrt(dx * dx + dy * dy);
    }
    // The largest of the values around each pixel.
    Plane largest_around(const Plane& in) const {
        const int width = in.width(), height = in.height();
        Plane across = Plane::uninitialised(width, height), out = Plane::uninitialised(width, height);
        parallel_for(height, workers_, [&](int y) {
            const float* const row = in.row(y);
            for (int x = 0; x < width; ++x)
                across(x, y) =
                    *std::max_element(row + std::max(0, x - reach_), row + std::min(width, x + reach_ + 1));
        });
        parallel_for(height, workers_, [&](int y) {
            std::copy_n(across.row(y), width, out.row(y));
            for (int v = std::max(0, y - reach_); v <= std::min(height - 1, y + reach_); ++v)
                for (int x = 0; x < width; ++x) out(x, y) = std::max(out(x, y), across(x, v));
        });
        return out;
    }
    // Extreme value of flat pixels; sign -1: the smallest. Without flat pixels it is below any value.
    Plane flat_around(float sign) const {
        Plane some(values_.width(), values_.height());
        parallel_for(some.height(), workers_, [&](int y) {
            for (int x = 0; x < some.width(); ++x)
                some(x, y) = flat_(x, y) ? sign * values_(x, y) : -std::numeric_limits<float>::max();
        });
        return largest_around(some);
    }
    // Flat is what changes little: by itself, as part of a ramp, or beside the steepest around.
    void find_flat() {
        constexpr float kSteepest = 0.25f;
        const float step_of_change = 2.5f * deviation_px_;  // of a blurred step by its steepest
        Plane change(values_.width(), values_.height());
        parallel_for(change.height(), workers_, [&](int y) {
            for (int x = 0; x < change.width(); ++x) change(x, y) = change_at(x, y);
        });
        const Plane largest = largest_around(change);
        flat_ = Image<unsigned char>(change.width(), change.height());
        parallel_for(change.height(), workers_, [&](int y) {
            for (int x = 0; x < change.width(); ++x)
                flat_(x, y) =
                    change(x, y) * step_of_change < least_ || change(x, y) < kSteepest * largest(x, y);
        });
        Image<unsigned char> with_plateaus(change.width(), change.height());
        parallel_for(change.height(), workers_, [&](int y) {
            for (int x = 0; x < change.width(); ++x)
                with_plateaus(x, y) =
                    is_flat_around(x, y) ? static_cast<unsigned char>(kPlateau) : flat_(x, y);
        });
        flat_ = std::move(with_plateaus);
    }
    bool is_plateau(int x, int y) const { return flat_(x, y) == kPlateau; }
    // The ridge of something thin is flat in one pixel.
    bool is_flat_around(int x, int y) const {
        const auto flat = [&](int u, int v) { return !flat_.rect().contains(u, v) || flat_(u, v); };
        return flat(x, y) && flat(x - 1, y) && flat(x + 1, y) && flat(x, y - 1) && flat(x, y + 1);
    }

    void find_ramps() {
        index_ = Image<int>(values_.width(), values_.height(), -1);
        side_ = Plane(values_.width(), values_.height());
        const Plane highest = flat_around(1), lowest = flat_around(-1);
        std::vector<std::vector<Ramp>> rows(static_cast<std::size_t>(values_.height()));
        parallel_for(values_.height(), workers_, [&](int y) {
            for (int x = 0; x < values_.width(); ++x)
                if (!is_plateau(x, y) && highest(x, y) + lowest(x, y) > least_)
                    add_ramp(x, y, 0.5f * (highest(x, y) - lowest(x, y)), rows[std::size_t(y)]);
        });
        for (const auto& row : rows)
            for (const Ramp& ramp : row) {
                index_(ramp.x, ramp.y) = int(ramps_.size());
                side_(ramp.x, ramp.y) = ramp.by_place;
                ramps_.push_back(ramp);
            }
    }
    void add_ramp(int x, int y, float middle, std::vector<Ramp>& ramps) const {
        float sums[2] = {0, 0}, weights[2] = {0, 0};
        bool plateau[2] = {false, false};
        for_each_around(x, y, 1, [&](int u, int v, float d2) {
            if (!flat_(u, v)) return;
            const int side = values_(u, v) > middle;
            const bool on_plateau = is_plateau(u, v);
            constexpr float kPlateauCounts = 10;
            const float weight = (on_plateau ? kPlateauCounts : 1) / square(1 + d2);
            sums[side] += weight * values_(u, v), weights[side] += weight;
            plateau[side] = plateau[side] || on_plateau;
        });
        const float low = sums[0] / weights[0], high = sums[1] / weights[1];
        if (!(high - low > least_)) return;
        const float up = 2 * (values_(x, y) - low) / (high - low) - 1;
        ramps.push_back({x, y, low, high, plateau[0], plateau[1], std::clamp(up, -1.0f, 1.0f)});
    }

    // The side of a pixel as seen from a ramp: -1 low … 1 high.
    float side_of(int x, int y, const Ramp& seen_from) const {
        if (index_(x, y) >= 0) return side_(x, y);
        const float up = (values_(x, y) - seen_from.low) / (seen_from.high - seen_from.low);
        return std::clamp(2 * up - 1, -1.0f, 1.0f);
    }
    // Each pixel of a ramp goes where pixels like it are (a joint bilateral mean, J. Kopf and others 2007, of
    // sides).
    void vote() {
        std::vector<float> votes(ramps_.size());
        for_each_ramp([&](std::size_t i) {
            constexpr float kUnlike = 30, kPlace = 0.3f;
            const Ramp& ramp = ramps_[i];
            const Rgba own = colour_(ramp.x, ramp.y);
            float sum = 0, weights = 0;
            for_each_around(ramp.x, ramp.y, stride_, [&](int u, int v, float d2) {
                const float weight = 1 / (square(1 + kUnlike * unlike(own, colour_(u, v))) * (4 + d2));
                sum += weight * side_of(u, v, ramp), weights += weight;
            });
            votes[i] = std::clamp(2 * (sum / weights + kPlace * ramp.by_place), -1.0f, 1.0f);
        });
        for (std::size_t i = 0; i < ramps_.size(); ++i) side_(ramps_[i].x, ramps_[i].y) = votes[i];
    }

    // True if no pixel around shows the whole side that it was assigned to.
    bool is_thin(const Ramp& ramp) const {
        return !(side_(ramp.x, ramp.y) > 0 ? ramp.high_is_plateau : ramp.low_is_plateau);
    }
    // Share of the pixel's own side that blur leaves there.
    float own_share(const Ramp& ramp) const {
        const bool high = side_(ramp.x, ramp.y) > 0;
        float own = 0, all = 0;
        for_each_around(ramp.x, ramp.y, stride_, [&](int u, int v, float d2) {
            const float weight = std::exp(-0.5f * d2 / square(deviation_px_));
            all += weight;
            if ((side_of(u, v, ramp) > 0) == high) own += weight;
        });
        return own / all;
    }
    // Thin objects are blurred to less than their step: the step is the one which, blurred like the sides,
    // comes closest to the values around (least squares).
    void raise_thin_ones() {
        constexpr float kMost = 4;
        std::vector<float> shares(ramps_.size());
        for_each_ramp([&](std::size_t i) {
            if (is_thin(ramps_[i])) shares[i] = own_share(ramps_[i]);
        });
        std::vector<Ramp> raised = ramps_;
        for_each_ramp([&](std::size_t i) {
            Ramp& ramp = raised[i];
            if (!is_thin(ramp)) return;
            const bool high = side_(ramp.x, ramp.y) > 0;
            float products = 0, squares = 0;
            for_each_around(ramp.x, ramp.y, stride_, [&](int u, int v, float d2) {
                const Ramp* const other = ramp_at(u, v);
                if (!other || (side_(u, v) > 0) != high || !is_thin(*other)) return;
                const float shown = high ? values_(u, v) - other->low : other->high - values_(u, v);
                const float share = shares[std::size_t(index_(u, v))], weight = 1 / (4 + d2);
                products += weight * share * shown, squares += weight * share * share;
            });
            const float step = ramp.high - ramp.low;
            const float raised_step = std::clamp(products / squares, step, kMost * step);
            if (high) ramp.high = std::clamp(ramp.low + raised_step, ramp.high, highest_);
            if (!high) ramp.low = std::clamp(ramp.high - raised_step, lowest_, ramp.low);
        });
        ramps_ = std::move(raised);
    }

    View<const Rgba> colour_;
    View<const float> values_;
    Workers& workers_;
    float deviation_px_;
    int reach_;
    int stride_;   // px: wide ramps are looked at in steps
    float least_;  // the least step of a ramp
    float lowest_, highest_;
    enum Flat : unsigned char { kNot, kFlat, kPlateau };
    Image<unsigned char> flat_;
    Image<int> index_;  // into ramps_; -1: in none
    Plane side_;        // of pixels in ramps
    std::vector<Ramp> ramps_;
};

}  // namespace

bool EdgeSoftness::is_soft() const {
    constexpr float kFilteredPx = 0.6f;  // steps filtered over a pixel have 0.5 at the most
    return edges >= kFew && deviation_px > kFilteredPx;
}

bool EdgeSoftness::is_filtered() const {
    constexpr int kManyEdges = 256;  // in thumbnails, many edges have a third surface right beside them
    constexpr float kManyRamps = 0.28f;
    return edges >= kManyEdges && !is_soft() && filtered > kManyRamps;
}

EdgeSoftness edge_softness(View<const float> values, Workers& workers) {
    EdgeSoftness softness;
    softness.range = range_of(values);
    const float least = kLeastStep * softness.range;
    if (!(least > 0)) return softness;
    const int lines = values.width() + values.height();
    std::vector<std::vector<float>> found(static_cast<std::size_t>(lines));
    parallel_for(lines, workers, [&](int i) { found[std::size_t(i)] = edges_of(Line(values, i), least); });
    std::vector<float> all;
    for (const auto& line : found) all.insert(all.end(), line.begin(), line.end());
    softness.edges = int(all.size());
    if (all.empty()) return softness;
    constexpr float kStepPx = 0.2f, kNarrowPx = 0.8f;
    const auto narrower = [&](float px) {
        return float(std::count_if(all.begin(), all.end(), [px](float d) { return d < px; }));
    };
    softness.filtered = 1 - narrower(kStepPx) / std::max(1.0f, narrower(kNarrowPx));
    // Ramps that are cut aslant, or lie on slopes, are wider.
    constexpr double kNarrow = 0.4;
    const auto narrow = all.begin() + std::ptrdiff_t(double(all.size()) * kNarrow);
    std::nth_element(all.begin(), narrow, all.end());
    softness.deviation_px = *narrow;
    return softness;
}

Plane snapped_edges(View<const Rgba> colour, View<const float> values, const EdgeSoftness& softness,
                    Workers& workers) {
    return Snapper(colour, values, softness, workers).snapped();
}

}  // namespace petzval
