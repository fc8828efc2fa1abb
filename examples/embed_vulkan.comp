// The host's own renderer: four balls on a chequered floor, lamps far behind; one ray a pixel.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) writeonly uniform image2D colour;
layout(binding = 1, r32f) writeonly uniform image2D depth;  // reversed and infinite: near / z
layout(push_constant) uniform Push { float near_m, height_over_depth; } at;

const vec3 kEye = vec3(0, 0.75, 0);

// Distance along the ray to a ball, or a very large one.
float ball(vec3 ray, vec3 middle, float radius) {
    const vec3 to = middle - kEye;
    const float along = dot(to, ray), off = dot(to, to) - along * along;
    return off < radius * radius && along > 0 ? along - sqrt(radius * radius - off) : 1e9;
}

void main() {
    const ivec2 size = imageSize(colour), pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size))) return;
    const vec2 p = (vec2(pixel) + 0.5 - 0.5 * vec2(size)) / float(size.y) * at.height_over_depth;
    const vec3 ray = normalize(vec3(p.x, -p.y, 1));
    // The sky, with a lamp in some of its squares.
    const vec2 square = floor(vec2(pixel) / 24.0);
    const float chance = fract(sin(dot(square, vec2(12.9898, 78.233))) * 43758.5453);
    const bool lamp = ray.y > 0.02 && chance > 0.86 &&
                      all(equal(pixel, ivec2(square * 24.0) + 4 + ivec2(fract(chance * vec2(917, 331)) * 16)));
    vec3 light = lamp ? 150.0 * mix(vec3(1, 0.5, 0.2), vec3(0.5, 0.7, 1), fract(chance * 57))
                      : mix(vec3(0.05, 0.06, 0.10), vec3(0.01, 0.01, 0.03), clamp(ray.y * 3, 0, 1));
    float nearest = 1e9;
    if (ray.y < -1e-4) {
        nearest = -kEye.y / ray.y;
        const vec3 place = kEye + nearest * ray;
        const float even = mod(floor(2 * place.x) + floor(2 * place.z), 2);
        light = mix(vec3(0.10, 0.09, 0.08), vec3(0.35, 0.33, 0.30), even) / (1 + 0.002 * nearest * nearest);
    }
    const vec4 balls[4] = vec4[](vec4(-0.38, 0.55, 0.9, 0.2), vec4(0.1, 0.35, 2.0, 0.35), vec4(1.3, 0.5, 4.0, 0.5),
                                 vec4(-2.2, 0.8, 7.0, 0.8));
    for (int i = 0; i < 4; ++i) {
        const float there = ball(ray, balls[i].xyz, balls[i].w);
        if (there >= nearest) continue;
        nearest = there;
        const vec3 n = (kEye + there * ray - balls[i].xyz) / balls[i].w;
        const vec3 paint = 0.5 + 0.45 * cos(vec3(0, 2, 4) + 1.7 * float(i));
        light = paint * (0.05 + 0.8 * max(0.0, dot(n, normalize(vec3(-0.5, 0.8, -0.4)))));
        light += 4 * pow(max(0.0, dot(reflect(ray, n), normalize(vec3(-0.5, 0.8, -0.4)))), 200);
    }
    imageStore(colour, pixel, vec4(light, 1));
    const float z = nearest * ray.z;  // along the axis
    imageStore(depth, pixel, vec4(nearest < 1e8 ? at.near_m / z : 0));
}
