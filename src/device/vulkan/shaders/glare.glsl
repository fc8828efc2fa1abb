// Shared by programs of glare. Formulas are glare/light.h's and device/cpu/glare/bloom.cpp's.

// A channel as glare sees it: NaN, infinities and negative light are none.
bool is_finite(float v) { return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u; }
float usable(float v) { return is_finite(v) && v > 0 ? v : 0; }
vec3 usable(vec3 c) { return vec3(usable(c.r), usable(c.g), usable(c.b)); }
float finite(float v) { return is_finite(v) ? v : 0; }

// The part of a pixel's light above the threshold.
vec3 highlight(vec3 light, float threshold) {
    const float largest = max(light.r, max(light.g, light.b));
    return largest > threshold ? (1 - threshold / largest) * light : vec3(0);
}

// Index in 0…n-1 of a mirror image that repeats the border.
int mirrored(int i, int n) {
    i = (i < 0 ? -1 - i : i) % (2 * n);
    return i < n ? i : 2 * n - 1 - i;
}

// One invocation a pixel, in rows of the most groups that any device takes.
uint invocation() { return (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex; }
