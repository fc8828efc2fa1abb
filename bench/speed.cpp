// One picture through one engine, timed: what `./dev bench speed` runs once per line of its tables, each time
// in a new process, so that the peak of memory is that of this run.
//
// The picture is read first and does not count. The f-number is set so that the largest radius is --radius.
// Of --repeat runs each time is the least, stage by stage: what others do on the machine only adds to it. All
// but the first find their kernels made; what the first takes longer is kernels_s. Each run has another
// picture, as in a shot; with --same-picture 1 it has the same one, whose surfaces the session keeps (third
// run on).
#include "petzval/session.h"

#include "job.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace petzval;
using bench::cpu_seconds;
using bench::fail;

struct Options : bench::Asked {
    double limit_s = 60;
    int threads = 0, mirror = 1, pupil_points = 64;
    bool same_picture = false;
};

Options parse(int count, char** words) {
    Options options;
    bench::read_words(count, words, options, [&](const std::string& flag, const std::string& value) {
        if (flag == "--limit")
            options.limit_s = std::stod(value);
        else if (flag == "--threads")
            options.threads = std::stoi(value);
        else if (flag == "--mirror")
            options.mirror = std::stoi(value);
        else if (flag == "--pupil-points")
            options.pupil_points = std::stoi(value);
        else if (flag == "--same-picture")
            options.same_picture = std::stoi(value) != 0;
        else
            return false;
        return true;
    });
    return options;
}

// times x times copies, every other one mirrored: more pixels of the same content, without new edges.
template <typename T>
Image<T> mirrored(const Image<T>& one, int times) {
    Image<T> all = Image<T>::uninitialised(one.width() * times, one.height() * times);
    const auto fold = [](int i, int size) { return i / size % 2 ? size - 1 - i % size : i % size; };
    for (int y = 0; y < all.height(); ++y)
        for (int x = 0; x < all.width(); ++x) all(x, y) = one(fold(x, one.width()), fold(y, one.height()));
    return all;
}

// Makes another picture: a session that knows the one before reuses no surfaces.
void change(Picture& colour) {
    for (int y = 0; y < colour.height(); ++y) colour(0, y).g += 0.001f;
}

// The peak since this was called, MiB; Linux alone can forget an earlier one.
void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }
double peak_memory_mib() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
    return 0;
}

struct Measured {
    int width = 0, height = 0;
    double radius_px = 0, wall_s = 1e30, cpu_s = 1e30, first_wall_s = 0;
    std::vector<StageTime> stages;

    void add(const DefocusReport& report, double run_wall_s, double run_cpu_s) {
        if (stages.empty()) first_wall_s = run_wall_s;
        width = report.image.width();
        height = report.image.height();
        radius_px = std::max(report.largest_radius_px, -report.smallest_radius_px);
        wall_s = std::min(wall_s, run_wall_s);
        cpu_s = std::min(cpu_s, run_cpu_s);
        if (stages.empty()) stages = report.stages;
        for (std::size_t i = 0; i < std::min(stages.size(), report.stages.size()); ++i)
            stages[i].seconds = std::min(stages[i].seconds, report.stages[i].seconds);
    }
    void print(double f_number) const {
        std::printf("{\"width\": %d, \"height\": %d, \"radius_px\": %.2f, \"f_number\": %.5f, ", width,
                    height, radius_px, f_number);
        std::printf("\"wall_s\": %.4f, \"cpu_s\": %.4f, \"kernels_s\": %.4f, ", wall_s, cpu_s,
                    std::max(0.0, first_wall_s - wall_s));
        std::printf("\"peak_mib\": %.0f, ", peak_memory_mib());
        bench::print_stages(stages);
        std::printf("}\n");
    }
};

}  // namespace

int main(int count, char** words) {
    const Options options = parse(count, words);
    Result<Frame> frame = read_frame(options.file);
    if (!frame) fail(frame.error().message);
    Picture colour = mirrored(frame->colour, options.mirror);
    const Plane depth_m = mirrored(frame->depth, options.mirror);

    DefocusJob job = bench::job_of(colour, depth_m, frame->camera, options);
    job.pupil_points = options.pupil_points;
    *frame = Frame{};

    Session session({.threads = options.threads});
    Measured measured;
    for (int run = 0; run < options.repeat; ++run) {
        if (!options.same_picture) change(colour);
        forget_peak_memory();
        const auto start = std::chrono::steady_clock::now();
        const double cpu_start = cpu_seconds();
        const auto in_time = [&](double) { return cpu_seconds() - cpu_start < options.limit_s; };
        const Result<DefocusReport> report = session.defocus(job, {.progress = in_time});
        const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (!report && report.error().code != ErrorCode::Cancelled) fail(report.error().message);
        if (!report) {
            std::printf("{\"cancelled_after_cpu_s\": %.1f}\n", cpu_seconds() - cpu_start);
            return 0;
        }
        measured.add(*report, wall_s, cpu_seconds() - cpu_start);
    }
    measured.print(job.camera.f_number);
}
