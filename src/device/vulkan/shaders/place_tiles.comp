// Squares of pixels to their places in a picture.
#version 450
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };  // x0, y0, x1, y1 of each
layout(std430, binding = 1) readonly buffer Squares { vec4 squares[]; };
layout(std430, binding = 2) buffer Picture { vec4 picture[]; };
layout(push_constant) uniform Push { uint side, width, adds; } at;  // adds: 0: what was there goes

void main() {
    const uint tile = 4u * gl_WorkGroupID.y, i = gl_GlobalInvocationID.x;
    const uint x = words[tile] + i % at.side, y = words[tile + 1u] + i / at.side;
    if (i >= at.side * at.side || x >= words[tile + 2u] || y >= words[tile + 3u]) return;
    const vec4 pixel = squares[gl_WorkGroupID.y * at.side * at.side + i];
    const uint place = y * at.width + x;
    picture[place] = at.adds != 0u ? picture[place] + pixel : pixel;
}
