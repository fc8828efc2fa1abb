#include "engine/samples/behind/out_of_sight.h"

#include "base/parallel.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::engine {
namespace {

using laws::kOpaque;
// Largest step of the radius from pixel to pixel within one sheet: visible samples, and hidden ones.
constexpr float kShownStepPx = laws::kConnected.step_px, kHiddenStepPx = laws::kHiddenSheet.step_px;
constexpr float kMarginPx = 1.5f;  // pixels have a width; with half a pixel less the meadow loses 0.5 dB

// Opaque samples that continue from pixel to pixel are a sheet, of any shape. A sample behind it, at pixel p
// and radius c, is seen past the sheet's end at pixel q and radius n if |q - p| <= c - n: from c = n + |q -
// p| on. The least of that over all ends is a distance transform within the sheet (two-sweep chamfer, G.
// Borgefors 1986).
class Sheets {
public:
    Sheets(const CocSamples& samples, double stretch, const OpenEdges& open)
        : all_(samples),
          per_px_(1 / float(stretch)),
          open_(open),
          seen_from_(samples.samples.size(), kNever) {
        for (int y = 0; y < all_.height(); ++y)
            for (int x = 0; x < all_.width; ++x) find_ends(x, y);
        for (int y = 0; y < all_.height(); ++y)
            for (int x = 0; x < all_.width; ++x) relax(x, y, 1);
        for (int y = all_.height() - 1; y >= 0; --y)
            for (int x = all_.width - 1; x >= 0; --x) relax(x, y, -1);
    }
    // True if samples `first` … k - 1 hide sample k from every ray.
    bool hide(std::size_t first, std::size_t k) const {
        const float own = all_.samples[k].coc_px;
        for (std::size_t j = first; j < k; ++j)
            if (is_opaque(j) && all_.samples[j].coc_px < own - laws::kOwnSurfacePx &&
                own + kMarginPx * per_px_ < seen_from_[j])
                return true;
        return false;
    }

private:
    static constexpr float kNever = 1e30f;

    std::size_t pixel(int x, int y) const {
        return std::size_t(y) * std::size_t(all_.width) + std::size_t(x);
    }
    bool is_opaque(std::size_t k) const { return all_.samples[k].colour.a > kOpaque; }
    static constexpr std::size_t kNone = std::size_t(-1);
    // The opaque sample of a pixel whose radius is nearest to `coc_px`, within `tolerance_px`, or kNone.
    std::size_t nearest(std::size_t pixel, float coc_px, float tolerance_px) const {
        std::size_t best = kNone;
        for (std::size_t k = all_.first[pixel]; k < all_.first[pixel + 1]; ++k)
            if (const float apart = std::abs(all_.samples[k].coc_px - coc_px);
                apart <= tolerance_px && is_opaque(k))
                best = k, tolerance_px = apart;
        return best;
    }
    // The sample of pixel (x + dx, y + dy) that continues the sheet of sample k of (x, y), or kNone. Visible
    // samples farther apart are one sheet, unless either continues behind the other.
    std::size_t next(std::size_t k, int x, int y, int dx, int dy) const {
        const float own = all_.samples[k].coc_px;
        const std::size_t here = pixel(x, y), there = pixel(x + dx, y + dy), shown = all_.first[there];
        const std::size_t alike = nearest(there, own, kHiddenStepPx);
        if (alike != kNone || k != all_.first[here] || shown == all_.first[there + 1]) return alike;
        const float beside = all_.samples[shown].coc_px;
        const bool connected = is_opaque(shown) && std::abs(beside - own) <= kShownStepPx;
        return connected && nearest(here, beside, kHiddenStepPx) == kNone ? shown : kNone;
    }
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < all_.width && y < all_.height(); }
    template <typename Visit>
    void for_opaque(int x, int y, const Visit& visit) const {
        for (std::size_t k = all_.first[pixel(x, y)]; k < all_.first[pixel(x, y) + 1]; ++k)
            if (is_opaque(k)) visit(k);
    }
    void find_ends(int x, int y) {
        const struct {
            int dx, dy;
            bool open;  // the picture continues beyond this edge
        } sides[] = {{-1, 0, open_.left}, {1, 0, open_.right}, {0, -1, open_.top}, {0, 1, open_.bottom}};
        for_opaque(x, y, [&](std::size_t k) {
            for (const auto& [dx, dy, open] : sides)
                if (contains(x + dx, y + dy) ? next(k, x, y, dx, dy) == kNone : !open)
                    seen_from_[k] = all_.samples[k].coc_px;
        });
    }
    // Takes distances from the pixels before (x, y), for a sweep in this direction.
    void relax(int x, int y, int sense) {
        // Chamfer weights that never exceed the true distance.
        constexpr float kSide = 0.918f, kDiagonal = 1.316f;
        for_opaque(x, y, [&](std::size_t k) {
            for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
                if (!contains(x + sense * dx, y + sense * dy)) continue;
                const std::size_t from = next(k, x, y, sense * dx, sense * dy);
                const float step = per_px_ * (dx != 0 && dy != 0 ? kDiagonal : kSide);
                if (from != kNone) seen_from_[k] = std::min(seen_from_[k], seen_from_[from] + step);
            }
        });
    }

    const CocSamples& all_;
    float per_px_;
    OpenEdges open_;
    std::vector<float> seen_from_;  // per opaque sample: samples behind it are visible from this radius on
};

}  // namespace

void drop_out_of_sight(CocSamples& samples, double stretch, const OpenEdges& open, Workers& workers) {
    if (samples.first.empty() || samples.samples.size() < samples.first.size()) return;
    const Sheets sheets(samples, stretch, open);
    std::vector<unsigned char> hidden(samples.samples.size());
    parallel_for(samples.height(), workers, [&](int y) {
        for (int x = 0; x < samples.width; ++x) {
            const std::size_t pixel = std::size_t(y) * std::size_t(samples.width) + std::size_t(x);
            for (std::size_t k = samples.first[pixel] + 1; k < samples.first[pixel + 1]; ++k)
                hidden[k] = sheets.hide(samples.first[pixel], k);
        }
    });
    std::size_t kept = 0, before = 0;
    for (std::size_t i = 0; i + 1 < samples.first.size(); ++i) {
        const std::size_t end = samples.first[i + 1];
        for (std::size_t k = before; k < end; ++k)
            if (!hidden[k]) samples.samples[kept++] = samples.samples[k];
        before = end, samples.first[i + 1] = kept;
    }
    samples.samples.resize(kept);
}

}  // namespace petzval::engine
