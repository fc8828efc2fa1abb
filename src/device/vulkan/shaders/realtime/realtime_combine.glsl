// A pixel of the result. RESULT: the format of its image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2DArray cells;
layout(binding = 2) uniform sampler2D over;  // the host's transparent layer, premultiplied
layout(binding = 3) uniform sampler2DArray gathered;
layout(binding = 4, RESULT) writeonly uniform image2D result;
layout(std430, binding = 8) readonly buffer Reach { vec4 reach[]; };  // realtime_reach.comp
#include "realtime.glsl"

vec2 texel;  // size of a cell

float radius_at(ivec2 pixel) {
    return texelFetch(cells, ivec3(pixel >> 1, kRadii), 0)[(pixel.y & 1) << 1 | pixel.x & 1];
}
#include "realtime_sprites.glsl"

// Sums blurs too fine for cells of two pixels: a pixel and those around it, each over a disc of its radius, from a window
// that the group reads once. Background is seen through the pixel's own disc.
const int kRim = 3, kAcross = 8 + 2 * kRim, kSquare = 2 * kRim + 1;  // pixels
shared vec4 window[kAcross * kAcross];
shared vec2 window_discs[kAcross * kAcross];  // signed reach, at least half a pixel; light that a pixel of the disc gets
// Radii of the window's pixels, as bits. widest_px: the largest of those blurred pixel by pixel behind focus, of those in
// front of it, and of all in front of it. farthest_px: the smallest in front of focus; 0 if a pixel is behind it.
shared uint widest_px[3], farthest_px;
shared uint marks_found;        // 0 if no pixel is marked
const float kHardlyPx = 2;      // a surface with this radius is hardly blurred
const float kFarMorePx = 2;     // a surface blurred by so much more than the one beside it is far behind it
const float kAnyPx = 8;         // stands for any radius of light that cells draw (back_at)
const int kToRight = kRim * kSquare + kRim + 1;
shared float inside[kSquare * kSquare];  // by offset, from (-kRim, -kRim): half a pixel less the distance
// Light that each pixel of a disc gets: in all as much as the disc has. The numbers are distances of the eight nearest rings of
// pixels from the middle, less half a pixel, and how many pixels each has.
float of_each(float radius_px, float reach) {
    const vec4 near = clamp(reach - vec4(0.5, 0.9142, 1.5, 1.7361), vec4(0), vec4(1));
    const vec4 far = clamp(reach - vec4(2.3284, 2.5, 2.6623, 3.1056), vec4(0), vec4(1));
    return (1 - blurred_share(radius_px)) / (1 + dot(near, vec4(4, 4, 4, 8)) + dot(far, vec4(4, 4, 8, 8)));
}
// The signed reach of a disc, and the light that each of its pixels gets. A disc covers a pixel half if their middles are
// as far apart as its reach: a circle's rim bends away from a square's side.
vec2 disc_of(float radius) {
    const float all = abs(radius), square = all * all;
    if (all <= kSharpPx) return vec2(radius < 0 ? -0.5 : 0.5, 1);
    if (all >= kWholePx) return vec2(radius, 0);  // cells draw all of it
    const float on_grid = max(0.25 + 0.55 * square, square - 0.25), per_px = inversesqrt(on_grid);  // kernel/model/radius_on_grid.h
    const float reach = max(on_grid * per_px - (1.0 / 24) * per_px, 0.5);
    return vec2(radius < 0 ? -reach : reach, of_each(all, reach));
}
// Radii of the pixels that one invocation has read; widest_px and farthest_px are made of them.
struct Widest {
    vec3 widest;
    float farthest;
    uint marks;  // a bit for each silhouette pixel that is hardly blurred, and four bits later for each rim pixel
};
void read_pixel(bool is_inside, ivec2 place, ivec2 there, float radius, uint number, inout Widest found) {
    if (!is_inside) return;
    const int i = place.y * kAcross + place.x;
    const float all_px = abs(radius), fine_px = all_px > kSharpPx && all_px < kWholePx ? radius : 0.0;
    const vec2 disc = disc_of(radius);
    window[i] = finite_of(texelFetch(colours, there, 0));
    window_discs[i] = disc;
    found.widest = max(found.widest, vec3(fine_px, -fine_px, -radius));
    found.farthest = min(found.farthest, -disc.x);
    const uint mark = mark_of(radius);
    if (mark != 0u) {
        if (mark == kRimPixel && all_px < kWholePx) found.marks |= 16u << number;
        if (mark == kSilhouette && all_px < kHardlyPx && min(place.x, place.y) > 0 && max(place.x, place.y) < kAcross - 1)
            found.marks |= 1u << number;
    }
}
// The first pixel that an invocation reads, in the window. Its pixels are one cell; those on the rim have some beyond the window.
ivec2 first_place() { return 2 * ivec2(gl_LocalInvocationID.xy) - 1; }
// Reads the window; all invocations of the group call it together. Four calls and no loop, so that the reads overlap.
// Returns the marks of this invocation's pixels.
uint read_window() {
    const int own = int(gl_LocalInvocationIndex);
    const ivec2 local = ivec2(gl_LocalInvocationID.xy), place = first_place(), last = at.size - 1;
    const ivec2 pixel = 8 * ivec2(gl_WorkGroupID.xy) - kRim + place, first = clamp(pixel, ivec2(0), last), second = clamp(pixel + 1, ivec2(0), last);
    const vec4 radii = texelFetch(cells, ivec3(first >> 1, kRadii), 0);  // also of pixels beyond the picture, which are its border
    const ivec2 from = first & 1, to = second & 1;
    if (own < 3) widest_px[own] = 0u;
    if (own == 3) farthest_px = floatBitsToUint(at.most_px);
    if (own == 4) marks_found = 0u;
    const bvec2 has_first = greaterThanEqual(place, ivec2(0)), has_second = lessThan(place, ivec2(kAcross - 1));
    Widest found = Widest(vec3(0), at.most_px, 0u);
    read_pixel(has_first.x && has_first.y, place, first, radii[2 * from.y + from.x], 0u, found);
    read_pixel(has_second.x && has_first.y, place + ivec2(1, 0), ivec2(second.x, first.y), radii[2 * from.y + to.x], 1u, found);
    read_pixel(has_first.x && has_second.y, place + ivec2(0, 1), ivec2(first.x, second.y), radii[2 * to.y + from.x], 2u, found);
    read_pixel(has_second.x && has_second.y, place + 1, second, radii[2 * to.y + to.x], 3u, found);
    barrier();
    if (found.widest.x > 0) atomicMax(widest_px[0], floatBitsToUint(found.widest.x));
    if (found.widest.y > 0) atomicMax(widest_px[1], floatBitsToUint(found.widest.y));
    if (found.widest.z > 0) atomicMax(widest_px[2], floatBitsToUint(found.widest.z));
    if (found.marks != 0u) atomicOr(marks_found, found.marks);
    atomicMin(farthest_px, floatBitsToUint(max(found.farthest, 0.0)));
    if (max(local.x, local.y) < kSquare) inside[local.y * kSquare + local.x] = 0.5 - length(vec2(local.x - kRim, float(local.y - kRim) / at.aspect));
    return found.marks;
}
// Offsets of pixels that a disc reaches.
int last_offset(float radius_px) { return radius_px > kSharpPx ? min(int(ceil(max(radius_px - 0.5, 0.1))), kRim) : 0; }

