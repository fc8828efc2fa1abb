// Random valid frames through one session for some time, from two threads at once. A fresh process
// that makes the same frame must give the same bits, and memory must stay flat.
//
// soak SECONDS [SEED]: prints a Markdown row after each tenth of the time. Exit code 1 on other bits; 2 on a
// frame that failed, or if the heap after Session::trim(0) grew by more than 1 MiB after the third tenth.
// soak --frame NUMBER: makes that frame alone and prints its hash.
#include "petzval/session.h"

#include "process.h"

#include <atomic>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstring>
#include <fstream>
#include <malloc.h>
#include <mutex>
#include <random>
#include <thread>
#include <unistd.h>
#include <vector>

namespace {

using namespace petzval;
using bench::fail;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kSessionMiB = 512;
constexpr double kGrowthMiB = 1;
constexpr int kCompareEach = 4;  // one frame in so many is made again in a fresh process

class Dice {
public:
    explicit Dice(std::uint64_t seed) : bits_(seed) {}
    int below(int end) { return int(bits_() % std::uint64_t(end)); }
    double between(double from, double to) { return from + (to - from) * double(bits_() >> 11) * 0x1p-53; }
    bool one_in(int n) { return below(n) == 0; }
    template <typename T, std::size_t N>
    const T& of(const T (&values)[N]) {
        return values[below(int(N))];
    }

private:
    std::mt19937_64 bits_;
};

struct Shot {
    Picture colour;
    Plane depth_m, mask;
    DeepPicture behind;
    std::vector<LightPoint> lights;
    Rendered rendered;
};

// A slope with lamps and a disc in front. Some shots have hidden layers, a mask, lights or odd pixels.
void make_shot(Dice& dice, double brightest, Shot& shot) {
    const int width = 1 + dice.below(160), height = 1 + dice.below(90);
    shot.colour = Picture(width, height);
    shot.depth_m = Plane(width, height);
    const double far = dice.one_in(6) ? INFINITY : dice.between(4, 60), slope = dice.between(0, 0.02);
    const double x0 = dice.between(0, width), y0 = dice.between(0, height), size = dice.between(1, 40);
    const double near = dice.between(0.4, 3);
    std::vector<DeepSample> hidden;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_near = std::hypot(x - x0, y - y0) < size;
            const float light = float(dice.between(0, dice.one_in(300) ? brightest : 0.6));
            shot.colour(x, y) = {light, is_near ? 0.2f : light, 0.5f * light, dice.one_in(400) ? 0.5f : 1};
            shot.depth_m(x, y) = float(is_near ? near : far / (1 + slope * y));
        }
    shot.rendered.colour = shot.colour;
    shot.rendered.depth = PlanarDepth{shot.depth_m};
    shot.rendered.place = Place::whole(shot.colour.rect(), dice.one_in(8) ? 2 : 1);
    shot.rendered.camera = {dice.between(18, 135), 36, dice.between(1.2, 11), dice.between(0.6, 20)};
    if (dice.one_in(4)) {
        shot.behind =
            DeepPicture::made_of(width, height, [&](int x, int y, std::vector<DeepSample>& samples) {
                if (shot.depth_m(x, y) < 3.5f) samples.push_back({{0.3f, 0.2f, 0.1f, 1}, 30, 30});
            });
        shot.rendered.behind = &shot.behind;
    }
    if (dice.one_in(4)) {
        shot.mask = Plane(width, height);
        for (int i = 0; i < width * height; ++i) shot.mask.pixels()[i] = float(i % 7) / 6;
        shot.rendered.mask = shot.mask;
    }
    for (int i = dice.below(6); i > 0; --i)
        shot.lights.push_back({float(dice.between(0, width)), float(dice.between(0, height)), 90, 80, 60,
                               float(dice.between(0.5, 30))});
}

Look random_look(Dice& dice) {
    static constexpr const char* kLenses[] = {
        "ideal",   "ideal",      "ideal",  "doublet",          "triplet",
        "singlet", "apochromat", "tessar", "petzval-portrait", "biotar"};
    Look look;
    look.engine = dice.of({"scatter", "scatter", "gather", "gaussian", "sprites", "reference"});
    look.quality = dice.of({Quality::Draft, Quality::Standard, Quality::Final});
    look.seed = std::uint64_t(dice.below(3));
    look.pupil_points = 16;
    look.fill = dice.of({Fill::Full, Fill::Dim, Fill::Off});
    look.lens.name = dice.of(kLenses);
    look.coc.max_radius_px = dice.between(2, 40);
    look.lens.aperture.blades = dice.one_in(2) ? 5 + dice.below(5) : 0;
    look.lens.aperture.curvature = dice.between(0, 1);
    look.lens.aperture.rotation_deg = dice.between(0, 90);
    if (dice.one_in(4)) look.lens.aperture.squeeze = dice.between(0.6, 2);
    if (dice.one_in(3)) look.lens.cats_eye = dice.between(0, 1);
    if (dice.one_in(6)) look.lens.texture.onion_rings = dice.between(0, 1);
    if (look.lens.name == "ideal" && dice.one_in(3)) look.lens.coma = dice.between(-2, 2);
    if (look.lens.name == "ideal" && dice.one_in(4)) look.lens.distortion = dice.between(-0.1, 0.1);
    look.vignetting = dice.one_in(4);
    if (dice.one_in(4)) look.glare.bloom = dice.between(0, 0.3);
    if (dice.one_in(6) && look.lens.aperture.blades) look.glare.star = dice.between(0, 0.3);
    if (dice.one_in(6)) look.glare.ghosts = dice.between(0, 0.1);
    if (dice.one_in(6)) look.glare.star_quality = StarQuality::Draft;
    if (dice.one_in(4)) look.gaussian.style = dice.of({GaussianStyle::Plain, GaussianStyle::Wgld});
    if (dice.one_in(4)) look.sprites.background = SpriteBackground::Gaussian;
    look.expand_highlights = dice.one_in(8);
    return look;
}

