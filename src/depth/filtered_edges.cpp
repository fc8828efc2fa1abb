#include "depth/filtered_edges.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace petzval {
namespace {

constexpr int kWidest = 4;  // px: a filter's ramp; what changes for longer is a surface

struct Spot {
    int x, y;
};

// Values along the row or column through a pixel, which has the number 0; they grow with the distance.
class LineThrough {
public:
    LineThrough(View<const float> values, bool grows, Spot at, bool along_row)
        : values_(values), sign_(grows ? 1.0f : -1.0f), at_(at), along_row_(along_row) {}
    Spot place(int i) const {
        return along_row_ ? Spot{std::clamp(at_.x + i, 0, values_.width() - 1), at_.y}
                          : Spot{at_.x, std::clamp(at_.y + i, 0, values_.height() - 1)};
    }
    float at(int i) const {
        const Spot p = place(i);
        return sign_ * values_(p.x, p.y);
    }
    float step(int i) const { return at(i + 1) - at(i); }

private:
    View<const float> values_;
    float sign_;
    Spot at_;
    bool along_row_;
};

// A ramp runs from the last pixel of a nearer plateau to the first of a farther one.
struct FilterRamp {
    int near, far;
    float height;
    int away() const { return far > near ? 1 : -1; }
    bool is_between(int i) const { return std::min(near, far) < i && i < std::max(near, far); }
};

// The ramp around the steepest step next to step i; none where a slope continues. A step of less than
// `near_tail` of the steepest belongs to the nearer plateau.
std::optional<FilterRamp> ramp_around(const LineThrough& line, int i, float near_tail) {
    constexpr float kFarTail = 0.1f, kPlateau = 0.2f;  // of the steepest step; of the ramp's height
    for (int tries = 0; tries < kWidest; ++tries) {
        const int steepest = std::abs(line.step(i + 1)) > std::abs(line.step(i - 1)) ? i + 1 : i - 1;
        if (std::abs(line.step(steepest)) <= std::abs(line.step(i))) break;
        i = steepest;
    }
    const float peak = line.step(i);
    if (peak == 0) return std::nullopt;
    int first = i, last = i;
    const auto belongs = [&](int j) {
        const bool on_near_side = (peak > 0) == (j < i);
        return line.step(j) / peak > (on_near_side ? near_tail : kFarTail);
    };
    while (last - first < kWidest && belongs(first - 1)) --first;
    while (last - first < kWidest && belongs(last + 1)) ++last;
    if (last - first >= kWidest) return std::nullopt;
    FilterRamp ramp = peak > 0 ? FilterRamp{first, last + 1, 0} : FilterRamp{last + 1, first, 0};
    ramp.height = line.at(ramp.far) - line.at(ramp.near);
    const auto rises = [&](int from, int to) { return line.at(to) - line.at(from) > kPlateau * ramp.height; };
    if (rises(ramp.far, ramp.far + 2 * ramp.away())) return std::nullopt;
    if (rises(ramp.near - 2 * ramp.away(), ramp.near)) return std::nullopt;
    return ramp;
}

float squared(Rgba c) { return c.r * c.r + c.g * c.g + c.b * c.b + c.a * c.a; }

// The nearest pixel across something narrow, and the background beside it.
struct NarrowThing {
    int x;
    float behind;
    Rgba colour_behind;
};

class Filtered {
public:
    Filtered(View<const Rgba> colour, const FilteredDepth& depth, Workers& workers)
        : colour_(colour), depth_(depth), workers_(workers) {}
    Plane without() {
        find_strands();
        const Plane raised = with_whole_strands();
        Plane out = raised.clone();
        for_each_row([&](int y) {
            for (int x = 0; x < out.width(); ++x)
                if (!is_strand_(x, y) && !is_level(x, y)) out(x, y) = of_one_side({x, y}, raised);
        });
        return out;
    }

private:
    // A row or a column, by the averaged quantity, which shows a little sky, or by 1/depth, in which
    // receding surfaces change slowly.
    struct Across {
        LineThrough line, linear;
        float near_tail;
    };
    Across across(Spot at, bool along_row, bool by_average) const {
        const LineThrough linear(depth_.linear, depth_.linear_grows, at, along_row);
        if (by_average) return {LineThrough(depth_.averaged, true, at, along_row), linear, 0.02f};
        return {linear, linear, 0.1f};
    }
    // True if the pixel and its neighbours have about the same depth.
    bool is_level(int x, int y) const {
        const Plane& v = depth_.linear;
        const float own = v(x, y);
        const auto steps = [&](float other) { return std::abs(other - own) * kWidest > depth_.least_step; };
        return !steps(v(std::max(x - 1, 0), y)) && !steps(v(std::min(x + 1, v.width() - 1), y)) &&
               !steps(v(x, std::max(y - 1, 0))) && !steps(v(x, std::min(y + 1, v.height() - 1)));
    }
    std::optional<FilterRamp> ramp_at(const Across& way, int i) const {
        const std::optional<FilterRamp> ramp = ramp_around(way.line, i, way.near_tail);
        const bool is_edge = ramp && way.linear.at(ramp->far) - way.linear.at(ramp->near) > depth_.least_step;
        return is_edge ? ramp : std::nullopt;
    }
    template <typename Body>
    void for_each_row(const Body& body) const {
        parallel_for(depth_.averaged.height(), workers_, body);
    }