// The nearest background in a direction from a pixel: farther than a near surface, and within the window. Nothing bright is
// assumed to be hidden.
struct End {
    vec4 light;
    float away, likely;  // pixels; 0: none was found
    float sharp, disc;   // share that is blurred pixel by pixel; signed reach
};
End end_of(int own, int along, float step_px, float near_px) {
    for (int i = 1; i <= kRim; ++i) {
        const int there = own + i * along;
        const float there_px = window_discs[there].x;
        if (there_px <= 0.8 * near_px) continue;
        const float farther = ramp(0.8, 0.6, there_px / near_px);
        const vec4 light = window[there];
        return End(light, float(i) * step_px, farther / (1 + at.exposure * brightness(light)), 1 - blurred_share(abs(there_px)), there_px);
    }
    return End(vec4(0), 1, 0, 0, 0);
}
// Background behind a near surface of this radius, between the two ends of four lines through a pixel. Ends that are alike
// and close count most, so edges and textures continue behind a thin surface. A line with one end is a last resort. Beside a
// lamp, the darker end of a line decides.
struct Behind {
    vec4 light;
    float sharp, disc, area;  // as in End; 0: nothing was found
    bool is_between;  // true if a line has two ends
};
Behind behind_at(int own, float near_px) {
    Behind sum = Behind(vec4(0), 0, 0, 0, false);
    [[dont_unroll]] for (int axis = 0; axis < 4; ++axis) {
        const int along = axis == 0 ? 1 : kAcross + axis - 2;
        const float step_px = 0.5 - inside[axis == 0 ? kToRight : kToRight + kSquare - 3 + axis];
        const End one = end_of(own, along, step_px, near_px), other = end_of(own, -along, step_px, near_px);
        const vec2 bright = vec2(brightness(one.light), brightness(other.light));
        vec2 w = weights_of(one.light, other.light, vec2(one.away, other.away), vec2(one.likely, other.likely));
        if (min(w.x, w.y) > 0) {
            w *= min(vec2(1), 4 * bright.yx / max(bright, vec2(1e-6)));
            sum.is_between = true;
        }
        const vec2 w_sharp = w * vec2(one.sharp, other.sharp);
        sum.light += w.x * one.light + w.y * other.light;
        sum.disc += dot(w_sharp, vec2(one.disc, other.disc));
        sum.sharp += w_sharp.x + w_sharp.y;
        sum.area += w.x + w.y;
    }
    if (sum.sharp > 0) sum.disc /= sum.sharp;
    if (sum.area > 0) sum.light *= 1 / sum.area, sum.sharp /= sum.area;
    return sum;
}
struct Fine {
    vec4 back, near;
    float back_area, area;  // of what is behind focus or taken for it, 0: `back` is sharp; of what is in front
    float wide_area;         // of what the pixel's own disc shows of light that cells blur
};
// Removes the near surface from the picture in the window. Returns the signed radius of the surface behind it. All
// invocations of the group call it together.
float reveal(int own, float radius) {
    Behind behind = Behind(vec4(0), 0, 0, 0, false);
    if (radius <= -kWholePx) behind = behind_at(own, radius);
    barrier();
    if (behind.sharp > 0) {
        window[own] = behind.light;
        window_discs[own] = vec2(behind.disc, behind.sharp * of_each(abs(behind.disc), abs(behind.disc)));
        radius = behind.disc;
        // A wide surface beside a lamp hides a rest of the lamp at most: light brighter than this says less the brighter it is, and
        // the disc of the lamp's visible part does not pass the surface.
        const float kBright = 4;  // on the host's display, where white has 3
        const float bright = at.exposure * brightness(behind.light);
        if (bright > kBright && !behind.is_between) {
            window[own] *= (kBright / bright) * (kBright / bright);
            radius = 0;
        }
    }
    barrier();
    return radius;
}
// Adds the near part of a pixel: `area` of its lens, at most 1.
void add_near(int own, float near_px, inout Fine sum) {
    const int far = last_offset(near_px);  // 0: what is in focus, a little before it
    int there = own - far * (kAcross + 1), i = (kRim - far) * (kSquare + 1);
    const int across = 2 * far + 1;
    for (int y = -far; y <= far; ++y, there += kAcross - across, i += kSquare - across) {
        for (const int end = there + across; there < end; ++there, ++i) {
            const vec2 disc = window_discs[there];
            const float area = disc.y * clamp(inside[i] - disc.x, 0.0, 1.0);
            if (area == 0) continue;
            sum.near += area * window[there];
            sum.area += area;
        }
    }
    // The covered area of a disc, counted pixel by pixel, is right to 4 %.
    if (sum.area > 1) sum.near *= 1 / sum.area, sum.area = 1;
}
// Adds the rest of it. opening: the disc of the pixel's surface, or of the one behind a near surface. Pixels whose discs are
// wider are seen through it; cells give the light of those that lie far behind it.
void add_back(int own, float radius, vec2 opening, float back_px, inout Fine sum) {
    sum.back = window[own];
    vec4 back = vec4(0);
    float back_area = 0;
    const int far = min(last_offset(back_px), last_offset(max(at.aspect, 1.0) * radius));
    // A pixel blurred by more than 2 px is drawn by cells as well, so cells there show its own surface.
    const float by_cells = ramp(3.0, 2.0, radius), far_more = by_cells > 0 ? opening.x + kFarMorePx : at.most_px;
    int there = own - far * (kAcross + 1), i = (kRim - far) * (kSquare + 1);
    const int across = 2 * far + 1;
    // On its way, light from one side crosses the place of a near surface on the other side, which hides it. Only light brighter
    // than the pixel's own is left out, or the part of the near surface that a rim pixel shows would count more.
    const bool is_rim = sum.area > 0;
    for (int y = -far; y <= far; ++y, there += kAcross - across, i += kSquare - across) {
        for (const int end = there + across; there < end; ++there, ++i) {
            const vec2 disc = window_discs[there];
            float area = clamp(min(disc.x, opening.x) + inside[i], 0.0, 1.0) * max(disc.y, opening.y);
            if (area == 0) continue;
            if (is_rim && window_discs[2 * own - there].x < -0.5 * disc.x && brightness(window[there]) > 2 * brightness(sum.back)) continue;
            if (disc.x > far_more) {
                const float wide = by_cells * blurred_share(disc.x - opening.x) * area;
                sum.wide_area += wide;
                area -= wide;
            }
            back += area * window[there];
            back_area += area;
        }
    }
    if (back_area > 1e-3) {
        sum.back = back * (1 / back_area);
        sum.back_area = min(back_area, 1.0);
    } else if (radius < 0 && radius > -kWholePx) {  // wider ones keep what cells found, or groups would show
        const Behind behind = behind_at(own, radius);
        if (behind.area > 0) {
            sum.back = behind.light;
            sum.back_area = behind.sharp;
            sum.wide_area = 1 - behind.sharp;
        } else if (sum.area > 0) {
            sum.back = sum.near / sum.area;
        }
    }
}

