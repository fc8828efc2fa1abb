#include "petzval/seen_elsewhere.h"

#include "shot/landing.h"
#include "shot/other_lamps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace petzval {
namespace {

using namespace shot;

constexpr double kShareThatAgrees = 0.9;   // of a surface that stands still, or moves as it says
constexpr double kShareThatIsAlike = 0.5;  // of what lies at one depth
constexpr std::uint64_t kNobody = std::numeric_limits<std::uint64_t>::max();

// Surfaces of a picture: pixels that touch and lie at one depth, by union and find.
class Surfaces {
public:
    explicit Surfaces(const Shot& shot)
        : depth_(shot.depth_plane()), usable_(depth_.width(), depth_.height()) {
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) usable_(x, y) = is_usable(shot, x, y);
        parent_.resize(usable_.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                if (x > 0 && touch(x, y, x - 1, y)) join(index(x, y), index(x - 1, y));
                if (y > 0 && touch(x, y, x, y - 1)) join(index(x, y), index(x, y - 1));
            }
    }

    bool usable(int x, int y) const { return usable_(x, y) != 0; }
    std::uint32_t of(int x, int y) { return root(index(x, y)); }
    // True if the square right of and below a pixel lies on one surface.
    bool is_whole(int x, int y) const {
        return touch(x, y, x + 1, y) && touch(x, y, x, y + 1) && touch(x + 1, y + 1, x + 1, y) &&
               touch(x + 1, y + 1, x, y + 1);
    }

private:
    // Opaque, and not beside what is nearer, whose light it would hold a part of.
    bool is_usable(const Shot& shot, int x, int y) const {
        const float own = depth_(x, y);
        if (!(own > 0) || shot.colour(x, y).a < laws::kOpaqueElsewhere) return false;
        for (int v = std::max(0, y - 1); v <= std::min(depth_.height() - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(depth_.width() - 1, x + 1); ++u)
                if (own > kSilhouette * depth_(u, v)) return false;
        return true;
    }
    bool touch(int x, int y, int u, int v) const {
        const float a = depth_(x, y), b = depth_(u, v);
        return usable(x, y) && usable(u, v) && laws::same_surface_by_depth(kOneSurface, a, b);
    }
    std::uint32_t index(int x, int y) const {
        return std::uint32_t(y) * std::uint32_t(depth_.width()) + std::uint32_t(x);
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    View<const float> depth_;
    Image<std::uint8_t> usable_;
    std::vector<std::uint32_t> parent_;
};

// The square of four pixels at x, y of another picture, where it lands.
struct Square {
    std::array<Landing, 4> corners;  // top left, top right, bottom left, bottom right
};

// Shares of the four corners at a point of the square; empty outside of it. Its two triangles share the
// diagonal from top right to bottom left.
std::optional<std::array<float, 4>> shares_at(const Square& s, float x, float y) {
    for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 2}, {3, 2, 1}}) {
        const Landing &p = s.corners[a], &q = s.corners[b], &r = s.corners[c];
        const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if (area == 0) continue;
        const float of_b = ((x - p.x) * (r.y - p.y) - (y - p.y) * (r.x - p.x)) / area;
        const float of_c = ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)) / area;
        if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
        std::array<float, 4> shares{};
        shares[a] = 1 - of_b - of_c, shares[b] = of_b, shares[c] = of_c;
        return shares;
    }
    return std::nullopt;
}

float depth_at(const Square& s, const std::array<float, 4>& shares) {
    float nearness = 0;  // 1/depth is what lies on a plane
    for (std::size_t i = 0; i < 4; ++i) nearness += shares[i] / s.corners[i].depth_m;
    return nearness > 0 ? 1 / nearness : std::numeric_limits<float>::infinity();
}

// One other picture on its way to where the shot sees it.
class Other {
public:
    Other(const Shot& other, const Shot& shot, Landings landings, const Bounds& bounds, Workers& workers)
        : other_(other),
          shot_(shot),
          depth_(other.depth_plane()),
          shots_depth_(shot.depth_plane()),
          landings_(std::move(landings.of_pixels)),
          bounds_(bounds),
          workers_(workers),
          surfaces_(other),
          verdicts_(depth_.width(), depth_.height()) {
        find_what_stands();
        if (!landings.by_motion) return;
        follow_depths();
        find_what_stands();
    }

