// One picture drawn by a Vulkan device, each of its passes timed by the device's own clock: what `./dev
// bench gpu` runs. The first frame is not counted. Beside bench/job.h's flags: --device; --engine glare is
// all glare but ghosts, of both qualities of stars, over the picture as it is; --engine develop the codes of
// a frame that engine gaussian draws, 8 bits each.
#include "petzval/devices.h"
#include "petzval/session.h"

#include "device/vulkan/vulkan_device.h"
#include "job.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace petzval;
using bench::fail;

// only: the pass that is printed; empty: all.
void print(const DefocusReport& report, const device::Device& device, int frames, double wall_s,
           const std::string& only) {
    std::printf(
        "{\"device\": \"%s\", \"width\": %d, \"height\": %d, \"wall_s\": %.4f, \"copied_bytes_per_s\": "
        "%.4g, ",
        report.device.c_str(), report.image.width(), report.image.height(), wall_s,
        device::copied_bytes_per_s(device));
    std::printf("\"longest_submission_ms\": %.2f, \"passes\": {", 1e3 * device::longest_submission_s(device));
    const char* separator = "";
    for (const device::PassTime& pass : device::pass_times(device)) {
        if (!only.empty() && pass.pass != only) continue;
        std::printf("%s\"%s\": {\"runs\": %.1f, \"ms\": %.4f, \"bytes\": %.0f, \"multiply_adds\": %.0f}",
                    separator, pass.pass.c_str(), double(pass.runs) / frames, 1e3 * pass.seconds / frames,
                    double(pass.work.bytes) / frames, double(pass.work.multiply_adds) / frames);
        separator = ", ";
    }
    std::printf("}, ");
    bench::print_stages(report.stages);
    std::printf("}\n");
}

// Bloom and veil, and either star.
Result<DefocusReport> with_glare(Session& session, DefocusJob job, const Picture& colour) {
    job.lens.name = "ideal", job.lens.aperture.blades = 6;
    Look look;
    look.lens = job.lens;
    look.glare.bloom = look.glare.veil = look.glare.star = 0.1;
    DefocusReport report;
    for (const StarQuality quality : {StarQuality::Draft, StarQuality::Final}) {
        look.glare.star_quality = quality;
        auto lit = session.add_light(colour.clone(), job, look);
        if (!lit) return lit.error();
        report.image = std::move(*lit);
    }
    return report;
}

// Codes, and an image of the size alone.
Result<DefocusReport> with_codes(Session& session, const DefocusJob& job) {
    Look look;
    look.engine = "gaussian", look.quality = Quality::Draft, look.lens = job.lens;
    auto report = session.take(job, look, {.codes = CodesWanted{}});
    if (report && report->codes_device == "cpu") fail("the device made no codes");
    if (report) report->image = Picture::uninitialised(job.colour.width(), job.colour.height());
    return report;
}

}  // namespace

int main(int count, char** words) {
    bench::Asked asked;
    asked.repeat = 3;
    SessionSettings settings;
    settings.device = "gpu:0";
    bench::read_words(count, words, asked, [&](const std::string& flag, const std::string& value) {
        if (flag == "--device") settings.device = value;
        return flag == "--device";
    });
    const Result<Frame> frame = read_frame(asked.file);
    if (!frame) fail(frame.error().message);
    const bool is_glare = asked.engine == "glare";
    const std::string only = asked.engine == "develop" ? asked.engine : "";
    if (is_glare || !only.empty()) asked.engine = "scatter";
    const DefocusJob job = bench::job_of(frame->colour, frame->depth, frame->camera, asked);

    if (!settings.device.starts_with("gpu:")) fail("--device is gpu:0, gpu:1, …");
    const auto device = device::open_vulkan(std::strtoul(settings.device.c_str() + 4, nullptr, 10));
    if (!device) fail(device.error().message);
    Session session(settings);
    const auto drawn = [&] {
        if (!only.empty()) return with_codes(session, job);
        return is_glare ? with_glare(session, job, frame->colour) : session.defocus(job);
    };
    Result<DefocusReport> report = drawn();
    if (!report) fail(report.error().message);
    device::start_timing(**device);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < asked.repeat; ++i) {
        report = drawn();
        if (!report) fail(report.error().message);
    }
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print(*report, **device, asked.repeat, wall_s / asked.repeat, only);
}
