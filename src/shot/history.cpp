// The attribute petzval:history: what was done to a picture, a line each.
#include "petzval/shot.h"
#include "petzval/version.h"

#include "optics/lens_text.h"

#include <cmath>
#include <cstdio>

namespace petzval {
namespace {

std::string text_of(double value) {
    if (std::isinf(value)) return "infinity";
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", value);
    return text;
}

// Beginning of a history line about the blur of this colour.
std::string beginning(const Shot& shot) { return "defocus " + shot.colour_name + ": "; }

}  // namespace

bool was_blurred(const Shot& shot) {
    return ("\n" + shot.history).find("\n" + beginning(shot)) != std::string::npos;
}

std::string history_line(const Shot& shot, const Look& look) {
    std::string line = beginning(shot) + "petzval " PETZVAL_VERSION ", " + look.engine + ", " +
                       (optics::is_lens_text(look.lens.name) ? optics::kLensOfText : look.lens.name);
    const auto add = [&](const char* before, const std::optional<FoundNumber>& n, const char* after) {
        if (n) line += before + text_of(n->value) + after;
    };
    const FoundCamera& camera = shot.camera;
    if (shot.has_radii()) {
        line += ", radii as given";
    } else {
        add(", ", camera.focal_length_mm, " mm"), add(", sensor ", camera.sensor_width_mm, " mm");
        add(", f/", camera.f_number, ""), add(", focus ", camera.focus_distance_m, " m");
    }
    const char* before = ", with ";
    for (const FrameLayer& layer : shot.layers)
        for (const std::string& name : layer.names) line += before + name, before = ", ";
    return line;
}

}  // namespace petzval
