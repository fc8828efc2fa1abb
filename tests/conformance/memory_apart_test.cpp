// A device whose own memory the host does not see, as cards have it: all that goes there and comes back is
// copied, under the validation layer where that is installed, and the pictures are the same bits.
#include "gpus.h"
#include "shots.h"

#include <cstdlib>
#include <dlfcn.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

#ifdef PETZVAL_FAULTY_DEVICE

class MemoryApart : public testing::Test {
protected:
    // The layers are asked for when drivers are looked for: nobody did yet.
    static void SetUpTestSuite() {
        setenv("VK_ADD_LAYER_PATH", PETZVAL_FAULTY_DEVICE, 1);
        setenv("VK_INSTANCE_LAYERS", "VK_LAYER_PETZVAL_faulty_device", 1);
        setenv("PETZVAL_VULKAN_VALIDATION", "1", 1);
        if (gpus().empty()) unsetenv("PETZVAL_VULKAN_VALIDATION");
    }
    static void TearDownTestSuite() {
        for (const char* name : {"VK_ADD_LAYER_PATH", "VK_INSTANCE_LAYERS", "PETZVAL_VULKAN_VALIDATION"})
            unsetenv(name);
    }
    void SetUp() override {
        if (gpus().empty()) GTEST_SKIP() << why_no_gpu();
        if (drivers_stay()) GTEST_SKIP() << "needs a software driver, which loads again with a layer";
    }
    void TearDown() override { unsetenv("PETZVAL_MEMORY_APART"); }

    // Number of allocations of host memory outside the device's, while drivers are open.
    static unsigned allocations_apart() {
        void* const layer = dlopen(PETZVAL_FAULTY_DEVICE "/libpetzval_faulty_device.so", RTLD_NOW);
        if (!layer) return 0;
        const auto count = reinterpret_cast<unsigned (*)()>(dlsym(layer, "petzval_allocations_apart"));
        const unsigned counted = count ? count() : 0;
        dlclose(layer);
        return counted;
    }

    static DefocusReport made(const std::string& gpu, const DefocusJob& job, const Look& look, bool is_apart,
                              const Control& control) {
        if (is_apart)
            setenv("PETZVAL_MEMORY_APART", "1", 1);
        else
            unsetenv("PETZVAL_MEMORY_APART");
        Session session = session_on(gpu);
        auto report = session.take(job, look, control);
        EXPECT_TRUE(report) << report.error().message;
        if (!report) return {};
        EXPECT_TRUE(report->device.starts_with(gpu)) << report->device;
        EXPECT_EQ(allocations_apart() > 0, is_apart);
        return std::move(*report);
    }

    static void expect_the_same_bits(const std::string& engine, Look look, const Control& control = {}) {
        look.engine = engine;
        Shot shot = flat(40, 30, {}, 4);
        paint_rectangles(shot.colour, 3);
        for (int y = 0; y < 30; ++y) shot.coc_px(20, y) = shot.coc_px(21, y) = -5;
        for (const int x : {8, 33}) shot.colour(x, 20) = {700, 60, 20, 1};
        const DefocusJob job = shot.job(engine);
        for (const std::string& gpu : gpus()) {
            const DefocusReport one = made(gpu, job, look, false, control),
                                apart = made(gpu, job, look, true, control);
            EXPECT_EQ(largest_difference(one.image, apart.image), 0) << engine << " on " << gpu;
            EXPECT_EQ(one.codes, apart.codes) << engine << " on " << gpu;
            EXPECT_EQ(one.codes.empty(), !control.codes) << engine << " on " << gpu;
        }
    }
};

TEST_F(MemoryApart, EveryEngineDrawsTheSameBits) {
    for (const char* engine : {"scatter", "gather", "gaussian", "sprites", "realtime"})
        expect_the_same_bits(engine, {});
}

TEST_F(MemoryApart, GlareAndCodesAreTheSameBits) {
    Look look;
    look.lens.aperture.blades = 6;
    look.glare.bloom = look.glare.star = look.glare.ghosts = look.glare.veil = 0.1;
    look.glare.star_radius = 0.3;
    expect_the_same_bits("gaussian", look);
    expect_the_same_bits("gaussian", look, {.codes = CodesWanted{}});
}

#endif

}  // namespace
}  // namespace petzval::conformance