std::uint64_t hash_of(const Picture& picture) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        std::uint32_t words[4];
        std::memcpy(words, picture.pixels() + i, sizeof words);
        for (const std::uint32_t word : words) hash = (hash ^ word) * 0x100000001b3u;
    }
    return hash;
}

// The hash of frame `number`. A message that it is refused is a failure: every frame here is valid.
std::uint64_t frame_hash(Session& session, std::uint64_t number) {
    Dice dice(number);
    const Look look = random_look(dice);
    Shot shot;
    make_shot(dice, look.expand_highlights ? 1 : 400, shot);              // a plate ends at 1
    if (look.lens.name != "ideal") shot.rendered.camera.f_number += 4.5;  // wider than some lenses open
    if (look.engine == "sprites") shot.rendered.lights = &shot.lights;
    const auto report = session.take(shot.rendered, look);
    if (!report) fail("frame " + std::to_string(number) + ": " + report.error().message);
    return hash_of(report->image);
}

std::uint64_t hash_in_fresh_process(std::uint64_t number) {
    const std::string command =
        "/proc/" + std::to_string(::getpid()) + "/exe --frame " + std::to_string(number);
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::uint64_t hash = 0;
    if (!pipe || std::fscanf(pipe, "%" SCNx64, &hash) != 1 || ::pclose(pipe) != 0) fail(command + " failed");
    return hash;
}

double resident_mib() {
    std::ifstream statm("/proc/self/statm");
    double all = 0, resident = 0;
    statm >> all >> resident;
    return resident * double(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

double heap_mib() {
    const struct mallinfo2 heap = ::mallinfo2();
    return double(heap.uordblks + heap.hblkhd) / (1 << 20);
}

struct Counts {
    std::atomic<std::uint64_t> next{0}, compared{0}, different{0};
};

void make_frames(Session& session, std::uint64_t seed, Clock::time_point end, Counts& counts) {
    while (Clock::now() < end) {
        const std::uint64_t n = counts.next++, number = seed * 1'000'000 + n;
        const std::uint64_t hash = frame_hash(session, number);
        if (n % kCompareEach) continue;
        ++counts.compared;
        if (hash == hash_in_fresh_process(number)) continue;
        ++counts.different;
        std::fprintf(stderr, "frame %" PRIu64 " has other bits in a fresh process\n", number);
    }
}

// Makes frames for ten tenths of the time and prints a row after each, when no frame is in progress. True if
// the heap without what the session keeps stayed flat.
bool is_flat(Session& session, double seconds, std::uint64_t seed, Counts& counts) {
    std::puts("| seconds | frames | compared | with other bits | resident MiB | heap MiB | trimmed MiB |");
    std::puts("|---|---|---|---|---|---|---|");
    const auto start = Clock::now();
    double early = 0, trimmed = 0;
    for (int tenth = 1; tenth <= 10; ++tenth) {
        const std::chrono::duration<double> passed(seconds * tenth / 10);
        const auto end = start + std::chrono::duration_cast<Clock::duration>(passed);
        std::thread beside(make_frames, std::ref(session), seed, end, std::ref(counts));
        make_frames(session, seed, end, counts);
        beside.join();
        const double resident = resident_mib(), heap = heap_mib();
        session.trim(0);
        trimmed = heap_mib();
        if (tenth <= 3) early = std::max(early, trimmed);
        std::printf("| %.0f | %" PRIu64 " | %" PRIu64 " | %" PRIu64 " | %.0f | %.1f | %.1f |\n",
                    passed.count(), counts.next.load(), counts.compared.load(), counts.different.load(),
                    resident, heap, trimmed);
        std::fflush(stdout);
    }
    return trimmed <= early + kGrowthMiB;
}

}  // namespace

int main(int count, char** words) {
    if (count == 3 && std::string(words[1]) == "--frame") {
        Session alone;
        std::printf("%" PRIx64 "\n", frame_hash(alone, std::strtoull(words[2], nullptr, 10)));
        return 0;
    }
    if (count < 2) fail("SECONDS [SEED]");
    const std::uint64_t seed = count > 2 ? std::strtoull(words[2], nullptr, 10) : 1;
    Session session({.max_memory_bytes = kSessionMiB << 20});
    Counts counts;
    if (!is_flat(session, std::atof(words[1]), seed, counts)) fail("memory grew");
    return counts.different > 0;
}
