// Codes of a display, of light: exposure, contrast, tone curve, transfer, dither. Formulas are those of
// colour/develop.cpp, tone.h and dither.h.
#version 450
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) writeonly buffer Codes { uint codes[]; };  // a word a pixel to 8 bits, else two
layout(push_constant) uniform Push {
    uint row, x0, y0, width, height;  // of the picture, and the part of it
    uint pattern_x, pattern_y;
    float exposure, contrast;
    uint tone;                        // as enum ToneCurve
    float power;                      // light = code^power; 0: sRGB
    uint dithers, largest;
} at;

const uint kReinhard = 1u, kFilmic = 2u;
const float kMidGrey = 0.18, kPalingHalf = 16, kBrightest = 1e9;

// NaN and negative values are 0.
float positive(float x) { return floatBitsToUint(x) > 0x7f800000u ? 0 : min(x, kBrightest); }
vec3 positive(vec3 c) { return vec3(positive(c.r), positive(c.g), positive(c.b)); }
float largest_of(vec3 c) { return max(c.r, max(c.g, c.b)); }

vec3 with_contrast(vec3 c) {
    const float n = largest_of(c);
    return n > 0 ? positive(kMidGrey * pow(n / kMidGrey, at.contrast) / n * c) : vec3(0);
}

vec3 reinhard(vec3 c) { return c / (1 + largest_of(c)); }

vec3 filmic(vec3 c) {
    const float n = largest_of(c);
    if (n == 0) return vec3(0);
    const float powered = pow(n / kMidGrey, 1 / (1 - kMidGrey));
    const float shown = powered / (powered + (1 - kMidGrey) / kMidGrey);
    const float paling = n * n / (n * n + kPalingHalf * kPalingHalf);
    return shown * (c / n * (1 - paling) + paling);
}

// 0…1, black and white exactly.
float encoded(float light) {
    if (light <= 0) return 0;
    if (light >= 1) return 1;
    if (at.power > 0) return at.power == 1 ? light : pow(light, 1 / at.power);
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

// `phase`: the pattern, in 2^-32.
uint dithered(float code, uint phase) {
    float noise = float(phase >> 8) / 16777216.0 - 0.5;
    if (code >= 1 && code <= float(at.largest) - 1)
        noise = phase < 0x80000000u ? sqrt(float(phase) / 2147483648.0) - 1 : 1 - sqrt(float(-phase) / 2147483648.0);
    const float whole = floor(code);
    return uint(clamp(whole + floor(code - whole + noise + 0.5), 0.0, float(at.largest)));
}

void main() {
    const uint i = (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
    if (i >= at.width * at.height) return;
    const uint x = i % at.width, y = i / at.width;
    const vec4 pixel = picture[(at.y0 + y) * at.row + at.x0 + x];
    vec3 c = positive(at.exposure * pixel.rgb);
    if (at.contrast != 1) c = with_contrast(c);
    if (at.tone == kFilmic) c = filmic(c);
    if (at.tone == kReinhard) c = reinhard(c);
    uvec4 code;
    for (uint k = 0; k < 3; ++k) {
        const uint phase = (at.pattern_x + x) * 3242174889u + (at.pattern_y + y) * 2447445414u + k * 1431655765u;
        code[k] = dithered(encoded(c[k]) * float(at.largest), at.dithers != 0u ? phase : 0x80000000u);
    }
    code.a = dithered(min(positive(pixel.a), 1) * float(at.largest), 0x80000000u);
    if (at.largest <= 255u) {
        codes[i] = code.r | code.g << 8 | code.b << 16 | code.a << 24;
    } else {
        codes[2u * i] = code.r | code.g << 16;
        codes[2u * i + 1u] = code.b | code.a << 16;
    }
}
