// The start of the data window changes nothing except its border: an autocropped sequence does not flicker.
#include "drawers.h"

namespace petzval::conformance {
namespace {

// Neighbourhood of a pixel that an engine reads, for radii up to largest_px: sources that spread there, their
// occluders and the background of these; the neighbourhood in which lights are distinguished from surfaces;
// and the tile of scatter that is composited as one.
constexpr int margin_px(int largest_px) { return 4 * largest_px + 96; }

class DataWindow : public EveryDrawer {};

DefocusJob cropped(const Shot& shot, DefocusJob job, const Rect& window) {
    job.colour = shot.colour.view().part(window);
    job.coc_px = shot.coc_px.view().part(window);
    job.place.data_window = window;
    return job;
}

// Pixels that differ. Alpha may by its last digit: gather takes it from coverage where nothing is
// transparent.
int changes(const Picture& part, const Picture& whole, const Rect& inside, const Rect& window) {
    int changed = 0;
    for (int y = inside.y0; y < inside.y1; ++y)
        for (int x = inside.x0; x < inside.x1; ++x) {
            const Rgba d = part(x - window.x0, y - window.y0) - whole(x, y);
            changed += d.r != 0 || d.g != 0 || d.b != 0 || std::abs(d.a) > 1e-6f;
        }
    return changed;
}

TEST_P(DataWindow, AnyCropOfItLeavesWhatIsFartherFromItsBorderAsItWas) {
    constexpr int kLargest = 12;
    Shot shot = flat(400, 370, {}, 3);
    paint_rectangles(shot.colour, 4);
    std::mt19937 random(6);
    for (int i = 0; i < 30; ++i) {
        const int x = int(random() % 390), y = int(random() % 360);
        const float coc = float(int(random() % (2 * kLargest + 1)) - kLargest);
        shot.colour(x, y) = {40, 30, 20, 1};
        for (int v = y; v < std::min(370, y + 25); ++v)
            for (int u = x + 2; u < std::min(400, x + 19); ++u) shot.coc_px(u, v) = coc;
    }
    const Picture whole = picture(shot);
    for (const auto& [left, top] : {std::pair{1, 0}, {0, 1}, {4, 2}, {7, 13}, {8, 8}, {31, 5}, {64, 64}}) {
        const Rect window{left, top, 397, 366};
        const Picture part = drawn(cropped(shot, job(shot), window));
        const Rect inside = window.grown(-margin_px(kLargest));
        EXPECT_EQ(changes(part, whole, inside, window), 0) << "cropped by " << left << ", " << top;
    }
}

TEST_P(DataWindow, SoItIsForALensThatDiffersOverTheField) {
    Shot shot = flat(390, 330, {}, 6);
    paint_rectangles(shot.colour, 4);
    DefocusJob whole = job(shot);
    whole.lens.cats_eye = 0.7;
    const Rect window{5, 9, 387, 328};
    const DefocusJob part = cropped(shot, whole, window);
    const Rect inside = window.grown(-margin_px(6));
    EXPECT_EQ(changes(drawn(part), drawn(whole), inside, window), 0);
}

INSTANTIATE_TEST_SUITE_P(Guessing, DataWindow, testing::ValuesIn(guessing_drawers()), name_of_drawer);

}  // namespace
}  // namespace petzval::conformance
