// One sprite for each light: a square that holds its disc.
#version 450
struct Sprite {
    vec2 middle_px;
    float radius_px, reach_px;
};
layout(binding = 0, std430) readonly buffer Sprites { Sprite sprites[]; };
layout(binding = 3, std140) uniform At {
    vec4 table;  // columns, rows, rows per pixel, largest radius
    vec2 size;   // of the picture
} at;
layout(location = 0) flat out float radius_px;
layout(location = 1) out vec2 from_middle_px;

void main() {
    Sprite sprite = sprites[gl_InstanceIndex];
    vec2 corner = 2.0 * vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) - 1.0;
    radius_px = sprite.radius_px;
    from_middle_px = corner * sprite.reach_px;
    gl_Position = vec4(2.0 * (sprite.middle_px + from_middle_px) / at.size - 1.0, 0.0, 1.0);
}