// Interpolates back light between the four cells around the pixel; near focus, cells as blurred as the pixel count first.
vec4 back_at(ivec2 pixel, float radius, out float is_known) {
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 - 0.5, low = floor(place);
    // Four cells have the taps of four sets: a wide disc shows the mean of them, also one behind a near surface.
    vec2 share = place - low;
    if (abs(radius) > 16) share = mix(share, vec2(0.5), ramp(16.0, 40.0, abs(radius)));
    const vec3 middle = vec3((low + 1) * texel, kGatheredArea);
    const vec4 known = textureGather(gathered, middle, 2), radii = textureGather(gathered, middle, 1);
    const float kAlikePx = 2.5;  // gathered
    const bool is_alike = radius <= 0 || (radius * radius >= kAlikePx * kAlikePx + 4 && min(min(radii.x, radii.y), min(radii.z, radii.w)) >= kAlikePx);
    is_known = 1;
    if (is_alike && known.x + known.y + known.z + known.w == 4) return textureLod(gathered, vec3((low + 0.5 + share) * texel, kGatheredBack), 0);
    vec4 w = vec4(1 - share.x, share.xx, 1 - share.x) * vec4(share.yy, 1 - share.yy) * known;
    if (!is_alike) {
        const float own = gathered_radius(radius);
        const vec4 alike = exp2(-4 / (1 + 0.5 * radius) * abs(radii - own));
        // If neither the pixel nor the cell is nearly sharp, both know the light between them.
        const vec4 blurred = clamp((min(vec4(own), radii) - 1) * (1 / 1.5), vec4(0), vec4(1));
        w *= max(mix(alike, vec4(1), blurred * blurred * (3 - 2 * blurred)), vec4(1e-4));
    }
    const float weights = w.x + w.y + w.z + w.w;
    is_known = weights > 1e-6 ? 1.0 : 0.0;
    if (weights <= 1e-6) return vec4(0);
    vec4 sum = vec4(0);
    const ivec2 last = 8 * at.tiles - 1, first = max(ivec2(low), ivec2(0)), second = min(ivec2(low) + 1, last);
    for (int i = 0; i < 4; ++i)  // as textureGather() has them
        if (w[i] > 0) sum += w[i] * texelFetch(gathered, ivec3(i == 1 || i == 2 ? second.x : first.x, i < 2 ? second.y : first.y, kGatheredBack), 0);
    return sum * (1 / weights);
}