    // Adds the nearest hidden surface of pixels that have none yet.
    void add_to(std::vector<DeepSample>& known) const {
        std::vector<std::uint64_t> nearest(known.size(), kNobody);
        for_rows(depth_.height() - 1, workers_, [&](int y) {
            for (int x = 0; x + 1 < depth_.width(); ++x)
                if (shows_hidden(x, y)) draw(x, y, known, nearest);
        });
        for_rows(height(), workers_, [&](int y) {
            for (int x = 0; x < width(); ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(width()) + std::size_t(x);
                if (nearest[i] != kNobody) known[i] = sample(std::uint32_t(nearest[i]), x, y);
            }
        });
    }

private:
    int width() const { return bounds_.nearest.width(); }
    int height() const { return bounds_.nearest.height(); }
    const Landing& landing(int x, int y) const { return landings_(x, y); }
    Square square(int x, int y) const {
        return {{landing(x, y), landing(x + 1, y), landing(x, y + 1), landing(x + 1, y + 1)}};
    }

    void find_what_stands() {
        for_rows(depth_.height(), workers_, [&](int y) {
            for (int x = 0; x < depth_.width(); ++x)
                if (surfaces_.usable(x, y)) verdicts_(x, y) = verdict_of(landing(x, y), bounds_);
        });
        struct Counts {
            std::uint32_t agree = 0, differ = 0, alike = 0;
        };
        std::vector<Counts> counts(verdicts_.size());
        stands_ = Image<std::uint8_t>(depth_.width(), depth_.height());
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                if (!surfaces_.usable(x, y)) continue;
                Counts& c = counts[surfaces_.of(x, y)];
                const Verdict verdict = verdicts_(x, y);
                c.differ += verdict == Verdict::InFront || verdict == Verdict::JustBehind;
                if (verdict == Verdict::Agrees)
                    ++c.agree, c.alike += look_alike(other_, x, y, shot_, landing(x, y));
            }
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                const Counts& c = counts[surfaces_.of(x, y)];
                stands_(x, y) = double(c.agree) >= kShareThatAgrees * double(c.agree + c.differ) &&
                                double(c.alike) >= kShareThatIsAlike * double(c.agree);
            }
    }

    // Corrects for motion in depth: if the depths of most of a surface disagree, by the median of their
    // ratios.
    void follow_depths() {
        struct Ratios {
            std::vector<float> all;
            std::size_t agree = 0;
        };
        std::map<std::uint32_t, Ratios> of_surface;
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                const Landing& at = landing(x, y);
                if (!surfaces_.usable(x, y) || !(at.depth_m > 0) || std::isinf(at.depth_m)) continue;
                const float u = std::floor(at.x), v = std::floor(at.y);
                if (!(u >= 0 && v >= 0 && u < float(width()) && v < float(height()))) continue;
                const float ratio = shots_depth_(int(u), int(v)) / at.depth_m;
                if (!(ratio > 1 / kSilhouette && ratio < kSilhouette)) continue;
                Ratios& ratios = of_surface[surfaces_.of(x, y)];
                ratios.all.push_back(ratio), ratios.agree += verdicts_(x, y) == Verdict::Agrees;
            }
        std::erase_if(of_surface, [](const auto& s) { return 2 * s.second.agree >= s.second.all.size(); });
        for (auto& [surface, ratios] : of_surface) {
            const auto middle = ratios.all.begin() + std::ptrdiff_t(ratios.all.size() / 2);
            std::nth_element(ratios.all.begin(), middle, ratios.all.end());
            ratios.all.assign(1, *middle);
        }
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x)
                if (const auto found = of_surface.find(surfaces_.of(x, y)); found != of_surface.end())
                    landings_(x, y).depth_m *= found->second.all.front();
    }

    bool shows_hidden(int x, int y) const {
        if (!stands_(x, y) || !surfaces_.is_whole(x, y)) return false;
        for (const int v : {y, y + 1})
            for (const int u : {x, x + 1})
                if (verdicts_(u, v) == Verdict::Hidden || verdicts_(u, v) == Verdict::JustBehind) return true;
        return false;
    }

    void draw(int x, int y, const std::vector<DeepSample>& known, std::vector<std::uint64_t>& nearest) const {
        constexpr float kLargestSquarePx = 8;
        const Square s = square(x, y);
        float x0 = s.corners[0].x, x1 = x0, y0 = s.corners[0].y, y1 = y0;
        for (const Landing& c : s.corners) {
            if (!(c.depth_m > 0)) return;
            x0 = std::min(x0, c.x), x1 = std::max(x1, c.x), y0 = std::min(y0, c.y), y1 = std::max(y1, c.y);
        }
        if (!(x1 - x0 < kLargestSquarePx && y1 - y0 < kLargestSquarePx)) return;
        for (int v = std::max(0, int(std::ceil(y0 - 0.5f))); v < height() && float(v) + 0.5f <= y1; ++v)
            for (int u = std::max(0, int(std::ceil(x0 - 0.5f))); u < width() && float(u) + 0.5f <= x1; ++u) {
                const std::size_t i = std::size_t(v) * std::size_t(width()) + std::size_t(u);
                if (known[i].colour.a > 0) continue;
                const auto shares = shares_at(s, float(u) + 0.5f, float(v) + 0.5f);
                if (!shares) continue;
                if (const float depth = depth_at(s, *shares); depth > bounds_.farthest(u, v))
                    offer(nearest[i], depth, x, y);
            }
    }

    // The nearest wins, of equals the first: in whatever order they come.
    void offer(std::uint64_t& place, float depth, int x, int y) const {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &depth, sizeof bits);  // of positive floats the larger has the larger bits
        const std::uint64_t own =
            std::uint64_t(bits) << 32 | (std::uint32_t(y) * std::uint32_t(depth_.width()) + std::uint32_t(x));
        std::atomic_ref<std::uint64_t> shared(place);
        std::uint64_t there = shared.load(std::memory_order_relaxed);
        while (own < there && !shared.compare_exchange_weak(there, own, std::memory_order_relaxed)) {
        }
    }

    DeepSample sample(std::uint32_t of, int u, int v) const {
        const int x = int(of % std::uint32_t(depth_.width())), y = int(of / std::uint32_t(depth_.width()));
        const Square s = square(x, y);
        const auto shares = shares_at(s, float(u) + 0.5f, float(v) + 0.5f);
        const float depth = depth_at(s, *shares);
        Rgba colour;
        for (std::size_t i = 0; i < 4; ++i)
            colour += (*shares)[i] * other_.colour(x + int(i % 2), y + int(i / 2));
        colour.a = 1;
        return {colour, depth, depth};
    }

    const Shot &other_, &shot_;
    View<const float> depth_, shots_depth_;
    Image<Landing> landings_;
    const Bounds& bounds_;
    Workers& workers_;
    Surfaces surfaces_;
    Image<Verdict> verdicts_;
    Image<std::uint8_t> stands_;
};

