// A clean plate never makes it worse: what it does not hold is guessed as without it.
#include "shots.h"

namespace petzval::conformance {
namespace {

constexpr int kWidth = 150, kHeight = 110;
constexpr float kFarPx = 11;

// Thin slanted strands before a texture; depth is that of the pixel's middle.
struct Strands {
    Shot shot, plate, known;

    explicit Strands(float near_px, float far_px = kFarPx) : shot(flat(kWidth, kHeight, {}, far_px)) {
        paint_rectangles(shot.colour, 12);
        plate = {shot.colour.clone(), Plane(kWidth, kHeight, far_px), {}};
        known = {Picture(kWidth, kHeight), Plane(kWidth, kHeight, far_px), {}};
        const Rgba hair{0.2f, 0.1f, 0.05f, 1};
        const auto draw = [&](int x, int y, std::vector<DeepSample>& samples) {
            const Rgba behind = plate.colour(x, y);
            const float share = covered(float(x), float(y));
            shot.colour(x, y) = share * hair + (1 - share) * behind;
            if (in_strand(float(x) + 0.5f, float(y) + 0.5f)) shot.coc_px(x, y) = near_px;
            known.colour(x, y) = shot.colour(x, y), known.coc_px(x, y) = shot.coc_px(x, y);
            if (share > 0) samples.push_back({share * hair, near_px, near_px});
            if (share > 0) samples.push_back({behind, far_px, far_px});
        };
        known.behind = DeepPicture::made_of(kWidth, kHeight, draw);
    }
    double with_plate() {
        put_behind(
            shot, [&](int x, int y) { return plate.colour(x, y); }, [](int, int) { return kFarPx; });
        return score();
    }
    double known_whole() const { return psnr_inside(truth(256), rendered(known.job("scatter")), 16); }
    double without() {
        shot.behind = {};
        return score();
    }

private:
    static bool in_strand(float x, float y) {
        const float across = std::fmod(x + 0.37f * y + 0.002f * y * y, 13.0f);
        return across < 1.6f;
    }
    static float covered(float x, float y) {
        constexpr int kSide = 8;
        int inside = 0;
        for (int row = 0; row < kSide; ++row)
            for (int column = 0; column < kSide; ++column)
                inside += in_strand(x + (float(column) + 0.5f) / kSide, y + (float(row) + 0.5f) / kSide);
        return float(inside) / (kSide * kSide);
    }
    double score() const { return psnr_inside(truth(1024), rendered(shot.job("scatter")), 16); }
    Picture truth(int points) const {
        DefocusJob truth = known.job("reference");
        truth.pupil_points = points;
        return rendered(truth);
    }
};

TEST(Plate, StrandsComeOutBetterWithWhatIsBehindThem) {
    Strands sharp(0), blurred(-5);
    const double with = sharp.with_plate();
    EXPECT_GT(with, 30);
    EXPECT_GT(with, sharp.without() + 2);
    EXPECT_GT(blurred.with_plate(), 45);
}

TEST(Plate, StrandsStandBeforeWhatNearlyTouchesThem) {
    // Their radii lie in one interval of compositing.
    for (const auto& [near_px, far_px] : {std::pair{2.0f, 2.4f}, {-3.4f, -2.6f}})
        EXPECT_GT(Strands(near_px, far_px).known_whole(), 45) << near_px << " before " << far_px;
}

// Light between the strand of a pixel and a far background belongs to the background.
TEST(Plate, LightThatShinesThroughAStrandIsNotTheStrands) {
    Shot shot = flat(60, 40, {0.2f, 0.2f, 0.2f, 1}, 8);
    const Rgba lamp{100, 100, 100, 1}, strand{0.1f, 0.1f, 0.1f, 1};
    for (int y = 0; y < 40; ++y) shot.colour(30, y) = strand, shot.coc_px(30, y) = 0;
    shot.colour(30, 20) = {11, 11, 11, 1};  // a tenth of the pixel shows the lamp
    shot.behind = DeepPicture::made_of(60, 40, [&](int x, int y, std::vector<DeepSample>& samples) {
        if (x != 30) return;
        samples.push_back({strand, 0, 0});
        samples.push_back({y == 20 ? lamp : Rgba{0.2f, 0.2f, 0.2f, 1}, 8, 8});
    });
    for (const char* engine : {"scatter", "reference"})
        EXPECT_NEAR(rendered(shot.job(engine))(30, 20).g, 0.1, 0.02) << engine;
}

TEST(Plate, OneThatHoldsNothingInFrontChangesNothing) {
    Shot shot = noise_at_several_depths();
    const Picture without = rendered(shot.job("scatter"));
    put_behind(
        shot, [&](int x, int y) { return shot.colour(x, y); },
        [&](int x, int y) { return shot.coc_px(x, y); });
    const Picture with = rendered(shot.job("scatter"));
    EXPECT_GT(psnr_inside(without, with, 0), 50);
}

TEST(Plate, WhatItDoesNotHoldIsFilledIn) {
    // A card in front of another in front of a wall. The plate does not show the first card; the background
    // of the second is estimated.
    Shot shot = flat(150, 90, {}, 9);
    paint_rectangles(shot.colour, 5);
    Shot plate = flat(150, 90, {}, 9);
    plate.colour = shot.colour.clone();
    const auto put = [](Shot& s, const Rect& r, Rgba colour, float coc_px) {
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) s.colour(x, y) = colour, s.coc_px(x, y) = coc_px;
    };
    for (Shot* s : {&shot, &plate}) put(*s, {70, 20, 110, 90}, {0.3f, 0.5f, 0.2f, 1}, -3);
    put(shot, {30, 0, 50, 90}, {0.1f, 0.1f, 0.3f, 1}, -10);
    const Picture without_plate = rendered(plate.job("scatter"));
    const auto put_plate_behind = [&](Shot& s) {
        put_behind(
            s, [&](int x, int y) { return plate.colour(x, y); },
            [&](int x, int y) { return plate.coc_px(x, y); });
    };
    put_plate_behind(shot);
    const Picture with = rendered(shot.job("scatter"));
    Shot second = flat(150, 90, {}, 9);
    second.colour = plate.colour.clone(), second.coc_px = plate.coc_px.clone();
    put_plate_behind(second);
    const Picture alone = rendered(second.job("scatter"));
    // Far from the first card all is as if it were not there: also the edge of the second. Without a plate,
    // the background behind the second card is the same, but some of it shines past its edge that no ray
    // reaches.
    double difference = 0;
    for (int y = 30; y < 60; ++y)
        for (int x = 75; x < 130; ++x) {
            EXPECT_NEAR(with(x, y).g, alone(x, y).g, 1e-4) << x << ", " << y;
            difference += std::abs(double(with(x, y).g) - without_plate(x, y).g) / (30 * 55);
        }
    EXPECT_LT(difference, 1e-3);
}

TEST(Plate, StandsBehindAnElementWithAlpha) {
    Shot shot = flat(120, 80, {0, 0, 0, 0}, 5);
    for (int y = 20; y < 60; ++y)
        for (int x = 30; x < 60; ++x) shot.colour(x, y) = {0.25f, 0.25f, 0.25f, 0.5f}, shot.coc_px(x, y) = 0;
    put_behind(
        shot,
        [](int, int) {
            return Rgba{0.4f, 0.4f, 0.4f, 1};
        },
        [](int, int) { return 5.0f; });
    for (const char* engine : {"scatter", "gather", "reference"}) {
        const Picture image = rendered(shot.job(engine));
        EXPECT_NEAR(image(45, 40).g, 0.45, 0.01) << engine;
        EXPECT_NEAR(image(45, 40).a, 1, 0.01) << engine;
        EXPECT_NEAR(image(90, 40).g, 0.4, 0.01) << engine;
    }
}

// A card with antialiased sides, out of focus, before a wall with two lamps. The wall's depth is that of the
// lamps' rims too.
struct CardBeforeWall {
    static constexpr Rect kLeft{40, 0, 60, kHeight};  // the card's pixels, without its sides
    Shot shot = flat(kWidth, kHeight, {}, 6), wall = flat(kWidth, kHeight, {}, 6);

