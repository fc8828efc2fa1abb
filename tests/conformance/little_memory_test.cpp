// A device with little memory: whatever is asked of it, the picture is the one that it draws with enough, and
// the report says in a line how it came about.
#include "gpus.h"
#include "shots.h"

#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

#ifdef PETZVAL_FAULTY_DEVICE

constexpr std::size_t kEnough = std::size_t(1) << 40;

void allow(std::size_t bytes) { setenv("PETZVAL_DEVICE_BYTES", std::to_string(bytes).c_str(), 1); }

// A session on each GPU, under a layer that refuses memory.
class LittleMemory : public testing::Test {
protected:
    // The layer is asked for when drivers are looked for: nobody did yet.
    static void SetUpTestSuite() {
        setenv("VK_ADD_LAYER_PATH", PETZVAL_FAULTY_DEVICE, 1);
        setenv("VK_INSTANCE_LAYERS", "VK_LAYER_PETZVAL_faulty_device", 1);
    }
    static void TearDownTestSuite() {
        for (const char* name : {"VK_ADD_LAYER_PATH", "VK_INSTANCE_LAYERS", "PETZVAL_DEVICE_BYTES"})
            unsetenv(name);
    }
    void SetUp() override {
        if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
        if (drivers_stay()) GTEST_SKIP() << "needs a software driver, which loads again with a layer";
    }

    static std::vector<std::string> said_of_memory(const DefocusReport& report) {
        std::vector<std::string> said = report.warnings;
        std::erase_if(said,
                      [](const std::string& line) { return line.find("memory left") == std::string::npos; });
        return said;
    }

    // With so much memory, and with none: as with enough, to 80 dB. by_pieces: some of these are enough for
    // that.
    static void expect_the_same(const DefocusJob& job, const Look& look, std::vector<std::size_t> most_bytes,
                                bool by_pieces) {
        most_bytes.push_back(0);
        for (const std::string& gpu : gpus()) {
            allow(kEnough);
            const auto whole = session_on(gpu).take(job, look);
            ASSERT_TRUE(whole) << whole.error().message;
            EXPECT_TRUE(said_of_memory(*whole).empty());
            bool was_by_pieces = false, was_by_the_cpu = false;
            for (const std::size_t bytes : most_bytes) {
                allow(bytes);
                const auto made = session_on(gpu).take(job, look);
                ASSERT_TRUE(made) << bytes << ": " << made.error().message;
                EXPECT_GE(psnr(whole->image, made->image), 80) << bytes;
                const std::vector<std::string> said = said_of_memory(*made);
                const bool by_cpu =
                    made->device != whole->device || made->glare_device != whole->glare_device;
                was_by_the_cpu |= by_cpu, was_by_pieces |= !by_cpu && !said.empty();
                EXPECT_LE(said.size(), 2u);
                if (!by_cpu) continue;
                ASSERT_FALSE(said.empty()) << bytes;
                EXPECT_NE(said.back().find("the CPU ma"), std::string::npos) << said.back();
            }
            EXPECT_TRUE(was_by_the_cpu);
            EXPECT_EQ(was_by_pieces, by_pieces) << job.engine;
        }
    }
};

// Lamps, some behind a bar.
Shot lit_shot(int width, int height, int lamps) {
    Shot shot = flat(width, height, {}, 9);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < height; ++y)
        for (int x = width / 2; x < width / 2 + 8; ++x) shot.coc_px(x, y) = -9;
    for (int i = 0; i < lamps; ++i) shot.colour(i * 37 % width, i * 29 % height) = {700, 60, 20, 1};
    return shot;
}

Look look_of(const std::string& engine) {
    Look look;
    look.engine = engine;
    return look;
}

TEST_F(LittleMemory, EveryEngineDrawsTheSamePicture) {
    const Shot shot = lit_shot(160, 100, 3);
    for (const auto& [engine, bytes] :
         {std::pair("scatter", 2'000'000), {"gather", 800'000}, {"gaussian", 1'000'000}}) {
        Look look = look_of(engine);
        look.sprites.find = false;  // lights through masks have a test of their own
        expect_the_same(shot.job(engine), look, {std::size_t(bytes)}, true);
    }
}

TEST_F(LittleMemory, LightsAreAddedByPieces) {
    const Shot shot = lit_shot(120, 60, 150);
    expect_the_same(shot.job("scatter"), look_of("scatter"), {900'000}, true);
}

TEST_F(LittleMemory, LightsThroughMasksAreAddedByPieces) {
    const Shot shot = lit_shot(600, 24, 0);
    std::vector<LightPoint> points;
    for (int i = 0; i < 40; ++i)
        points.push_back({.x = float(i * 37 % 600),
                          .y = float(i * 53 % 24),
                          .r = 50,
                          .g = 30,
                          .b = 20,
                          .coc_px = float(i % 17) - 6});
    DefocusJob job = shot.job("sprites");
    job.points = &points;
    expect_the_same(job, look_of("sprites"), {4'000'000}, true);
}

TEST_F(LittleMemory, GlareIsTheCpusWhereThereIsTooLittle) {
    Look look = look_of("gather");
    look.lens.aperture.blades = 6;
    look.glare.bloom = 0.1, look.glare.star = 0.1, look.glare.ghosts = 0.1, look.glare.veil = 0.05;
    expect_the_same(lit_shot(160, 100, 3).job("gather"), look, {2'000'000}, false);
}

// No CPU draws it: by strips, or one line.
TEST_F(LittleMemory, RealTimeIsDrawnInStripsOrRefused) {
    Shot shot = flat(64, 900, {}, 3);
    paint_rectangles(shot.colour, 3);
    shot.colour(30, 100) = {700, 60, 20, 1}, shot.colour(9, 500) = {700, 60, 20, 1};
    for (const std::string& gpu : gpus()) {
        allow(kEnough);
        const auto whole = session_on(gpu).defocus(shot.job("realtime"));
        ASSERT_TRUE(whole) << whole.error().message;
        bool was_in_strips = false, was_refused = false;
        for (const std::size_t bytes : {20'000'000, 8'000'000, 5'000'000, 1'000'000}) {
            allow(bytes);
            const auto made = session_on(gpu).defocus(shot.job("realtime"));
            was_refused |= !made;
            if (!made) {
                EXPECT_EQ(made.error().code, ErrorCode::OutOfMemory) << made.error().message;
                EXPECT_NE(made.error().message.find("no memory left"), std::string::npos);
                continue;
            }
            EXPECT_FALSE(was_refused) << "and drawn with less: " << bytes;
            EXPECT_GE(psnr(whole->image, made->image), 70) << bytes;
            EXPECT_LE(made->warnings.size(), 1u);
            was_in_strips |= !made->warnings.empty();
        }
        EXPECT_TRUE(was_in_strips && was_refused);
    }
}

#endif

}  // namespace
}  // namespace petzval::conformance
