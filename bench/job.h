// Shared by the programs of `./dev bench` that draw one picture: their arguments, and the picture as a job.
#pragma once

#include "petzval/defocus.h"
#include "petzval/files.h"
#include "petzval/names.h"

#include "process.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace petzval::bench {

struct Asked {
    std::string file, engine = "scatter", lens = "ideal";
    Quality quality = Quality::Standard;
    double radius_px = 32;
    int repeat = 1;
};

inline Quality quality_of(const std::string& name) {
    const Result<Quality> quality = parse<Quality>(name);
    if (!quality) fail("--quality " + name + ": " + quality.error().message);
    return *quality;
}

// FILE and flags, each with a value. more: takes those that Asked does not have; false: unknown.
inline void read_words(int count, char** words, Asked& asked,
                       const std::function<bool(const std::string& flag, const std::string& value)>& more) {
    if (count < 2 || count % 2 != 0)
        fail(
            "FILE.exr [--engine|--quality|--lens|--radius|--repeat VALUE]…, and what the program's head "
            "names");
    asked.file = words[1];
    for (int i = 2; i + 1 < count; i += 2) {
        const std::string flag = words[i], value = words[i + 1];
        if (flag == "--engine")
            asked.engine = value;
        else if (flag == "--lens")
            asked.lens = value;
        else if (flag == "--quality")
            asked.quality = quality_of(value);
        else if (flag == "--radius")
            asked.radius_px = std::stod(value);
        else if (flag == "--repeat")
            asked.repeat = std::stoi(value);
        else if (!more(flag, value))
            fail("unknown flag " + flag);
    }
}

// The f-number is set so that the largest radius is the one asked for. The pictures outlive the job.
inline DefocusJob job_of(const Picture& colour, const Plane& depth_m, const FoundCamera& found,
                         const Asked& asked) {
    if (!found.focal_length_mm || !found.sensor_width_mm || !found.focus_distance_m)
        fail("the picture has no camera numbers; make it with `petzval scene make`");
    DefocusJob job;
    job.colour = colour, job.depth_m = depth_m;
    job.place = Place::whole(colour.rect());
    job.camera = {found.focal_length_mm->value, found.sensor_width_mm->value, 1,
                  found.focus_distance_m->value};
    job.lens.name = asked.lens, job.engine = asked.engine, job.quality = asked.quality;
    const Result<Plane> at_f1 = circle_of_confusion(job);
    if (!at_f1) fail(at_f1.error().message);
    float largest = 0;
    for (std::size_t i = 0; i < at_f1->size(); ++i) largest = std::max(largest, std::abs(at_f1->pixels()[i]));
    job.camera.f_number = double(largest) / asked.radius_px;  // radii go with 1/f-number
    return job;
}

// Prints the stages as a member of a JSON object.
inline void print_stages(const std::vector<StageTime>& stages) {
    std::printf("\"stages\": {");
    const char* separator = "";
    for (const StageTime& stage : stages) {
        std::printf("%s\"%s\": {\"seconds\": %.4f, \"bytes\": %llu, \"multiply_adds\": %llu}", separator,
                    stage.stage.c_str(), stage.seconds, static_cast<unsigned long long>(stage.bytes),
                    static_cast<unsigned long long>(stage.multiply_adds));
        separator = ", ";
    }
    std::printf("}");
}

}  // namespace petzval::bench
