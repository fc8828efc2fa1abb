// Measures how long a frame continues after a request to stop, for `./dev bench cancel`.
//
// cancel FILE.exr LENS ENGINE TIMES: reads once and makes the frame once (kernels stay in the session). Then
// it makes the frame TIMES more times and cancels it at an even spread of instants. Prints the seconds that
// each took to return.
#include "petzval/files.h"
#include "petzval/session.h"

#include "process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace petzval;
using bench::fail;
using Clock = std::chrono::steady_clock;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

int main(int count, char** words) {
    if (count != 5) fail("FILE.exr LENS ENGINE TIMES");
    const auto frame = read_frame(words[1]);
    if (!frame) fail(frame.error().message);
    const FoundCamera& found = frame->camera;
    if (!found.focal_length_mm || !found.sensor_width_mm || !found.f_number || !found.focus_distance_m)
        fail("the picture has no camera numbers; make it with `petzval scene make`");
    DefocusJob job;
    job.colour = frame->colour, job.depth_m = frame->depth, job.place = frame->place;
    job.camera = {found.focal_length_mm->value, found.sensor_width_mm->value, found.f_number->value,
                  found.focus_distance_m->value};
    job.lens.name = words[2], job.engine = words[3];
    const int times = std::atoi(words[4]);

    // Cold: kernels are made, and that is stopped too.
    const auto begin = Clock::now();
    {
        Session session;
        if (const auto whole = session.defocus(job); !whole) fail(whole.error().message);
    }
    const double whole_s = seconds(Clock::now() - begin);
    std::vector<double> latencies;
    double slowest_at = 0;
    for (int i = 0; i < times; ++i) {
        Session session;
        std::atomic<bool> stop{false};
        Clock::time_point told;
        const double at = whole_s * (i + 0.5) / times;
        std::thread other([&] {
            std::this_thread::sleep_for(std::chrono::duration<double>(at));
            told = Clock::now();
            stop = true;
        });
        const auto made = session.defocus(job, {.cancelled = [&] { return stop.load(); }});
        const auto ended = Clock::now();
        other.join();
        if (made) continue;  // done before it was told
        const double latency = seconds(ended - told);
        if (latencies.empty() || latency > *std::max_element(latencies.begin(), latencies.end()))
            slowest_at = at / whole_s;
        latencies.push_back(latency);
    }
    std::sort(latencies.begin(), latencies.end());
    if (latencies.empty()) fail("the frame ended before it could be stopped");
    std::printf(
        "{\"frame_s\": %.3f, \"stopped\": %zu, \"median_ms\": %.1f, \"p95_ms\": %.1f, \"worst_ms\": "
        "%.1f, \"worst_at\": %.2f}\n",
        whole_s, latencies.size(), 1e3 * latencies[latencies.size() / 2],
        1e3 * latencies[latencies.size() * 95 / 100], 1e3 * latencies.back(), slowest_at);
}
