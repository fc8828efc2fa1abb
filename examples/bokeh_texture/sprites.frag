#version 450
#extension GL_GOOGLE_include_directive : require
#include "bokeh_texture.glsl"
layout(binding = 1) uniform texture2D table;
layout(binding = 2) uniform sampler table_sampler;
layout(binding = 3, std140) uniform At {
    vec4 table;
    vec2 size;
} at;
layout(location = 0) flat in float radius_px;
layout(location = 1) in vec2 from_middle_px;
layout(location = 0) out vec4 light;

void main() {
    BokehTable numbers = BokehTable(at.table.x, at.table.y, at.table.z, at.table.w);
    // The mean over the pixel: rims are thinner than it. One lookup will do for discs of 20 px and more.
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        vec2 at_px = from_middle_px + (vec2(i % 4, i / 4) - 1.5) / 4.0;
        sum += textureLod(sampler2D(table, table_sampler), bokeh_place(numbers, radius_px, length(at_px)), 0.0).rgb;
    }
    light = vec4(sum / 16.0, 1.0);
}
