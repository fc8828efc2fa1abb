// Frames of one picture through one session, timed: `./dev bench pull` sets them beside as many runs of the
// program.
//
// pull FILE.exr FRAMES LENS ENGINE NEAR_M FAR_M [turn]: reads once, makes FRAMES pictures with focus moving
// evenly in dioptres, writes none. With "turn", five blades turn instead, by 72 degrees in all. Prints CPU
// and wall seconds, reading included.
#include "petzval/files.h"
#include "petzval/session.h"

#include "process.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace petzval;
using bench::cpu_seconds;
using bench::fail;

}  // namespace

int main(int count, char** words) {
    if (count != 7 && count != 8) fail("FILE.exr FRAMES LENS ENGINE NEAR_M FAR_M [turn]");
    const bool turns = count == 8;
    const auto start = std::chrono::steady_clock::now();
    const auto frame = read_frame(words[1]);
    if (!frame) fail(frame.error().message);
    const FoundCamera& found = frame->camera;
    if (!found.focal_length_mm || !found.sensor_width_mm || !found.f_number)
        fail("the picture has no camera numbers; make it with `petzval scene make`");
    const int frames = std::atoi(words[2]);
    const double near_m = std::atof(words[5]), far_m = std::atof(words[6]);

    DefocusJob rendered;
    rendered.colour = frame->colour;
    rendered.depth_m = frame->depth;
    rendered.place = frame->place;
    Look look;
    look.lens.name = words[3];
    look.engine = words[4];
    Session session;
    for (int i = 0; i < frames; ++i) {
        const double share = frames > 1 ? double(i) / (frames - 1) : 0, moved = turns ? 0 : share;
        rendered.camera = {found.focal_length_mm->value, found.sensor_width_mm->value, found.f_number->value,
                           1 / ((1 - moved) / near_m + moved / far_m)};
        if (turns) look.lens.aperture.blades = 5, look.lens.aperture.rotation_deg = 72 * share;
        const auto taken = session.take(rendered, look);
        if (!taken) fail(taken.error().message);
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    std::printf("{\"cpu_s\": %.3f, \"wall_s\": %.3f, \"kept_mib\": %.1f, \"lenses\": %d}\n", cpu_seconds(),
                wall.count(), double(session.usage().kept_bytes) / (1 << 20), session.usage().lenses);
}
