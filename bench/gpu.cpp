// One picture drawn by a device of Vulkan, each of its passes timed by the device's own clock: what `./dev
// bench gpu` runs. The first frame is not counted. The f-number is set so that the largest radius is
// --radius.
#include "petzval/devices.h"
#include "petzval/files.h"
#include "petzval/names.h"
#include "petzval/session.h"

#include "device/vulkan/vulkan_device.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace petzval;

struct Options {
    std::string file, engine = "scatter", lens = "ideal", device = "gpu:0";
    Quality quality = Quality::Standard;
    double radius_px = 32;
    int repeat = 3;
};

[[noreturn]] void fail(const std::string& message) {
    std::fprintf(stderr, "petzval_bench_gpu: %s\n", message.c_str());
    std::exit(2);
}

Options parse(int count, char** words) {
    if (count < 2) fail("FILE.exr [--device|--engine|--quality|--lens|--radius|--repeat VALUE]…");
    Options options;
    options.file = words[1];
    for (int i = 2; i + 1 < count; i += 2) {
        const std::string flag = words[i], value = words[i + 1];
        if (flag == "--device")
            options.device = value;
        else if (flag == "--engine")
            options.engine = value;
        else if (flag == "--lens")
            options.lens = value;
        else if (flag == "--radius")
            options.radius_px = std::stod(value);
        else if (flag == "--repeat")
            options.repeat = std::stoi(value);
        else if (flag == "--quality") {
            const Result<Quality> quality = petzval::parse<Quality>(value);
            if (!quality) fail("--quality " + value + ": " + quality.error().message);
            options.quality = *quality;
        } else
            fail("unknown flag " + flag);
    }
    return options;
}

float largest(const Plane& radii) {
    float most = 0;
    for (std::size_t i = 0; i < radii.size(); ++i) most = std::max(most, std::abs(radii.pixels()[i]));
    return most;
}

void print(const DefocusReport& report, const device::Device& device, int frames, double wall_s) {
    std::printf(
        "{\"device\": \"%s\", \"width\": %d, \"height\": %d, \"wall_s\": %.4f, \"copied_bytes_per_s\": "
        "%.4g, ",
        report.device.c_str(), report.image.width(), report.image.height(), wall_s,
        device::copied_bytes_per_s(device));
    std::printf("\"passes\": {");
    const char* separator = "";
    for (const device::PassTime& pass : device::pass_times(device)) {
        std::printf("%s\"%s\": {\"runs\": %.1f, \"ms\": %.4f}", separator, pass.pass.c_str(),
                    double(pass.runs) / frames, 1e3 * pass.seconds / frames);
        separator = ", ";
    }
    std::printf("}, \"stages\": {");
    separator = "";
    for (const StageTime& stage : report.stages) {
        std::printf("%s\"%s\": {\"seconds\": %.4f, \"bytes\": %llu, \"multiply_adds\": %llu}", separator,
                    stage.stage.c_str(), stage.seconds, static_cast<unsigned long long>(stage.bytes),
                    static_cast<unsigned long long>(stage.multiply_adds));
        separator = ", ";
    }
    std::printf("}}\n");
}

}  // namespace

int main(int count, char** words) {
    const Options options = parse(count, words);
    Result<Frame> frame = read_frame(options.file);
    if (!frame) fail(frame.error().message);
    if (!frame->camera.focal_length_mm || !frame->camera.sensor_width_mm || !frame->camera.focus_distance_m)
        fail("the picture lacks camera numbers; make it with `petzval scene make`");
    DefocusJob job;
    job.colour = frame->colour, job.depth_m = frame->depth;
    job.place = Place::whole(frame->colour.rect());
    job.camera = {frame->camera.focal_length_mm->value, frame->camera.sensor_width_mm->value, 1,
                  frame->camera.focus_distance_m->value};
    job.lens.name = options.lens, job.engine = options.engine, job.quality = options.quality;
    const Result<Plane> at_f1 = circle_of_confusion(job);
    if (!at_f1) fail(at_f1.error().message);
    job.camera.f_number = largest(*at_f1) / options.radius_px;  // radii go with 1/f-number

    if (!options.device.starts_with("gpu:")) fail("--device is gpu:0, gpu:1, …");
    const auto device = device::open_vulkan(std::strtoul(options.device.c_str() + 4, nullptr, 10));
    if (!device) fail(device.error().message);
    SessionSettings settings;
    settings.device = options.device;
    Session session(settings);
    Result<DefocusReport> report = session.defocus(job);
    if (!report) fail(report.error().message);
    device::start_timing(**device);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < options.repeat; ++i) {
        report = session.defocus(job);
        if (!report) fail(report.error().message);
    }
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    print(*report, **device, options.repeat, wall_s / options.repeat);
}
