// What the dispatches of the pass for real time share (docs/design/realtime.md).
layout(push_constant) uniform Push {
    ivec2 size, tiles;          // pixels; tiles of 16 x 16 of them
    float add_px, per_depth_px;  // a signed radius is add_px + per_depth_px * depth
    float most_px, aspect;       // radii are cut there; vertical ones are `aspect` times as large
    uint has_layer;
} at;

const float kMostLight = 60000;  // that cells hold
const int kTile = 16;            // pixels
const int kLayers = 4, kBackLight = 0, kBack = 1, kNearLight = 2, kNear = 3;  // of cells
const int kLampLight = 4, kLampPlace = 5;  // of the finest alone: a quarter of its light; place in the cell, signed radius
const int kGatheredBack = 0, kGatheredNear = 1, kGatheredArea = 2;            // of what is gathered

vec4 light_of(vec4 colour) { return clamp(colour, vec4(0), vec4(kMostLight)); }
float brightness(vec4 light) { return light.r + light.g + light.b; }
float radius_of(float depth) {
    const float radius = at.add_px + at.per_depth_px * depth;
    return radius == radius ? clamp(radius, -at.most_px, at.most_px) : 0.0;
}
// The share of something at a radius that is drawn blurred; the rest stays sharp.
float blurred_share(float radius_px) { return smoothstep(0.5, 2.0, radius_px); }
