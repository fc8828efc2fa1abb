// petzval_bench_crops SHARP RESULT TRUTH EXPOSURE SHEET: where a picture is farthest from its truth. The
// twelve worst squares of 48 pixels that do not overlap, worst first, as a contact sheet, twice as large:
// sharp, result, truth, and four times the difference on grey. Prints the squares as JSON, with the share
// that each has of all squared error.
#include "petzval/develop.h"
#include "petzval/files.h"

#include "process.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace petzval;
using bench::fail;

constexpr int kSquare = 48, kStep = 8, kCrops = 12;

Picture read(const char* path) {
    ReadOptions options;
    options.need_depth = false;
    auto frame = read_frame(path, options);
    if (!frame) fail(frame.error().message);
    return std::move(frame->colour);
}

// Linear light clipped to 0…1, as it is compared.
Rgba shown(Rgba c, float exposure) {
    const auto clip = [&](float v) { return std::clamp(v * exposure, 0.0f, 1.0f); };
    return {clip(c.r), clip(c.g), clip(c.b), 1};
}

struct Crop {
    int x = 0, y = 0;
    double error = 0;
    bool overlaps(const Crop& other) const {
        return std::abs(x - other.x) < kSquare && std::abs(y - other.y) < kSquare;
    }
};

class Sheet {
public:
    Sheet(const Picture& sharp, const Picture& result, const Picture& truth, float exposure)
        : sharp_(sharp), result_(result), truth_(truth), exposure_(exposure) {}

    std::vector<Crop> worst() const {
        std::vector<Crop> all, chosen;
        for (int y = 0; y + kSquare <= truth_.height(); y += kStep)
            for (int x = 0; x + kSquare <= truth_.width(); x += kStep)
                all.push_back({x, y, error_in({x, y, x + kSquare, y + kSquare})});
        std::stable_sort(all.begin(), all.end(),
                         [](const Crop& a, const Crop& b) { return a.error > b.error; });
        for (const Crop& crop : all) {
            const auto overlaps = [&](const Crop& other) { return crop.overlaps(other); };
            if (chosen.size() < kCrops && std::none_of(chosen.begin(), chosen.end(), overlaps))
                chosen.push_back(crop);
        }
        return chosen;
    }
    double error_in(const Rect& square) const {
        double sum = 0;
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const Rgba d = difference(x, y);
                sum += double(d.r * d.r + d.g * d.g + d.b * d.b);
            }
        return sum;
    }
    Picture drawn(const std::vector<Crop>& crops) const {
        constexpr int kColumns = 3, kPanels = 4, kScale = 2, kGap = 4, kPanel = kScale * kSquare + kGap;
        const int rows = (int(crops.size()) + kColumns - 1) / kColumns;
        Picture sheet(kColumns * (kPanels * kPanel + kGap), rows * (kPanel + kGap));
        for (int i = 0; i < int(crops.size()); ++i)
            for (int panel = 0; panel < kPanels; ++panel)
                for (int y = 0; y < kScale * kSquare; ++y)
                    for (int x = 0; x < kScale * kSquare; ++x)
                        sheet(i % kColumns * (kPanels * kPanel + kGap) + panel * kPanel + x,
                              i / kColumns * (kPanel + kGap) + y) =
                            pixel(panel, crops[std::size_t(i)].x + x / kScale,
                                  crops[std::size_t(i)].y + y / kScale);
        return sheet;
    }

private:
    Rgba difference(int x, int y) const {
        return shown(result_(x, y), exposure_) - shown(truth_(x, y), exposure_);
    }
    Rgba pixel(int panel, int x, int y) const {
        const Picture* const pictures[] = {&sharp_, &result_, &truth_};
        if (panel < 3) return exposure_ * (*pictures[panel])(x, y);
        return Rgba{0.2f, 0.2f, 0.2f, 1} + 4 * difference(x, y);
    }

    const Picture &sharp_, &result_, &truth_;
    float exposure_;
};

}  // namespace

int main(int count, char** words) {
    if (count != 6) fail("SHARP RESULT TRUTH EXPOSURE SHEET");
    const Picture sharp = read(words[1]), result = read(words[2]), truth = read(words[3]);
    for (const Picture* p : {&sharp, &result})
        if (p->rect() != truth.rect()) fail("the pictures are not of one size");
    const Sheet sheet(sharp, result, truth, float(std::atof(words[4])));
    const std::vector<Crop> crops = sheet.worst();
    if (crops.empty()) fail("the pictures are smaller than 48 x 48 pixels");
    DevelopSettings settings;
    settings.tone = ToneCurve::None, settings.dither = false;
    const Picture drawn = sheet.drawn(crops);
    if (const Status status =
            write_png(words[5], {drawn.width(), drawn.height(), 3, 8, develop(drawn, settings)});
        !status)
        fail(status.error().message);
    const double all = sheet.error_in(truth.rect());
    std::printf("[");
    for (const Crop& crop : crops)
        std::printf("%s{\"x\": %d, \"y\": %d, \"share\": %.4f}", &crop == crops.data() ? "" : ", ", crop.x,
                    crop.y, all > 0 ? crop.error / all : 0);
    std::printf("]\n");
    return 0;
}