// A silhouette pixel shows a part of the background (realtime_split.comp: own_radius). Where that lies far behind it, cells give
// this part. It follows from the colours of the pixels around that show one surface only.
void blur_background_in(ivec2 place) {
    const int own = place.y * kAcross + place.x;
    const float far_more = max(window_discs[own].x + kFarMorePx, kWholePx);
    vec4 behind = vec4(0);
    float count = 0;
    for (int y = -kAcross; y <= kAcross; y += kAcross)
        for (int there = own + y - 1; there <= own + y + 1; ++there)
            if (window_discs[there].x >= far_more) {
                behind += window[there];
                count += 1;
            }
    if (count == 0) return;
    behind *= 1 / count;
    const ivec2 last = at.size - 1, pixel = 8 * ivec2(gl_WorkGroupID.xy) - kRim + place;  // as in the window: also beyond the picture
    vec4 near = vec4(0);
    count = 0;
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[dont_unroll]] for (int x = -1; x <= 1; ++x) {
            const int there = own + y * kAcross + x;
            if (window_discs[there].x >= far_more || mark_of(radius_at(clamp(pixel + ivec2(x, y), ivec2(0), last))) != 0u) continue;
            near += window[there];
            count += 1;
        }
    if (count == 0) return;
    const vec4 light = window[own], apart = near * (1 / count) - behind;
    const float along = dot((light - behind).rgb, apart.rgb), most = dot(apart.rgb, apart.rgb);
    if (along >= most) return;
    // A pixel that no near colour explains has the background's depth and shows the background alone.
    const float share = max(along / most, 0.0);
    float is_known;
    const vec4 blurred = back_at(clamp(pixel, ivec2(0), last), kAnyPx, is_known);
    // Light off the line between both colours is divided like the rest, or the background's part of it would stay sharp.
    if (is_known > 0) window[own] = max(share * light + (1 - share) * (blurred + share * apart), vec4(0));
}
// Read from the images, because the window's outer pixels have neighbours beyond it.
float px_at(ivec2 pixel) { return radius_at(clamp(pixel, ivec2(0), at.size - 1)); }
float near_px_at(ivec2 pixel, int place) { return px_at(pixel); }
#include "realtime_rims.glsl"
void take_near_part(ivec2 place) {
    const int own = place.y * kAcross + place.x;
    float near_px, taken;
    const vec4 part = near_part(8 * ivec2(gl_WorkGroupID.xy) - kRim + place, own, window[own], near_px, taken);
    window[own] = max(window[own] - taken * part, vec4(0));
}
// All invocations of the group call it together, each for the pixels that it has read.
void divide_pixels(uint marks) {
    for (uint left = marks; left != 0u; left &= left - 1u) {
        const int number = findLSB(left);
        const ivec2 place = first_place() + ivec2(number & 1, number >> 1 & 1);
        if (number < 4) blur_background_in(place);
        else take_near_part(place);
    }
    barrier();
}

