// Every engine on every device, with its tolerance for each law. A new engine has the tightest tolerances
// until it has its own row.
#pragma once

#include "petzval/devices.h"
#include "petzval/session.h"

#include "shots.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace petzval::conformance {

// Largest differences of a channel, unless said otherwise.
struct Tolerances {
    std::string engine;
    bool traces = false;  // ray by ray what it is given: smaller pictures, and no guess at what is hidden
    double in_focus = 0;
    double constant = 2e-5;   // a picture of one colour, at any radius
    double light = 1e-3;      // of an isolated pixel: share of its light
    double radius = 0.01;     // of its disc: share of the radius, beside 0.05 px
    double place = 0.02;      // of the disc's middle, px
    double tails = 1e-6;      // farther away than its radius
    double bled = 1e-5;       // over an edge in focus, from what is behind it
    double mirrored = 2e-6;   // between a picture and its mirror image: sums in another order
    double emptiness = 2e-3;  // of colour against coverage, in an element on nothing
    double steps = 5e-3;      // of constant coverage, across steps of depth
    double near_edge = 6e-3;  // a plane in front of focus, as much of it as the lens sees
    // Least PSNR against the reference, in dB.
    double points_db = 60, slant_db = 60, radii_db = 60, corner_db = 60;
};

// A number that is not the tightest stands beside its reason. Decibels are what was measured, rounded down.
inline const std::vector<Tolerances>& tolerances() {
    static const std::vector<Tolerances> rows{
        {.engine = "scatter",
         .bled = 2e-5,        // the sums of kernels of several levels
         .radii_db = 54.5,    // cells of the next level, at its smallest radii
         .corner_db = 50},    // one budget for the lens: which part a surface takes is not known
        {.engine = "gather",  // half resolution, rings of taps, and no lights apart from surfaces
         .points_db = 21,
         .slant_db = 45,
         .radii_db = 49,
         .corner_db = 42.5},
        {.engine = "gaussian",
         .light = 2e-3,       // its tails are cut at the picture
         .tails = 5e-3,       // a Gaussian ends nowhere
         .near_edge = 0.045,  // and falls off otherwise than a disc: all below follows from that
         .points_db = 16,
         .slant_db = 27,
         .radii_db = 30.5,
         .corner_db = 35.5},
        {.engine = "sprites",  // gather, but for the lights
         .points_db = 40.5,
         .slant_db = 45,
         .radii_db = 49,
         .corner_db = 42.5},
        {.engine = "reference",
         .traces = true,
         .in_focus = 2e-6,  // each pixel is a mean of rays
         .place = 0.1,      // drawn by chance
         .mirrored = 5e-3,  // rays are drawn by chance, pixel by pixel
         .emptiness = 0.01},
    };
    return rows;
}

// The CPU, and where $PETZVAL_TEST_DEVICES is set ("gpu") every other device that can be used: a software
// driver takes minutes for all laws, device_test.cpp seconds for those of devices.
inline std::vector<std::string> device_names() {
    std::vector<std::string> names{"cpu"};
    if (!std::getenv("PETZVAL_TEST_DEVICES")) return names;
    for (const DeviceFacts& device : devices())
        if (device.name != "cpu" && device.lacks.empty()) names.push_back(device.name);
    return names;
}

// True if GPUs draw the plans of an engine. (realtime_test.cpp and realtime_lamps_test.cpp hold the laws of
// the real-time pass.)
inline bool is_drawn_by_gpus(const std::string& engine) { return engine != "reference"; }

// Keeps devices open from law to law, as drivers take long to start, and lets go of them before the process
// ends: by then a Vulkan layer may have taken itself down.
class KeptOpen : public testing::Environment {
public:
    void keep(const std::string& device) {
        if (device == "cpu" || sessions_.contains(device)) return;
        SessionSettings settings;
        settings.device = device;
        const auto opened = sessions_.emplace(device, Session(settings))
                                .first->second.defocus(flat(1, 1, {1, 1, 1, 1}, 1).job("scatter"));
        EXPECT_TRUE(opened) << opened.error().message;
    }
    void TearDown() override { sessions_.clear(); }

private:
    std::map<std::string, Session> sessions_;
};
inline auto& kept_open = dynamic_cast<KeptOpen&>(*testing::AddGlobalTestEnvironment(new KeptOpen));

// An engine on a device.
struct Drawer {
    std::string engine, device;

    Tolerances allows() const {
        for (const Tolerances& row : tolerances())
            if (row.engine == engine) return row;
        return {.engine = engine};
    }
    DefocusJob job(const Shot& shot) const { return shot.job(engine); }
    // Settings of a session on this device, for jobs like this one.
    SessionSettings session(const DefocusJob& like = {}) const {
        SessionSettings settings;
        settings.device = device;
        settings.threads = like.threads, settings.max_memory_bytes = like.max_memory_bytes;
        if (like.workers) settings.workers = {std::shared_ptr<Workers>(), like.workers};
        return settings;
    }
    Result<DefocusReport> made(const DefocusJob& job) const {
        kept_open.keep(device);
        return Session(session(job)).defocus(job);
    }
    // True if nothing in the frame is blurred: a draft then returns the input, and the report says so.
    static bool had_nothing_to_draw(const DefocusReport& report) {
        return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& line) {
            return line.find("drew this frame on the CPU") != std::string::npos;
        });
    }
    // The picture of a job; fails where it was not this engine and this device that drew it.
    Picture drawn(const DefocusJob& job) const {
        auto report = made(job);
        EXPECT_TRUE(report.has_value()) << (report ? "" : report.error().message);
        if (!report) return {};
        EXPECT_EQ(report->engine, engine);
        EXPECT_TRUE(report->device.starts_with(device) || had_nothing_to_draw(*report))
            << "drawn by " << report->device;
        return std::move(report->image);
    }
    friend void PrintTo(const Drawer& drawer, std::ostream* out) {
        *out << drawer.engine << " on " << drawer.device;
    }
};

inline std::vector<Drawer> drawers() {
    std::vector<Drawer> all;
    for (const std::string& device : device_names())
        for (const std::string& engine : engine_names())
            if (engine != "realtime" && (device == "cpu" || is_drawn_by_gpus(engine)))
                all.push_back({engine, device});
    return all;
}

// Drawers that estimate hidden background.
inline std::vector<Drawer> guessing_drawers() {
    std::vector<Drawer> some = drawers();
    std::erase_if(some, [](const Drawer& drawer) { return drawer.allows().traces; });
    return some;
}

// A law: a test for each of them.
class EveryDrawer : public testing::TestWithParam<Drawer> {
protected:
    static const Drawer& drawer() { return GetParam(); }
    static Tolerances allows() { return GetParam().allows(); }
    static bool traces() { return allows().traces; }
    static DefocusJob job(const Shot& shot) { return GetParam().job(shot); }
    static Picture picture(const Shot& shot) { return drawn(job(shot)); }
    static Picture drawn(const DefocusJob& job) { return drawer().drawn(job); }
};

inline std::string name_of_drawer(const testing::TestParamInfo<Drawer>& test) {
    std::string name = test.param.engine + "_" + test.param.device;
    std::replace(name.begin(), name.end(), ':', '_');  // of "gpu:0"
    return name;
}

}  // namespace petzval::conformance

#define PETZVAL_EVERY_DRAWER(Law) \
    INSTANTIATE_TEST_SUITE_P(Every, Law, testing::ValuesIn(drawers()), name_of_drawer)
