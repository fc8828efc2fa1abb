#include "engine/lights/bright_points.h"

#include "base/parallel.h"
#include "engine/lights/highlights.h"
#include "engine/samples/behind/plate.h"
#include "engine/samples/deep/end_of_pixel.h"
#include "engine/samples/seen_first.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

Rgba with_light(Rgba light, float alpha) { return {light.r, light.g, light.b, alpha}; }

// Share of the light at this place and radius that is not a bright point.
float share_that_stays(const HighlightSplit& split, int x, int y, float coc_px, Rgba light) {
    const float brightness = luminance(light);
    if (std::abs(coc_px) <= laws::kWithinPixelPx || brightness <= 0 || split.is_dim(brightness, light.a))
        return 1;
    return luminance(split.base(x, y, coc_px, light)) / brightness;
}

}  // namespace

BrightPoints::BrightPoints(const EngineView& frame) : frame_(frame) {
    if (!frame.options.lights().find) return;
    const HighlightSplit split(frame, {.factor = float(frame.options.lights().bright_factor),
                                       .least_floor = 1,
                                       .floor_at_1px = 0,
                                       .contested_floor = 1});
    std::vector<Row> rows{std::size_t(frame.height())};
    parallel_for(frame.height(), *frame.services.workers,
                 [&](int y) { rows[std::size_t(y)] = row(split, y); });
    for (const Row& row : rows) {
        sprites_.insert(sprites_.end(), row.sprites.begin(), row.sprites.end());
        taken_.insert(taken_.end(), row.taken.begin(), row.taken.end());
    }
}

void BrightPoints::Row::add(int x, int y, float coc_px, Rgba light, const Taken& from) {
    sprites.push_back({float(x) + 0.5f, float(y) + 0.5f, coc_px, light.r, light.g, light.b});
    taken.push_back(from);
}

BrightPoints::Row BrightPoints::row(const HighlightSplit& split, int y) const {
    const View<const Rgba> judged = frame_.samples.judged();
    Row row;
    for (int x = 0; x < frame_.width(); ++x) {
        const CocSamplesView& deep = frame_.samples.deep;
        const bool is_stated = frame_.samples.are_stated();
        if (is_stated && !is_flat_pixel(deep, x, y)) {
            if (!frame_.samples.deep_dims_itself) find_in_samples(split, x, y, row);
            continue;
        }
        const float stays = share_that_stays(split, x, y, frame_.samples.coc_px(x, y), judged(x, y));
        if (stays < 1)
            row.add(x, y, radius_of_brightest(judged, frame_.samples.coc_px, x, y),
                    (1 - stays) * frame_.samples.colour(x, y),
                    {stays, 1, is_stated ? std::size_t(deep.at(x, y).data() - deep.samples().data()) : 0});
        const CleanPlate& plate = frame_.samples.plate;
        if (plate.empty() || plate.is_out_of_sight(x, y) ||
            !is_before_plate(frame_.samples.coc_px(x, y), plate.coc_px(x, y)))
            continue;
        const float behind = share_that_stays(split, x, y, plate.coc_px(x, y), plate.colour(x, y));
        if (behind < 1)
            row.add(x, y, plate.coc_px(x, y), (1 - behind) * plate.colour(x, y), {behind, 1, 0, true});
    }
    return row;
}

// Takes the visible part of each sample, and of hidden samples all light that the background would draw. (The
// rest of a partly visible sample lies behind an edge within its pixel, which is too fine for the shadows of
// sprites.)
void BrightPoints::find_in_samples(const HighlightSplit& split, int x, int y, Row& row) const {
    Rgba drawn;
    const auto add = [&](Rgba light, float, float, bool) { drawn += light; };
    SeenFirst take(add);
    float open = 1;
    for (const CocSample& s : frame_.samples.deep.at(x, y)) {
        const float covered = s.colour == Rgba{} ? 1.0f : s.colour.a;
        const float shows = covered > 0 ? std::min(covered, open) / covered : 1.0f;
        drawn = {};
        take(s.colour, s.coc_px, covered);
        open -= shows * covered;
        const float stays = share_that_stays(split, x, y, s.coc_px, s.colour);
        if (stays >= 1 || luminance(drawn) <= 0) continue;
        const float all = luminance(drawn) / luminance(s.colour),
                    taken = (1 - stays) * (shows > 0 ? shows : all);
        row.add(x, y, s.coc_px, taken * s.colour,
                {1 - taken / all, shows > 0 ? all : 0.0f,
                 std::size_t(&s - frame_.samples.deep.samples().data())});
    }
}

