// A track whose focus is by pixels: how far away each of them is, in the frame it was chosen in.
#include "petzval/frames.h"
#include "petzval/track.h"

#include <map>

namespace petzval {
namespace {

// The files of a shot that hold depth.
ShotSource depth_alone(ShotSource source) {
    source.behind.clear(), source.holdout.clear(), source.mask.clear(), source.lights.clear();
    source.read.layers.clear();
    source.read.need_colour = false;
    return source;
}

Error cannot_measure(int frame, PixelPosition pixel, const Error& why) {
    return {why.code,
            "the focus of frame " + std::to_string(frame) + ", pixel " + std::to_string(pixel.x) + "," +
                std::to_string(pixel.y) + ", cannot be measured: " + why.message,
            why.field};
}

}  // namespace

ShotSource at_frame(ShotSource source, int frame) {
    std::vector<std::string*> paths{&source.path, &source.read.depth_file, &source.behind, &source.holdout,
                                    &source.mask, &source.lights};
    for (std::string& path : source.merge) paths.push_back(&path);
    for (std::string* path : paths) *path = at_frame(*path, frame);
    return source;
}

Status measure_focus(Track& track, std::span<const int> frames, const ShotSource& source,
                     const Control& control) {
    std::map<int, double> distances_m;
    std::map<std::string, Shot> one;  // a single picture serves all its keys
    for (const auto& [frame, pixel] : track.measured_at(frames)) {
        const ShotSource here = depth_alone(at_frame(source, frame));
        auto known = one.find(here.path + '\n' + here.read.depth_file);
        if (known == one.end()) {
            auto shot = read_shot(here, control);
            if (!shot) return cannot_measure(frame, pixel, shot.error());
            one.clear();
            known = one.emplace(here.path + '\n' + here.read.depth_file, std::move(*shot)).first;
        }
        if (Status fine = focus_on_pixel(known->second, pixel); !fine)
            return cannot_measure(frame, pixel, fine.error());
        distances_m[frame] = known->second.camera.focus_distance_m->value;
    }
    track.set_focus(distances_m);
    return Done{};
}

}  // namespace petzval
