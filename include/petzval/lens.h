// What the photographer mounts on the camera: a named lens and the shape of its aperture.
#pragma once

#include <string>

namespace petzval {

// Polygon inscribed in the f-stop's circle; see docs/conventions.md, "Shapes".
struct ApertureShape {
    int blades = 0;           // 0: round; else >= 3
    double rotation_deg = 0;  // first vertex, counter-clockwise from +x, in the far (upright) disc
    double curvature = 0;     // 0 straight edges … 1 circle
    double squeeze = 1;       // the disc is so many times taller than wide, > 0
};

// A lens as an engine is asked to use it. Defaults: a perfect lens with a round aperture, a flat disc.
struct LensChoice {
    std::string name = "ideal";  // a built-in lens (lens list) or the path of a lens file
    ApertureShape aperture;
    double cats_eye = 0;  // 0…1: barrel displaced by cats_eye * field, in pupil radii
};

}  // namespace petzval