BrightPoints::Rest BrightPoints::rest(int first_row, int last_row) const {
    Rest rest;
    rest.input_ = frame_.rows(first_row, last_row);
    EngineView& input = rest.input_;
    const auto first_in = [&](int row) {
        const auto is_above = [](const Sprite& s, int y) { return int(s.y) < y; };
        return std::size_t(std::lower_bound(sprites_.begin(), sprites_.end(), row, is_above) -
                           sprites_.begin());
    };
    const std::size_t begin = first_in(first_row), end = first_in(last_row);
    if (begin == end) return rest;
    rest.colour_ = without(input.samples.colour, begin, end, first_row);
    input.samples.colour = rest.colour_;
    if (!input.samples.picture.empty()) {
        rest.picture_ = without(input.samples.picture, begin, end, first_row);
        input.samples.picture = rest.picture_;
    }
    if (!input.samples.plate.empty()) {
        CleanPlate& plate = input.samples.plate;
        rest.plate_ = without(plate.colour, begin, end, first_row, true);
        for (int y = 0; y < rest.plate_.height(); ++y)
            for (int x = 0; x < rest.plate_.width(); ++x)
                if (!is_before_plate(input.samples.coc_px(x, y), plate.coc_px(x, y)))
                    rest.plate_(x, y) = rest.colour_(x, y);
        plate.colour = rest.plate_;
    } else if (!input.samples.deep.empty())
        input.samples.deep = rest.samples_ = samples_without(input.samples.deep, begin, end);
    return rest;
}

Picture BrightPoints::without(View<const Rgba> picture, std::size_t begin, std::size_t end, int first_row,
                              bool of_plate) const {
    Picture rest = Picture::uninitialised(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), rest.row(y));
    for (std::size_t i = begin; i < end; ++i) {
        const Taken& taken = taken_[i];
        if (taken.on_plate != of_plate) continue;
        Rgba& at = rest(int(sprites_[i].x), int(sprites_[i].y) - first_row);
        const Rgba all =
            !frame_.samples.are_stated() ? at : frame_.samples.deep.samples()[taken.sample].colour;
        at = with_light(at - taken.seen * (1 - taken.stays) * all, at.a);
    }
    return rest;
}

CocSamples BrightPoints::samples_without(const CocSamplesView& deep, std::size_t begin,
                                         std::size_t end) const {
    const std::size_t first = deep.first().front();
    const auto samples = deep.samples().subspan(first, deep.first().back() - first);
    CocSamples rest;
    rest.width = deep.width();
    rest.samples.assign(samples.begin(), samples.end());
    for (const std::size_t i : deep.first()) rest.first.push_back(i - first);
    for (std::size_t i = begin; i < end; ++i) {
        Rgba& from = rest.samples[taken_[i].sample - first].colour;
        from = with_light(taken_[i].stays * from, from.a);
    }
    return rest;
}

std::size_t BrightPoints::bytes_beside(int rows) const {
    if (empty()) return 0;
    const std::size_t pixels = std::size_t(frame_.width()) * std::size_t(rows),
                      deep = frame_.samples.deep.samples().size_bytes() +
                             frame_.samples.deep.first().size_bytes();
    return count() * (sizeof(Sprite) + sizeof(Taken)) +
           deep * std::size_t(rows) / std::size_t(frame_.height()) +
           pixels * sizeof(Rgba) *
               (1 + std::size_t(!frame_.samples.picture.empty()) +
                std::size_t(!frame_.samples.plate.empty()));
}

}  // namespace petzval::engine