void add_near_cells(vec2 place, float w, inout vec4 near, inout vec2 area) {
    const vec4 areas = textureLod(gathered, vec3(place, kGatheredArea), 0);
    if (areas.x == 0) return;
    area += w * areas.xw;
    near += w * textureLod(gathered, vec3(place, kGatheredNear), 0);
}
// Near light between the cells around a place: the area that it covers, and that of hardly blurred light.
vec4 near_at(vec2 place, float reach_px, out vec2 area) {
    area = vec2(0);
    vec4 near = vec4(0);
    if (reach_px <= 4) {
        add_near_cells(place, 1, near, area);
        return near;
    }
    const vec2 half_cell = 0.5 * ramp(4.0, 12.0, reach_px) * texel, low = place - half_cell, high = place + half_cell;
    add_near_cells(low, 0.25, near, area);
    add_near_cells(vec2(high.x, low.y), 0.25, near, area);
    add_near_cells(vec2(low.x, high.y), 0.25, near, area);
    add_near_cells(high, 0.25, near, area);
    return near;
}

// The view that a host asked for.
vec4 viewed(vec4 made, float radius, vec4 reaches, bool is_fine, vec4 behind, vec4 before) {
    const float share = min(abs(radius) / at.most_px, 1.0);
    if (at.view == 1u) return vec4(radius < 0 ? share : 0.0, abs(radius) < 0.5 ? 0.25 : 0.0, radius > 0 ? share : 0.0, 1);
    if (at.view == 2u) return vec4(behind.rgb, 1);
    if (at.view == 3u) return before;
    if (at.view == 4u) return vec4(0, 0, 0, 1);  // lamps are added
    if (at.view == 5u) return vec4(reaches.x / at.most_px, is_fine ? 1.0 : 0.0, 0, 1);
    return made;
}

