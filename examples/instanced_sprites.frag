// Cuts a sprite into the shape of the aperture: five blades, and the rims of the barrel as this place of the frame sees them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "instanced_sprites.glsl"
layout(location = 0) flat in vec4 light;
layout(location = 1) in vec2 pupil;
layout(location = 2) flat in vec2 field;
layout(location = 3) flat in float texels_per_pupil;
layout(location = 0) out vec4 made;

void main() {
    const float kSlice = 1.2566371;  // 72 degrees
    float outside = -1;
    for (int i = 0; i < 5; ++i) {
        // The middle of a blade; a vertex points upwards, y is down.
        const float angle = (float(i) + 0.5) * kSlice - 1.5707963;
        outside = max(outside, dot(pupil, vec2(cos(angle), sin(angle))) - cos(0.5 * kSlice));
    }
    outside = max(outside, length(pupil + at.rims.x * field) - at.rims.y);
    outside = max(outside, length(pupil + at.rims.z * field) - at.rims.w);
    made = light * clamp(0.5 - outside * texels_per_pupil, 0.0, 1.0);
}
