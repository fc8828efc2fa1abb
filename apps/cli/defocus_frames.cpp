#include "defocus_frames.h"

#include "console/console.h"
#include "flags/defocus_flags.h"

#include <cmath>
#include <utility>

namespace petzval::cli {
std::vector<std::string> TrackFlags::rack_in_metres() const {
    std::vector<std::string> keys = rack;
    for (std::string& key : keys) {
        const std::size_t colon = key.find(':');
        if (colon == std::string::npos || key.find(',') != std::string::npos) continue;
        const auto metres = parse_length_m(key.substr(colon + 1));
        if (!metres) throw UsageError("--rack " + key + ": " + metres.error().message);
        key = key.substr(0, colon + 1) + (std::isinf(*metres) ? "inf" : plain(*metres, 17));
    }
    return keys;
}

void TrackFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Frames")
        .reads("--track", "FILE",
               "animate focus, aperture and look: a CSV or JSON file with the columns frame, focus (m) or "
               "focus_x, focus_y (pixels), fstop, focal_length (mm), and look fields such as lens.blades",
               file)
        .values("--rack", "FRAME:X,Y",
                "a focus pull: frames with the pixel to focus on, such as 1001:80,45, or with a distance, "
                "such as "
                "1024:3.2m; between them the focus moves evenly in dioptres",
                rack)
        .value("--focus-speed", "DIOPTRES", "limit the focus change of a track, in dioptres per frame",
               parse_positive, focus_speed)
        .value("--temporal", "N",
               "fill hidden background from up to N neighbouring frames before and after, matched by motion "
               "vectors, or by worldToCamera and depth (default 0)",
               parse_index, temporal)
        .value(
            "--motion", "LAYER",
            "motion vectors for --temporal, such as Vector or forward; off: cameras only; still: the "
            "camera stands still; estimate: motion estimated from colour and depth (default: found by name)",
            parse_text, motion)
        .value("--motion-scale", "S[,SY]",
               "multiply vectors to get pixels per frame, +x right and +y up: 2 for a shutter of half a "
               "frame, -1 for the other direction (default 1)",
               parse_motion_scale, motion_scale);
}

std::vector<std::string> TrackFlags::given() const {
    std::vector<std::string> names;
    if (!file.empty()) names.emplace_back("--track");
    if (!rack.empty()) names.emplace_back("--rack");
    if (focus_speed) names.emplace_back("--focus-speed");
    if (temporal > 0) names.emplace_back("--temporal");
    if (!motion.empty()) names.emplace_back("--motion");
    if (motion_scale) names.emplace_back("--motion-scale");
    return names;
}

MotionReading TrackFlags::reading() const {
    MotionReading reading = motion_reading(motion);
    if (motion_scale) reading.scale_x = motion_scale->x, reading.scale_y = motion_scale->y;
    return reading;
}

bool is_sequence(const DefocusFlags& flags) {
    const bool from_many = has_pattern(flags.input.path);
    const auto tracked = flags.track.given();
    if (!is_sequence(flags.frames, {flags.input.path}, flags.output, flags.run)) {
        if (tracked.empty()) return false;
        throw UsageError(listed(tracked) + " is for shots: neither the input nor -o contains #### or %04d");
    }
    const bool is_tracked = !flags.track.file.empty() || !flags.track.rack.empty();
    if (!from_many && flags.frames.frames.empty() && !is_tracked)
        throw UsageError("-o " + flags.output +
                         " names many frames, but the input is one picture: give the " +
                         "frames with --frames, --track or --rack, or write #### into the input too");
    for (const auto& [given, name] : {std::pair{!flags.track.motion.empty(), "--motion"},
                                      {flags.track.motion_scale.has_value(), "--motion-scale"}})
        if (given && flags.track.temporal == 0)
            throw UsageError(std::string(name) + " has no effect without --temporal");
    return true;
}

}  // namespace petzval::cli
