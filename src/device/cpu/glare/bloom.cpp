#include "device/cpu/glare/bloom.h"

#include "base/parallel.h"

#include <algorithm>
#include <vector>

namespace petzval::device {

using glare::BloomPlan;

namespace {

// Index in 0…n-1 of a mirror image that repeats the border pixel.
int mirrored(int i, int n) {
    const int period = 2 * n;
    i = ((i % period) + period) % period;
    return i < n ? i : period - 1 - i;
}

Picture halved(const Picture& fine, Workers& workers) {
    constexpr float kWeight[4] = {0.125f, 0.375f, 0.375f, 0.125f};
    Picture coarse(fine.width() / 2, fine.height() / 2);
    parallel_for(coarse.height(), workers, [&](int y) {
        const Rgba* rows[4];
        for (int k = 0; k < 4; ++k) rows[k] = fine.row(mirrored(2 * y - 1 + k, fine.height()));
        for (int x = 0; x < coarse.width(); ++x) {
            Rgba sum;
            for (int k = 0; k < 4; ++k) {
                const int column = mirrored(2 * x - 1 + k, fine.width());
                Rgba down;
                for (int j = 0; j < 4; ++j) down += kWeight[j] * rows[j][column];
                sum += kWeight[k] * down;
            }
            coarse(x, y) = sum;
        }
    });
    return coarse;
}

// fine += coarse, interpolated.
void add_doubled(Picture& fine, const Picture& coarse, Workers& workers) {
    parallel_for(fine.height(), workers, [&](int y) {
        const int j = y / 2;
        const Rgba* near_row = coarse.row(j);
        const Rgba* far_row = coarse.row(mirrored(y % 2 ? j + 1 : j - 1, coarse.height()));
        for (int x = 0; x < fine.width(); ++x) {
            const int i = x / 2, other = mirrored(x % 2 ? i + 1 : i - 1, coarse.width());
            fine(x, y) +=
                0.5625f * near_row[i] + 0.1875f * (near_row[other] + far_row[i]) + 0.0625f * far_row[other];
        }
    });
}

Picture blurred(const Picture& in, const BloomPlan::Blur& blur, Workers& workers) {
    Picture across(in.width(), in.height()), out(in.width(), in.height());
    const std::vector<float>&wx = blur.across, &wy = blur.down;
    const int rx = int(wx.size()) / 2, ry = int(wy.size()) / 2;
    parallel_for(in.height(), workers, [&](int y) {
        std::vector<Rgba> row(std::size_t(in.width() + 2 * rx));
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = in(mirrored(int(i) - rx, in.width()), y);
        for (int x = 0; x < in.width(); ++x) {
            Rgba sum;
            for (std::size_t k = 0; k < wx.size(); ++k) sum += wx[k] * row[std::size_t(x) + k];
            across(x, y) = sum;
        }
    });
    parallel_for(in.height(), workers, [&](int y) {
        for (int k = -ry; k <= ry; ++k) {
            const Rgba* row = across.row(mirrored(y + k, in.height()));
            const float weight = wy[std::size_t(k + ry)];
            for (int x = 0; x < in.width(); ++x) out(x, y) += weight * row[x];
        }
    });
    return out;
}

// Sides rounded up, filled with the mirror image.
Picture padded(const Picture& light, const BloomPlan& plan) {
    Picture out(plan.padded(light.width()), plan.padded(light.height()));
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out(x, y) = light(mirrored(x, light.width()), mirrored(y, light.height()));
    return out;
}

}  // namespace

Picture bloom(const Picture& light, const BloomPlan& plan, Workers& workers) {
    std::vector<Picture> levels, layers;
    levels.push_back(padded(light, plan));
    for (int l = 0; l < plan.coarsest; ++l) levels.push_back(halved(levels.back(), workers));
    for (const Picture& level : levels) layers.emplace_back(level.width(), level.height());
    for (const BloomPlan::Blur& blur : plan.blurs) {
        const Picture layer = blurred(levels[std::size_t(blur.level)], blur, workers);
        Picture& sum = layers[std::size_t(blur.level)];
        for (std::size_t i = 0; i < sum.size(); ++i) sum.pixels()[i] += plan.share() * layer.pixels()[i];
    }
    for (std::size_t l = layers.size(); l-- > 1;) add_doubled(layers[l - 1], layers[l], workers);
    Picture out(light.width(), light.height());
    for (int y = 0; y < out.height(); ++y)
        std::copy_n(layers[0].row(y), std::size_t(out.width()), out.row(y));
    return out;
}

}  // namespace petzval::device
