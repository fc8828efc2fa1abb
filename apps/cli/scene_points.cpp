// petzval scene points: lights without a picture, for defocus --engine sprites --points.
#include "petzval/shots/scene_files.h"

#include "console/report.h"
#include "flags/flags.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "frames.h"
#include "output.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct PointsFlags {
    std::string name, output;
    PointSettings settings;
    OverwriteFlags overwrite;
    RunFlags run;

    void add_to(Verb& verb);
    void check(const Verb& verb);
};

void PointsFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Points")
        .argument("NAME", "glints, city or drops", name)
        .value("--width", "PX", "width of the picture that gets the lights (default 960)", parse_size_px,
               settings.width)
        .value("--height", "PX", "height of that picture (default 540)", parse_size_px, settings.height)
        .value("--focal-length", "MM", "focal length of its camera (default 50mm)", parse_length_mm,
               settings.focal_length_mm)
        .value("--sensor-width", "MM", "sensor width of its camera (default 36mm)", parse_length_mm,
               settings.sensor_width_mm)
        .value("--horizon", "FRACTION",
               "height of the horizon, as a fraction of the picture from the top (default 0.5)", parse_number,
               settings.horizon)
        .value("--count", "N", "number of points (default: depends on the set)", parse_count, settings.count)
        .value("--seed", "N", "seed of all random choices (default 1)", parse_seed, settings.seed);
    FlagGroup(verb, "Output").writes("-o,--output", "FILE.csv", "x, y, depth, r, g, b, size", output);
    overwrite.add_to(verb, false);
    run.add_json_to(verb);
    run.add_log_to(verb, false);
}

void PointsFlags::check(const Verb& verb) {
    require_argument(verb, name, "the NAME of a kind of points");
    require_argument(verb, output, "-o FILE.csv");
    run.apply();
    overwrite.check();
    if (!output.ends_with(".csv")) throw UsageError("-o " + output + ": the name must end in .csv");
}

Status make_file(const PointsFlags& flags) {
    PointsFile file{.set = flags.name, .settings = flags.settings};
    file.output = flags.output;
    file.existing = flags.overwrite.existing();
    const auto made = make_points_file(file, terminal());
    if (!made) return made.error();
    return write_record(made->record, flags.run.json);
}

}  // namespace

void add_scene_points(Verb& scene, Action& chosen) {
    Verb& verb =
        add_verb(scene, "points", "write a file of lights for --points: glitter on water, a city, drops",
                 "petzval scene points city -o city.csv --focal-length 85mm\n"
                 "petzval defocus dusk.exr -o out.exr --engine sprites --points city.csv");
    auto flags = std::make_shared<PointsFlags>();
    flags->add_to(verb);
    when_typed(
        verb, chosen, flags, [](PointsFlags& typed, const Verb& of) { typed.check(of); }, make_file);
}

}  // namespace petzval::cli