    void find_strands() {
        const Plane& d = depth_.averaged;
        is_strand_ = Image<unsigned char>(d.width(), d.height());
        strands_.resize(std::size_t(d.height()));
        for_each_row([&](int y) {
            for (int x = 0; x < d.width(); ++x) {
                if (is_level(x, y)) continue;
                std::optional<NarrowThing> strand;
                for (const bool along_row : {true, false})
                    for (const bool by_average : {true, false})
                        for (const int i : {-1, 0})
                            look_behind(across({x, y}, along_row, by_average), i, x, strand);
                if (!strand) continue;
                is_strand_(x, y) = 1;
                strands_[std::size_t(y)].push_back(*strand);
            }
        });
    }
    // Takes the farthest background, if depth falls back on both sides of the pixel.
    void look_behind(const Across& way, int i, int x, std::optional<NarrowThing>& strand) const {
        constexpr float kFallsBack = 0.2f;  // of the ramp's height
        const std::optional<FilterRamp> ramp = ramp_at(way, i);
        if (!ramp || ramp->near != 0) return;
        const auto falls_back = [&](int j) {
            return way.line.at(j) - way.line.at(0) > kFallsBack * ramp->height;
        };
        if (!falls_back(-ramp->away()) && !falls_back(-2 * ramp->away())) return;
        const Spot behind = way.line.place(ramp->far), beyond = way.line.place(ramp->far + ramp->away());
        const float depth = depth_.averaged(behind.x, behind.y);
        if (!strand || depth > strand->behind) strand = {x, depth, colour_(beyond.x, beyond.y)};
    }

    // A strand's pixels show the strand and its background in different shares. Those with the most of it
    // have the nearest depth; a pixel takes theirs if it mixes their colour with the background in the shares
    // that follow from its depth. Before a sky, that would be true of every nearer strand: what may be whole
    // stays.
    Plane with_whole_strands() const {
        constexpr int kReach = 6;  // px
        Plane out = depth_.averaged.clone();
        for_each_row([&](int y) {
            for (const NarrowThing& strand : strands_[std::size_t(y)]) {
                const bool may_be_whole = has_its_own_surface(strand.x, y);
                float& nearest = out(strand.x, y);
                const Rect around =
                    Rect{strand.x, y, strand.x + 1, y + 1}.grown(kReach).intersected(is_strand_.rect());
                for (int v = around.y0; v < around.y1; ++v)
                    for (int u = around.x0; u < around.x1; ++u)
                        if (is_strand_(u, v) && depth_.averaged(u, v) < nearest &&
                            is_mixture(strand, {strand.x, y}, {u, v}, may_be_whole))
                            nearest = depth_.averaged(u, v);
            }
        });
        return out;
    }
    // True if two pixels next to it have the same depth. Mixtures have it by chance.
    bool has_its_own_surface(int x, int y) const {
        constexpr float kSame = 0.01f;  // of the depth
        const Plane& d = depth_.averaged;
        const Rect around = Rect{x - 1, y - 1, x + 2, y + 2}.intersected(is_strand_.rect());
        int same = -1;  // the loop counts the pixel itself, too
        for (int v = around.y0; v < around.y1; ++v)
            for (int u = around.x0; u < around.x1; ++u)
                same += std::abs(d(u, v) - d(x, y)) < kSame * std::abs(d(x, y));
        return same >= 2;
    }
    bool is_mixture(const NarrowThing& strand, Spot at, Spot more, bool may_be_whole) const {
        constexpr float kUnlike = 0.2f;  // of the contrast, squared
        constexpr float kWhole = 0.98f;
        const float nearer = depth_.averaged(more.x, more.y);
        const float share = (strand.behind - depth_.averaged(at.x, at.y)) / (strand.behind - nearer);
        if (may_be_whole && share > kWhole) return false;
        const Rgba own = colour_(at.x, at.y) - strand.colour_behind,
                   whole = colour_(more.x, more.y) - strand.colour_behind;
        return squared(own - share * whole) < kUnlike * (squared(own) + squared(whole));
    }

    // The depth of the near end of the ramp that the pixel is inside of, or of the far one.
    float of_one_side(Spot at, const Plane& raised) const {
        float height = 0, depth = raised(at.x, at.y);
        for (const bool by_average : {true, false}) {
            for (const bool along_row : {true, false}) {
                const Across way = across(at, along_row, by_average);
                const int i = std::abs(way.line.step(0)) > std::abs(way.line.step(-1)) ? 0 : -1;
                const std::optional<FilterRamp> ramp = ramp_at(way, i);
                if (!ramp || !ramp->is_between(0) || ramp->height <= height) continue;
                height = ramp->height;
                const Spot near = way.line.place(ramp->near), far = way.line.place(ramp->far);
                const Plane& d = depth_.averaged;
                const float middle = 0.5f * (d(near.x, near.y) + d(far.x, far.y));
                const Spot side = d(at.x, at.y) < middle ? near : far;
                depth = raised(side.x, side.y);
            }
            if (height > 0) break;
        }
        return depth;
    }

    View<const Rgba> colour_;
    FilteredDepth depth_;
    Workers& workers_;
    Image<unsigned char> is_strand_;
    std::vector<std::vector<NarrowThing>> strands_;  // by row
};

}  // namespace

Plane without_filter(View<const Rgba> colour, const FilteredDepth& depth, Workers& workers) {
    return Filtered(colour, depth, workers).without();
}

}  // namespace petzval
