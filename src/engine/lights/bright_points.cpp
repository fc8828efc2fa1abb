#include "engine/lights/bright_points.h"

#include "base/parallel.h"
#include "engine/lights/highlights.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace petzval::engine {
namespace {

constexpr float kWithinPixelPx = 0.5f;  // light that is out of focus by less needs no kernel

// Of a pixel, that sample which shows most of its light: what is hidden keeps its own.
struct Brightest {
    std::size_t sample = 0;  // from the first of the pixel
    float share = 0;         // of its light that shows
};

Brightest brightest_of(std::span<const CocSample> samples) {
    Brightest brightest;
    float open = 1, most = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        const CocSample& s = samples[k];
        const float seen = std::min(s.colour.a, open), shown = s.colour.a > 0 ? seen / s.colour.a : open;
        if (const float light = shown * luminance(s.colour); light > most)
            brightest = {k, shown}, most = light;
        open -= seen;
    }
    return brightest;
}

Rgba with_light(Rgba light, float alpha) { return {light.r, light.g, light.b, alpha}; }

}  // namespace

BrightPoints::BrightPoints(const Input& frame) : frame_(frame) {
    if (!are_looked_for(frame)) return;
    const HighlightSplit split(frame, {.factor = float(frame.sprites.bright_factor),
                                       .least_floor = 1,
                                       .floor_at_1px = 0,
                                       .contested_floor = 1});
    struct Row {
        std::vector<Sprite> sprites;
        std::vector<Taken> taken;
    };
    std::vector<Row> rows{std::size_t(frame.height())};
    parallel_for(frame.height(), *frame.workers, [&](int y) {
        find_in_row(split, y, rows[std::size_t(y)].sprites, rows[std::size_t(y)].taken);
    });
    for (const Row& row : rows) {
        sprites_.insert(sprites_.end(), row.sprites.begin(), row.sprites.end());
        taken_.insert(taken_.end(), row.taken.begin(), row.taken.end());
    }
}

void BrightPoints::find_in_row(const HighlightSplit& split, int y, std::vector<Sprite>& sprites,
                               std::vector<Taken>& taken) const {
    const View<const Rgba> judged = frame_.judged();
    for (int x = 0; x < frame_.width(); ++x) {
        const Rgba light = judged(x, y);
        const float coc = frame_.coc_px(x, y), brightness = luminance(light);
        if (std::abs(coc) <= kWithinPixelPx || brightness <= 0) continue;
        const float stays = luminance(split.base(x, y, coc, light)) / brightness;
        if (stays >= 1) continue;
        Rgba bright = (1 - stays) * frame_.colour(x, y);
        float radius_px = 0;
        std::size_t sample = 0;
        if (frame_.deep.empty()) {
            radius_px = radius_of_brightest(judged, frame_.coc_px, x, y);
        } else {
            const auto samples = frame_.deep.at(x, y);
            const Brightest from = brightest_of(samples);
            if (from.share <= 0) continue;
            const CocSample& s = samples[from.sample];
            const auto most = [&](float of_sample, float wanted) {
                return std::clamp(from.share * of_sample, 0.0f, std::max(0.0f, wanted));
            };
            bright = {most(s.colour.r, bright.r), most(s.colour.g, bright.g), most(s.colour.b, bright.b), 0};
            radius_px = s.coc_px;
            sample = std::size_t(&s - frame_.deep.samples().data());
        }
        sprites.push_back({float(x) + 0.5f, float(y) + 0.5f, radius_px, bright.r, bright.g, bright.b});
        taken.push_back({stays, sample});
    }
}

BrightPoints::Rest BrightPoints::rest(int first_row, int last_row) const {
    Rest rest;
    rest.input_ = frame_.rows(first_row, last_row);
    Input& input = rest.input_;
    const auto row_of = [](const Sprite& s) { return int(s.y); };
    const auto begin = std::ranges::lower_bound(sprites_, first_row, {}, row_of) - sprites_.begin(),
               end = std::ranges::lower_bound(sprites_, last_row, {}, row_of) - sprites_.begin();
    if (begin == end) return rest;
    const auto less = [&](View<const Rgba>& picture, Picture& copy, View<const Rgba>& lit) {
        lit = picture;
        copy = Picture::uninitialised(picture.width(), picture.height());
        parallel_for(picture.height(), *input.workers, [&](int y) {
            for (int x = 0; x < lit.width(); ++x) copy(x, y) = lit(x, y);
        });
        for (auto i = begin; i < end; ++i) {
            const Sprite& s = sprites_[std::size_t(i)];
            Rgba& at = copy(int(s.x), int(s.y) - first_row);
            at = with_light(taken_[std::size_t(i)].stays * at, at.a);
        }
        picture = copy;
    };
    less(input.colour, rest.colour_, input.lit);
    if (!input.picture.empty()) less(input.picture, rest.picture_, input.lit_picture);
    if (input.deep.empty()) return rest;

    const auto all_first = input.deep.first();
    const auto samples =
        input.deep.samples().subspan(all_first.front(), all_first.back() - all_first.front());
    rest.samples_.width = input.width();
    rest.samples_.samples.assign(samples.begin(), samples.end());
    rest.samples_.first.reserve(all_first.size());
    std::ranges::transform(all_first, std::back_inserter(rest.samples_.first),
                           [&](std::size_t i) { return i - all_first.front(); });
    for (auto i = begin; i < end; ++i) {
        const Sprite& s = sprites_[std::size_t(i)];
        Rgba& from = rest.samples_.samples[taken_[std::size_t(i)].sample - all_first.front()].colour;
        from -= {s.r, s.g, s.b, 0};
    }
    input.deep = rest.samples_;
    return rest;
}

std::size_t BrightPoints::bytes_beside(int rows) const {
    if (empty()) return 0;
    const std::size_t pixels = std::size_t(frame_.width()) * std::size_t(rows),
                      deep = frame_.deep.samples().size_bytes() + frame_.deep.first().size_bytes();
    return count() * (sizeof(Sprite) + sizeof(Taken)) +
           deep * std::size_t(rows) / std::size_t(frame_.height()) +
           pixels * sizeof(Rgba) * (frame_.picture.empty() ? 1 : 2);
}

}  // namespace petzval::engine