// Size of the square that an occluder must fill before its background is used. The background of a thread
// shows on both sides; knowing it behind some of its pixels only adds flicker.
constexpr int kThick = 3;  // px

void drop_behind_thin_things(View<const float> depth, Workers& workers, std::vector<DeepSample>& known) {
    // True if one object hides it in all of the square from there: behind a wire before a box is the box.
    const auto hides = [&](int x0, int y0, float own_m, float known_m) {
        if (!depth.rect().contains(x0, y0) || !depth.rect().contains(x0 + kThick - 1, y0 + kThick - 1))
            return false;
        for (int y = y0; y < y0 + kThick; ++y)
            for (int x = x0; x < x0 + kThick; ++x)
                if (!(depth(x, y) * kOneDepth < known_m && depth(x, y) <= kSilhouette * own_m)) return false;
        return true;
    };
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            DeepSample& s = known[std::size_t(y) * std::size_t(depth.width()) + std::size_t(x)];
            if (!(s.colour.a > 0)) continue;
            bool is_thick = false;
            for (int dy = 0; dy < kThick && !is_thick; ++dy)
                for (int dx = 0; dx < kThick && !is_thick; ++dx)
                    is_thick = hides(x - dx, y - dy, depth(x, y), s.depth);
            if (!is_thick) s = {};
        }
    });
}

