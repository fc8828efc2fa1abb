// The share of the rays to each tap of a viewpoint's disc that nothing stops.
#version 450
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Covered { float covered[]; };
layout(std430, binding = 2) writeonly buffer Visible { float visible[]; };
layout(push_constant) uniform Push { uint views; } at;

const uint kViewWords = 7;  // cover_pupil.comp

void main() {
    const uint view = at.views + kViewWords * gl_WorkGroupID.y, tap = gl_GlobalInvocationID.x;
    const uint taps = words[view + 2u], parts = words[view + 3u], wide = taps * parts;
    if (tap >= taps * taps) return;
    const uint first = words[view + 5u];
    const float per_radius = uintBitsToFloat(words[view + 4u]) * float(parts);
    const uvec2 corner = parts * uvec2(tap % taps, tap / taps);
    float inside = 0, inside_count = 0, all = 0;
    for (uint y = corner.y; y < corner.y + parts; ++y)
        for (uint x = corner.x; x < corner.x + parts; ++x) {
            const float seen = 1 - min(1.0, covered[first + y * wide + x]);
            const vec2 place = (vec2(x, y) + 0.5 - 0.5 * float(wide)) / per_radius;
            all += seen;
            if (dot(place, place) <= 1) {
                inside += seen;
                inside_count += 1;
            }
        }
    // A tap of a disc with few taps is the part inside the pupil's circle.
    visible[words[view + 6u] + tap] =
        parts > 1u && inside_count > 0 ? inside / inside_count : all / float(parts * parts);
}
