#include "kernel/keep/kernel_store.h"

#include "base/build_id.h"
#include "base/parallel.h"
#include "kernel/lenses/kernel_testing.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRoomy = std::size_t(64) << 20;

class KernelStoreTest : public testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    std::vector<fs::path> segments() const {
        std::vector<fs::path> found;
        std::error_code none;
        for (const auto& entry : fs::recursive_directory_iterator(folder_, none))
            if (entry.is_regular_file()) found.push_back(entry.path());
        return found;
    }
    std::unique_ptr<const LensModel> kept_lens(const std::string& key = "lens", std::size_t bytes = kRoomy) {
        store_ = std::make_shared<KernelStore>(folder_, key, bytes);
        return kept(lens_of(choice()), store_, 0);
    }
    static LensChoice choice() {
        LensChoice c;
        c.name = "doublet", c.cats_eye = 0.5, c.aperture.blades = 6;
        return c;
    }
    std::size_t found() const { return store_->kernels_found(); }
    void forget() { store_.reset(); }

    const std::string folder_ =
        testing::TempDir() + "kernel_store_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    std::shared_ptr<KernelStore> store_;
};

const FieldPosition kPlaces[] = {{0, 0}, {0.6, 0.2}, {-0.3, 0.5}};

bool same_bits(const PointSpread& a, const PointSpread& b) {
    return a.extent == b.extent && a.neutral == b.neutral &&
           std::memcmp(a.weights.pixels(), b.weights.pixels(), a.weights.bytes()) == 0;
}

void expect_the_kernels_of_the_lens(const LensModel& kept_lens, const LensChoice& choice) {
    const auto lens = lens_of(choice);
    for (const double coc : {-14.0, -2.5, 0.0, 7.0})
        for (const FieldPosition place : kPlaces)
            EXPECT_TRUE(same_bits(kept_lens.point_spread(coc, place), lens->point_spread(coc, place)));
}

TEST_F(KernelStoreTest, GivesBackTheSameBitsAndMakesNothingAgain) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 0u);
    forget();
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 12u);
    forget();
    EXPECT_EQ(segments().size(), 1u) << "nothing new, nothing written";
}

TEST_F(KernelStoreTest, KeepsLensesAndLevelsApart) {
    expect_the_kernels_of_the_lens(*kept_lens("one"), choice());
    forget();
    expect_the_kernels_of_the_lens(*kept_lens("another"), choice());
    EXPECT_EQ(found(), 0u);
    forget();
    const auto coarser = kept(lens_of(choice()), std::make_shared<KernelStore>(folder_, "one", kRoomy), 1);
    expect_the_kernels_of_the_lens(*coarser, choice());
}

TEST_F(KernelStoreTest, DamageAnywhereIsAsIfNothingWereThere) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    const fs::path segment = segments().at(0);
    std::ifstream in(segment, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    std::mt19937 random(5);
    for (int round = 0; round < 60; ++round) {
        std::string bytes = whole;
        if (round % 3 == 0)
            bytes.resize(random() % bytes.size());
        else
            for (int i = 0; i < 4; ++i)
                bytes[round % 3 == 1 ? random() % bytes.size() : random() % 900] ^= char(1 + random() % 255);
        std::ofstream(segment, std::ios::binary) << bytes;
        const KernelStore store(folder_, "lens", kRoomy);
        const auto lens = lens_of(choice());
        for (const double coc : {-14.0, 7.0})
            if (const auto kernel = store.find({0, coc, 0.6, 0.2})) {
                EXPECT_TRUE(same_bits(*kernel, lens->point_spread(coc, kPlaces[1])));
            }
    }
}

TEST_F(KernelStoreTest, StaysWithinItsRoom) {
    for (int run = 0; run < 12; ++run) {
        KernelStore store(folder_, "lens " + std::to_string(run % 5), 400000);
        const auto lens = lens_of(choice());
        for (int i = 0; i < 30; ++i) store.add({0, double(i), 0, double(run)}, lens->point_spread(12, {}));
    }
    std::uintmax_t bytes = 0;
    for (const fs::path& file : segments()) bytes += fs::file_size(file);
    EXPECT_LE(bytes, 400000u);
    EXPECT_GT(bytes, 100000u);
}

TEST_F(KernelStoreTest, ManyStoresAtOnceLeaveWholeSegments) {
    const auto lens = lens_of(choice());
    const PointSpread kernel = lens->point_spread(5, {});
    parallel_for(24, *own_workers(2), [&](int i) {
        KernelStore store(folder_, "lens", kRoomy);
        store.add({i, 5, 0, 0}, kernel);
        for (int k = 0; k < 24; ++k)
            if (const auto found = store.find({k, 5, 0, 0})) {
                EXPECT_TRUE(same_bits(*found, kernel));
            }
    });
    const KernelStore store(folder_, "lens", kRoomy);
    for (int k = 0; k < 24; ++k) EXPECT_TRUE(store.find({k, 5, 0, 0})) << k;
}

TEST_F(KernelStoreTest, AFolderThatCannotBeUsedIsNoError) {
    std::ofstream(folder_) << "a file";
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 0u);
}

TEST_F(KernelStoreTest, QuickLensesAreLeftAlone) {
    store_ = std::make_shared<KernelStore>(folder_, "ideal", kRoomy);
    LensChoice ideal;
    ideal.cats_eye = 0.4;
    static_cast<void>(kept(lens_of(ideal), store_, 0)->point_spread(9, kPlaces[1]));
    forget();
    EXPECT_TRUE(segments().empty());
}

}  // namespace
}  // namespace petzval::kernel
