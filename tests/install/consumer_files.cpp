// Writes FOLDER/beauty.exr, a lamp 10 m away with its camera, and reads it as a shot.
#include <cstdio>
#include <petzval/files.h>
#include <petzval/shot.h>
#include <string>

int main(int, char** arguments) {
    const std::string path = std::string(arguments[1]) + "/beauty.exr";
    petzval::Plane red(120, 60, 0.1f);
    const petzval::Plane others(120, 60, 0.1f), depth(120, 60, 10);
    red(60, 30) = 40;
    petzval::WriteOptions options;
    options.camera.focal_length_mm = petzval::FoundNumber{50, ""};
    options.camera.sensor_width_mm = petzval::FoundNumber{36, ""};
    options.camera.f_number = petzval::FoundNumber{4, ""};
    const auto written =
        petzval::write_exr_planes(path, petzval::Place::whole(red.rect()),
                                  {{"R", red}, {"G", others}, {"B", others}, {"Z", depth}}, options);
    petzval::ShotSource source;
    source.path = path;
    source.camera.focus_distance_m = 2;
    const auto shot = petzval::read_shot(source);
    if (!written || !shot) return 1;
    const auto missing = petzval::read_frame("no such file.exr", {});
    return petzval::rendered(*shot) && !missing && std::puts(missing.error().message.c_str()) >= 0 ? 0 : 1;
}