void main() {
    // A group runs as a whole or not at all, because its invocations look for lamps together.
    const ivec2 place_of_group = ivec2(gl_GlobalInvocationID.xy), pixel = min(place_of_group, at.size - 1);
    const ivec2 tile = ivec2(gl_WorkGroupID.xy) >> 1;
    texel = 0.125 / vec2(at.tiles);
    float radius = radius_at(pixel);
    const float own_px = radius;
    const vec4 reaches = reach[tile.y * at.tiles.x + tile.x];
    const int quarter = int(2u * (gl_WorkGroupID.y & 1u) + (gl_WorkGroupID.x & 1u));
    const bool has_near = reaches.z > 2, is_fine = (uint(reaches.y) >> quarter & 1u) != 0u;
    int own = 0;  // the pixel in the window
    Fine fine = Fine(vec4(0), vec4(0), 0, 0, 0);
    float back_px = 0;
    if (is_fine) {
        own = (int(gl_LocalInvocationID.y) + kRim) * kAcross + int(gl_LocalInvocationID.x) + kRim;
        const uint marks = read_window();
        barrier();
        back_px = uintBitsToFloat(widest_px[0]);
        const float near_px = uintBitsToFloat(widest_px[1]), nearest = uintBitsToFloat(widest_px[2]);
        if (marks_found != 0u) divide_pixels(marks);
        if (has_near && nearest >= kWholePx && uintBitsToFloat(farthest_px) < 0.8 * nearest) radius = reveal(own, radius);
        if (nearest > 0) add_near(own, near_px, fine);
    }
    vec2 area = vec2(0);
    vec4 near = vec4(0);
    if (reaches.x > 0.5) near = near_at((vec2(pixel) + 0.5) * (0.5 * texel), reaches.x, area);
    vec4 base = vec4(0);
    float is_known = 1;
    const float blurred = blurred_share(abs(own_px));
    // Near light that covers the pixel completely hides the rest.
    if ((area.x < 1 && fine.area < 1) || at.view == 2u) {
        if (is_fine) add_back(own, radius, own_px > 0 ? window_discs[own] : disc_of(max(radius, 0.0)), back_px, fine);
        else fine.back = finite_of(texelFetch(colours, pixel, 0));
        // A completely near pixel has no sharp part; some of its background may be known.
        base = fine.back;
        if (blurred + fine.wide_area > 0) {
            const vec4 back = back_at(pixel, fine.wide_area > 0 ? max(own_px, kAnyPx) : own_px, is_known);
            // Light drawn pixel by pixel leaves the rest of the pixel's lens to cells, whichever pixel it comes from.
            base = mix(base, back, is_known * clamp(1 - fine.back_area, 0.0, blurred + fine.wide_area));
        }
    }
    float covers = min(area.x, 1.0);
    if (area.x > 0) {
        if (is_known == 0 && own_px < 0 && blurred > 0.99) covers = 1;
        near *= covers / area.x;
    }
    float free = 1 - covers;
    if (fine.area > 0) {
        // Near light that pixels and cells both draw in part is one surface: the parts lie side by side.
        const float open = min(free + min(area.y, covers), free / fine.area);
        near += open * fine.near, free -= open * fine.area;
    }
    vec4 made = near + free * base;
    if (at.view != 0u) made = viewed(made, own_px, reaches, is_fine, base, near);
    if (at.view == 0u || at.view == 4u) add_all_lamps(pixel, tile, reaches.x, area.x > 0, 1 - fine.area, made);
    if (at.view == 0u && at.has_layer != 0u) {
        const vec4 layer = finite_of(texelFetch(over, pixel, 0));
        made = layer + (1 - layer.a) * made;
    }
    if (pixel == place_of_group) imageStore(result, pixel, made);
}
