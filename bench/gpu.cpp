// One picture drawn by a device of Vulkan, each of its passes timed by the device's own clock: what `./dev
// bench gpu` runs. The first frame is not counted. Beside bench/job.h's flags: --device.
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

void print(const DefocusReport& report, const device::Device& device, int frames, double wall_s) {
    std::printf(
        "{\"device\": \"%s\", \"width\": %d, \"height\": %d, \"wall_s\": %.4f, \"copied_bytes_per_s\": "
        "%.4g, ",
        report.device.c_str(), report.image.width(), report.image.height(), wall_s,
        device::copied_bytes_per_s(device));
    std::printf("\"passes\": {");
    const char* separator = "";
    for (const device::PassTime& pass : device::pass_times(device)) {
        std::printf("%s\"%s\": {\"runs\": %.1f, \"ms\": %.4f, \"bytes\": %.0f}", separator, pass.pass.c_str(),
                    double(pass.runs) / frames, 1e3 * pass.seconds / frames, double(pass.bytes) / frames);
        separator = ", ";
    }
    std::printf("}, ");
    bench::print_stages(report.stages);
    std::printf("}\n");
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
    const DefocusJob job = bench::job_of(frame->colour, frame->depth, frame->camera, asked);

    if (!settings.device.starts_with("gpu:")) fail("--device is gpu:0, gpu:1, …");
    const auto device = device::open_vulkan(std::strtoul(settings.device.c_str() + 4, nullptr, 10));
    if (!device) fail(device.error().message);
    Session session(settings);
    Result<DefocusReport> report = session.defocus(job);
    if (!report) fail(report.error().message);
    device::start_timing(**device);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < asked.repeat; ++i) {
        report = session.defocus(job);
        if (!report) fail(report.error().message);
    }
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print(*report, **device, asked.repeat, wall_s / asked.repeat);
}