    CardBeforeWall() {
        paint_rectangles(wall.colour, 21);
        for (const auto& [x, y] : {std::pair{120, 30}, {100, 80}})
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u) {
                    const bool middle = u == x && v == y;
                    wall.colour(u, v) = (middle ? 300.0f : 60.0f) * Rgba{1, 0.9f, 0.6f, 0} + Rgba{0, 0, 0, 1};
                    if (middle) wall.coc_px(u, v) = 5;
                }
        shot.colour = wall.colour.clone(), shot.coc_px = wall.coc_px.clone();
        for (int y = 0; y < kHeight; ++y) {
            for (int x = kLeft.x0; x < kLeft.x1; ++x) shot.colour(x, y) = card(), shot.coc_px(x, y) = -5;
            for (const int x : {kLeft.x0 - 1, kLeft.x1})
                shot.colour(x, y) = 0.4f * card() + 0.6f * wall.colour(x, y);
        }
    }
    // Patches of the wall, as far behind the card's sides as other frames would show it.
    void know(const Rect& patch) {
        shot.behind =
            DeepPicture::made_of(kWidth, kHeight, [&](int x, int y, std::vector<DeepSample>& samples) {
                const int from_side = std::min(x - kLeft.x0, kLeft.x1 - 1 - x);
                if (patch.contains(x, y) && from_side >= 0 && from_side < 7)
                    samples.push_back({wall.colour(x, y), wall.coc_px(x, y), wall.coc_px(x, y)});
            });
    }
    // With everything known, the sides' pixels as two surfaces.
    Picture truth() const {
        Shot known{shot.colour.clone(), shot.coc_px.clone(), {}};
        known.behind =
            DeepPicture::made_of(kWidth, kHeight, [&](int x, int y, std::vector<DeepSample>& samples) {
                const bool side = x == kLeft.x0 - 1 || x == kLeft.x1;
                if (!side && !kLeft.contains(x, y)) return;
                samples.push_back({(side ? 0.4f : 1.0f) * card(), -5, -5});
                samples.push_back({wall.colour(x, y), wall.coc_px(x, y), wall.coc_px(x, y)});
            });
        DefocusJob job = known.job("reference");
        job.pupil_points = 1024;
        return rendered(job);
    }
    static Rgba card() { return {0.1f, 0.3f, 0.8f, 1}; }
};

