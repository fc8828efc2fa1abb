// One sprite for each pixel, four corners each: its depth decides how large it is, which way up, and into which level
// of the atlas it is shifted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "instanced_sprites.glsl"
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D radii;
layout(location = 0) flat out vec4 light;
layout(location = 1) out vec2 pupil;        // -1…1 within the circle around the aperture
layout(location = 2) flat out vec2 field;   // of the sprite: 1 at the corner of the frame
layout(location = 3) flat out float texels_per_pupil;

const float kPentagon = 2.3776413;  // area of one inscribed in the unit circle: 5/2 sin 72

void main() {
    const int across = (at.size.x + at.every - 1) / at.every;
    const ivec2 first = at.every * ivec2(gl_InstanceIndex % across, gl_InstanceIndex / across);
    vec4 sum = vec4(0);
    for (int i = 0; i < at.every * at.every; ++i)
        sum += texelFetch(colours, min(first + ivec2(i % at.every, i / at.every), at.size - 1), 0);
    const float radius = texelFetch(radii, min(first + at.every / 2, at.size - 1), 0).r, wide = abs(radius);
    gl_Position = vec4(2, 2, 0, 1);
    light = vec4(0), pupil = vec2(0), field = vec2(0), texels_per_pupil = 1;
    if (!(wide >= 0.5)) return;  // in focus: no sprite
    const int level = clamp(int(ceil(log2(wide / kWidest))), 0, at.levels - 1);
    const float scale = float(1 << level);
    texels_per_pupil = wide / scale;
    // A sprite before focus lands turned by 180 degrees: its offset is the radius times the point of the pupil.
    const vec2 corner = (2 * vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) - 1) * (1 + 1 / texels_per_pupil);
    pupil = radius < 0 ? -corner : corner;
    const vec2 middle = vec2(first) + 0.5 * float(at.every);
    const vec2 place = vec2(corner_of(level, radius < 0)) + (middle + wide * corner) / scale;
    const vec2 atlas = vec2(2 * (at.size.x + 2 * kBorder * at.levels), at.size.y + texels(at.size.y, 1) + 4 * kBorder);
    gl_Position = vec4(2 * place / atlas - 1, 0, 1);
    light = sum / (kPentagon * wide * wide);
    field = (middle - 0.5 * vec2(at.size)) / (0.5 * length(vec2(at.size)));
}