// Share of a hidden lamp's light: all of it if seen at the same moment, falling to none beyond the requested
// frames.
float share_of_hidden(const OtherPicture& other, std::span<const OtherPicture> all) {
    int farthest = 0;
    for (const OtherPicture& o : all) farthest = std::max(farthest, std::abs(o.frames_later));
    return 1 - float(std::abs(other.frames_later)) / float(farthest + 1);
}

}  // namespace

Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const OtherPicture> others,
                                     Workers& workers) {
    const bool by_motion = std::any_of(others.begin(), others.end(), [](const OtherPicture& o) {
        return o.frames_later != 0 && (!o.shot->motion.empty() || o.motion_from != MotionReading::From::File);
    });
    if (Status fine = by_motion ? check_depth(shot) : check_eye(shot); !fine) return fine.error();
    const View<const float> depth = shot.depth_plane();
    const Bounds bounds = bounds_of(depth, workers);
    std::vector<DeepSample> known(std::size_t(depth.width()) * std::size_t(depth.height()));
    SeenElsewhere found;
    OtherLamps lamps(shot);
    for (const OtherPicture& other : others) {
        auto landings = landings_of(other, others, shot, bounds, workers);
        if (!landings) {
            found.left_out.push_back(landings.error().message);
            continue;
        }
        found.by_motion += landings->by_motion;
        if (!landings->warning.empty()) found.left_out.push_back(landings->warning);
        lamps.add(*other.shot, landings->of_pixels, share_of_hidden(other, others), workers);
        Other(*other.shot, shot, std::move(*landings), bounds, workers).add_to(known);
    }
    drop_behind_thin_things(depth, workers, known);
    lamps.hide(known);
    found.lamps = lamps.depths();
    for (const DeepSample& s : known) found.pixels += s.colour.a > 0;
    if (found.pixels > 0)
        found.behind = DeepPicture::made_of(depth.width(), depth.height(), [&](int x, int y, auto& samples) {
            const DeepSample& s = known[std::size_t(y) * std::size_t(depth.width()) + std::size_t(x)];
            if (s.colour.a > 0) samples.push_back(s);
        });
    return found;
}

Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const Shot* const> others,
                                     Workers& workers) {
    std::vector<OtherPicture> pictures;
    for (const Shot* other : others) pictures.push_back({other});
    return seen_elsewhere(shot, pictures, workers);
}

void take_over(SeenElsewhere found, Shot& shot) {
    shot.behind = std::move(found.behind);
    if (auto* depth = std::get_if<DepthMetres>(&shot.depth))
        for (const SeenElsewhere::Lamp& lamp : found.lamps) depth->plane(lamp.x, lamp.y) = lamp.depth_m;
}

std::vector<const Shot*> other_eyes(std::span<const Shot* const> views, const Shot& of) {
    std::vector<const Shot*> others;
    for (const Shot* other : views)
        if (other->deep.empty() && other->camera.camera_from_world != of.camera.camera_from_world)
            others.push_back(other);
    return others;
}

std::vector<SeenElsewhere> seen_by_each_other(std::span<const Shot* const> views, Workers& workers) {
    std::vector<SeenElsewhere> all(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!views[i]->deep.empty() || !views[i]->behind.empty()) continue;
        const std::vector<const Shot*> others = other_eyes(views, *views[i]);
        if (others.empty()) continue;
        if (auto seen = seen_elsewhere(*views[i], others, workers)) all[i] = std::move(*seen);
    }
    return all;
}

}  // namespace petzval