TEST(Plate, APatchChangesNothingFarFromIt) {
    // Other frames show patches of hidden surfaces. Silhouettes, lamps and hidden surfaces elsewhere are the
    // same with and without.
    for (const char* engine : {"scatter", "gather"}) {
        CardBeforeWall scene;
        const Picture without = rendered(scene.shot.job(engine));
        scene.know({0, 0, kWidth, 8});
        const Picture with = rendered(scene.shot.job(engine));
        float most = 0;
        for (int y = 40; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                most = std::max(most, std::abs(with(x, y).g - without(x, y).g) / (1 + without(x, y).g));
        EXPECT_LT(most, 1e-3) << engine;
    }
}

TEST(Plate, PatchesBehindTheSidesOfACardAreBetterThanNone) {
    const CardBeforeWall unknown;
    const Picture truth = unknown.truth();
    CardBeforeWall scene;
    scene.know({0, 0, kWidth, kHeight});
    for (const char* engine : {"scatter", "gather"}) {
        const Picture without = rendered(unknown.shot.job(engine)), with = rendered(scene.shot.job(engine));
        const Rect around = CardBeforeWall::kLeft.grown(12).intersected({0, 12, kWidth, kHeight - 12});
        const auto score = [&](const Picture& p) {
            return compare(truth.view().part(around), p.view().part(around))->psnr_lin;
        };
        EXPECT_GT(score(with), score(without) + 1) << engine;
    }
}

// The largest difference in rows and columns of `part`, relative to 1 + light.
float largest_change(const Picture& a, const Picture& b, const Rect& part) {
    float most = 0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            most = std::max(most, std::abs(a(x, y).g - b(x, y).g) / (1 + a(x, y).g));
    return most;
}

TEST(Plate, ThatIsThePictureChangesNothing) {
    CardBeforeWall scene;
    const Picture colour = scene.shot.colour.clone();
    const Plane coc_px = scene.shot.coc_px.clone();
    for (const auto& [engine, most] : {std::pair{"scatter", 0.02f}, {"gather", 0.0f}}) {
        scene.shot.behind = {};
        const Picture without = rendered(scene.shot.job(engine));
        put_behind(
            scene.shot, [&](int x, int y) { return colour(x, y); },
            [&](int x, int y) { return coc_px(x, y); });
        EXPECT_LE(largest_change(rendered(scene.shot.job(engine)), without, colour.rect()), most) << engine;
    }
}

// A plate of a card before a wall, and a post in front of its right end.
TEST(Plate, HidesWhatIsEstimatedLikeAPicture) {
    for (const char* engine : {"scatter", "gather"}) {
        CardBeforeWall scene;
        const Picture alone = rendered(scene.shot.job(engine));
        const Picture colour = scene.shot.colour.clone();
        const Plane coc_px = scene.shot.coc_px.clone();
        put_behind(
            scene.shot, [&](int x, int y) { return colour(x, y); },
            [&](int x, int y) { return coc_px(x, y); });
        for (int y = 0; y < kHeight; ++y)
            for (int x = kWidth - 8; x < kWidth; ++x)
                scene.shot.colour(x, y) = {0, 0, 0, 1}, scene.shot.coc_px(x, y) = -12;
        const Rect left = Rect{0, 0, kWidth / 2, kHeight};
        EXPECT_LT(largest_change(rendered(scene.shot.job(engine)), alone, left), 0.02f) << engine;
    }
}

TEST(Plate, LayersOfOnePixelChangeNothingFarFromIt) {
    for (const auto& [engine, most] : {std::pair{"scatter", 0.02f}, {"gather", 0.01f}}) {
        CardBeforeWall scene;
        const Picture without = rendered(scene.shot.job(engine));
        scene.shot.behind =
            DeepPicture::made_of(kWidth, kHeight, [&](int x, int y, std::vector<DeepSample>& samples) {
                if (x != kWidth - 4 || y != 4) return;
                samples.push_back({{0.2f, 0.2f, 0.2f, 1}, 8, 8});
                samples.push_back({{0.2f, 0.2f, 0.2f, 1}, 9, 9});
            });
        const Rect far{0, 30, kWidth - 30, kHeight};
        EXPECT_LT(largest_change(rendered(scene.shot.job(engine)), without, far), most) << engine;
    }
}

}  // namespace
}  // namespace petzval::conformance
