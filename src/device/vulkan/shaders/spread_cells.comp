// The light of pixels, averaged into the cells of one blur: a cell an invocation, or a group where cells are wide.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kWide = 0;  // 1: a group for each cell

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 2) readonly buffer Values { float values[]; };  // radius, or share of the sharp picture
layout(std430, binding = 3) writeonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 4) writeonly buffer Covered { float covered_of[]; };
#include "mix.glsl"

shared vec4 part_light[256];
shared float part_covered[256];

// Of a pixel's light, in this blur.
float share(float value) {
    if (at.law != kLayered) return 1;
    const vec3 w = shares(value);
    const bool near = value < 0;
    switch (at.blur) {
        case kNearLarge: return near ? w.z : 0;
        case kNearSmall: return near ? w.y : 0;
        case kFarSmall: return near ? 0 : w.y;
        case kFarLarge: return near ? 0 : w.z;
    }
    return near ? w.x : 1;
}

void main() {
    const uint own = gl_LocalInvocationIndex, across = fact(at.blur, 1u), rows = fact(at.blur, 4u);
    const uint level = fact(at.blur, 0u), size = 1u << level;
    const uint cell = kWide != 0u ? gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x
                                  : (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + own;
    if (cell >= across * rows) return;  // for all of a group where it is wide
    const uvec2 corner = uvec2(cell % across, fact(at.blur, 3u) + cell / across) << level;
    const float per_cell = 1 / float(size * size);
    vec4 light = vec4(0);
    float covered = 0;
    const uint step = kWide != 0u ? 256u : 1u, first = kWide != 0u ? own : 0u;
    for (uint i = first; i < size * size; i += step) {
        const uvec2 pixel = corner + uvec2(i & (size - 1u), i >> level);
        if (pixel.x >= at.width || pixel.y >= at.height) continue;
        const uint k = (pixel.y - at.first_row) * at.width + pixel.x;
        const float part = share(values[k]) * per_cell;
        light += part * colours[k];
        covered += part;
    }
    if (kWide != 0u) {
        part_light[own] = light, part_covered[own] = covered;
        for (uint half_size = 128u; half_size > 0u; half_size /= 2u) {
            barrier();
            if (own < half_size) {
                part_light[own] += part_light[own + half_size];
                part_covered[own] += part_covered[own + half_size];
            }
        }
        if (own > 0u) return;
        light = part_light[0], covered = part_covered[0];
    }
    light_of[fact(at.blur, 5u) + cell] = light;
    covered_of[fact(at.blur, 5u) + cell] = covered;
}
