#include "engine/samples/out_of_sight.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::engine {
namespace {

constexpr float kOpaque = 1 - 1e-3f;
constexpr float kSheetPx = 0.5f;  // change of radius within which it is one sheet
constexpr float kNoRoomPx = 0.2f;
// Pixels, and samples of a pixel: more take longer to look through than they save.
constexpr int kWidest = 12;
constexpr std::size_t kMostSamples = 64;

class Sheets {
public:
    Sheets(const CocSamples& samples, double stretch)
        : samples_(samples), view_(samples), stretch_(stretch) {}

    // Whether the last opaque sample before number k of pixel (x, y) hides it from every ray.
    bool hide(int x, int y, std::size_t k) const {
        const auto here = view_.at(x, y);
        const float own = here[k].coc_px;
        std::size_t j = k;
        while (j > 0 && !(here[j - 1].colour.a > kOpaque && here[j - 1].coc_px < own - kNoRoomPx)) --j;
        if (j == 0) return false;
        const float sheet = here[j - 1].coc_px;
        const double reach = stretch_ * double(own - sheet + kSheetPx) + 1;
        if (reach > kWidest) return false;
        const int r = int(std::ceil(reach));
        if (x < r || y < r || x + r >= samples_.width || y + r >= samples_.height()) return false;
        for (int v = y - r; v <= y + r; ++v)
            for (int u = x - r; u <= x + r; ++u)
                if (!goes_on(u, v, sheet, own)) return false;
        return true;
    }

private:
    bool goes_on(int x, int y, float sheet, float hidden) const {
        const auto here = view_.at(x, y);
        for (const CocSample& s : here.first(std::min(here.size(), kMostSamples)))
            if (s.colour.a > kOpaque && std::abs(s.coc_px - sheet) < kSheetPx &&
                s.coc_px < hidden - kNoRoomPx)
                return true;
        return false;
    }

    const CocSamples& samples_;
    CocSamplesView view_;
    double stretch_;
};

}  // namespace

void drop_out_of_sight(CocSamples& samples, double stretch, Workers& workers) {
    if (samples.first.empty()) return;
    const Sheets sheets(samples, stretch);
    std::vector<unsigned char> hidden(samples.samples.size());
    parallel_for(samples.height(), workers, [&](int y) {
        for (int x = 0; x < samples.width; ++x) {
            const std::size_t pixel = std::size_t(y) * std::size_t(samples.width) + std::size_t(x);
            const std::size_t first = samples.first[pixel], count = samples.first[pixel + 1] - first;
            if (count > kMostSamples) continue;
            // Where one is hidden, so are those behind it.
            for (std::size_t k = count; k-- > 1 && sheets.hide(x, y, k);) hidden[first + k] = 1;
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
