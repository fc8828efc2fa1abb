#include "kernel/keep/kernel_store.h"

#include "base/content_hash.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "kernel/lenses/kernel_testing.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sys/stat.h>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRoomy = std::size_t(64) << 20;

class KernelStoreTest : public testing::Test {
protected:
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

    const test::TemporaryFolder own_;
    const std::string folder_ = own_ / "kernels";
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

// A file of the store, laid out as kernel_store.cpp says: header, records, weights.
struct Forged {
    fs::path path;
    std::string bytes;

    explicit Forged(fs::path segment) : path(std::move(segment)) {
        std::ifstream in(path, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    static constexpr std::size_t kHeader = 88, kRecord = 64;  // bytes
    static constexpr std::size_t kMagicAt = 0, kRecordsAt = 8, kIndexHashAt = 16;
    static constexpr std::size_t kX0At = 28, kX1At = 36, kOffsetAt = 48, kHashAt = 56;  // in a record
    template <typename T>
    T at(std::size_t place) const {
        T value;
        std::memcpy(&value, bytes.data() + place, sizeof value);
        return value;
    }
    template <typename T>
    void set(std::size_t place, T value) {
        std::memcpy(bytes.data() + place, &value, sizeof value);
    }
    // With hashes that fit, as anybody can make them, in a folder that is ours.
    void write() {
        const auto magic = at<std::uint64_t>(kMagicAt), records = at<std::uint64_t>(kRecordsAt);
        for (std::size_t i = 0; i < records; ++i) {
            const std::size_t record = kHeader + i * kRecord, next = record + kRecord + kOffsetAt;
            const auto from = at<std::uint64_t>(record + kOffsetAt);
            const std::size_t to = i + 1 < records ? at<std::uint64_t>(next) : bytes.size();
            set(record + kHashAt, hash_of(bytes.data() + from, to - from, magic));
        }
        set(kIndexHashAt, hash_of(bytes.data() + kHeader, records * kRecord, magic));
        const fs::path folder = path.parent_path();
        fs::remove_all(folder);
        fs::create_directories(folder);
        fs::permissions(folder, fs::perms::owner_all);
        fs::permissions(folder.parent_path(), fs::perms::owner_all);
        std::ofstream(path, std::ios::binary) << bytes;
        fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    }
};

TEST_F(KernelStoreTest, ForgedWeightsAreNotUsed) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    const Forged whole(segments().at(0));
    Forged(whole).write();
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 12u) << "the layout above is that of the store";
    forget();
    for (const float weight : {std::nanf(""), -0.5f, 9.0f, std::numeric_limits<float>::infinity()}) {
        Forged forged = whole;
        forged.set(whole.at<std::uint64_t>(Forged::kHeader + Forged::kOffsetAt), weight);
        forged.write();
        expect_the_kernels_of_the_lens(*kept_lens(), choice());
        EXPECT_EQ(found(), 11u) << weight;
        forget();
    }
    Forged huge = whole;
    huge.set(Forged::kHeader + Forged::kX0At, std::numeric_limits<std::int32_t>::min());
    huge.set(Forged::kHeader + Forged::kX1At, std::numeric_limits<std::int32_t>::max());
    huge.write();
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 0u);
}

TEST_F(KernelStoreTest, ASegmentOfAnotherLensIsNotUsed) {
    LensChoice other = choice();
    other.name = "triplet";
    {
        const auto lens = kept(lens_of(other), std::make_shared<KernelStore>(folder_, "other", kRoomy), 0);
        expect_the_kernels_of_the_lens(*lens, other);
    }
    const fs::path of_other = segments().at(0);
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    for (const auto& mine : fs::directory_iterator(folder_ + "/lens"))
        fs::copy_file(of_other, mine.path(), fs::copy_options::overwrite_existing);
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 0u);
}

TEST_F(KernelStoreTest, AFolderThatOthersCanWriteToIsNotUsedAndThatIsSaid) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(store_->warning(), "");
    forget();
    EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all) << "new ones are the user's alone";
    for (const std::string& folder : {folder_, folder_ + "/lens"}) {
        fs::permissions(folder, fs::perms::owner_all | fs::perms::others_write);
        expect_the_kernels_of_the_lens(*kept_lens(), choice());
        EXPECT_EQ(found(), 0u) << folder;
        EXPECT_NE(store_->warning().find(folder_), std::string::npos);
        forget();
        fs::permissions(folder, fs::perms::owner_all);
    }
    EXPECT_EQ(segments().size(), 1u) << "nothing was written either";
}

TEST_F(KernelStoreTest, AFileInPlaceOfTheFolderIsSpokenOf) {
    std::ofstream(folder_) << "no folder";
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_NE(store_->warning().find("is not a folder"), std::string::npos) << store_->warning();
    forget();
    EXPECT_EQ(fs::file_size(folder_), 9u);
}

TEST_F(KernelStoreTest, APipeAmongTheSegmentsIsNotWaitedFor) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    ASSERT_EQ(mkfifo((folder_ + "/lens/0.kernels").c_str(), 0600), 0);
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    EXPECT_EQ(found(), 12u);
}

TEST_F(KernelStoreTest, OfManySegmentsTheNewestAreOpen) {
    expect_the_kernels_of_the_lens(*kept_lens(), choice());
    forget();
    const fs::path newest = segments().at(0);
    const auto open_files = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    const auto before = open_files();
    for (int i = 0; i < 200; ++i)
        fs::copy_file(newest, newest.parent_path() / ("0-" + std::to_string(i) + ".kernels"));
    const auto lens = kept_lens();
    EXPECT_LT(open_files(), before + 100);
    expect_the_kernels_of_the_lens(*lens, choice());
    EXPECT_GT(found(), 0u);
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
