// A rim pixel shows a near surface and its background, and has the background's depth. The near surface's disc covers it once
// more, so `split` gives the near part of its light to the near surface, and `combine` takes that part out of the pixel.
// Needs `colours`; near_px_at(): the signed radius of a pixel or one beside it, at this place of a window with kAcross pixels in a
// row; px_at(): that of any pixel.
const float kRimPx = -2;  // of the near surface; of less blurred ones the pixel keeps both parts
// The near part of a pixel's light, less the background behind it. near_px: the near surface's radius; taken: the share of the
// part to take out of the pixel.
vec4 near_part(ivec2 pixel, int place, vec4 light, out float near_px, out float taken) {
    const float most_px = min(kRimPx, near_px_at(pixel, place) - 1);
    const ivec2 last = at.size - 1;
    vec4 near = vec4(0);
    float count = 0;
    ivec2 away = ivec2(0);
    near_px = taken = 0;
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[dont_unroll]] for (int x = -1; x <= 1; ++x) {
            const float there_px = near_px_at(pixel + ivec2(x, y), place + y * kAcross + x);
            if (there_px > most_px) continue;
            near += light_of(texelFetch(colours, clamp(pixel + ivec2(x, y), ivec2(0), last), 0));
            count += 1;
            near_px = min(near_px, there_px);
            away -= ivec2(x, y);
        }
    if (away == ivec2(0)) return vec4(0);
    near *= 1 / count;
    const ivec2 way = sign(2 * away / max(abs(away.x), abs(away.y)));
    // Cells get what they draw of the near surface. Pixels that draw the rest keep their own light, so half of that stays; of a
    // thing one pixel wide all of it.
    const bool is_thin = px_at(pixel - 2 * way) > 0.8 * near_px;
    const float by_cells = blurred_share(-near_px);
    taken = is_thin ? by_cells : 0.5 + 0.5 * by_cells;
    // The background here is that of the most similar of three pixels on the other side. If the pixel is mostly near even so, the
    // background here is another one: a pixel with the background's depth shows at most half of the near surface. The pixels of a
    // thin thing are mixtures too, so more of it seems to be here.
    vec4 part = vec4(0);
    const float most = is_thin ? 1.0 : 0.8;
    float least = most;
    [[dont_unroll]] for (int turn = -1; turn <= 1; ++turn) {
        const ivec2 to = sign(way + turn * ivec2(-way.y, way.x));
        if (near_px_at(pixel + to, place + to.y * kAcross + to.x) <= 0.8 * near_px) continue;
        const vec4 behind = light_of(texelFetch(colours, clamp(pixel + to, ivec2(0), last), 0)), apart = near - behind;
        const float share = dot((light - behind).rgb, apart.rgb) / max(dot(apart.rgb, apart.rgb), 1e-9);
        if (abs(share) >= least) continue;
        least = abs(share);
        part = max(share, 0.0) * apart;
    }
    return clamp(5 * (most - least), 0.0, 1.0) * part;
}
