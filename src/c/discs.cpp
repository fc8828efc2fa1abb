// Discs of a lens behind the C door, written into a host's memory. Needs neither sessions nor devices nor
// files.
#include "petzval/lens_json.h"
#include "petzval/lens_kernel.h"
#include "petzval/petzval_c.h"

#include "c/handles.h"
#include "c/lens_handle.h"
#include "c/lens_mount.h"
#include "c/lent.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

petzval_status write_disc(const Lens& lens, const LensMount& mount, const petzval_disc& asked,
                          const ColourView& into, petzval_disc_report* report) {
    const auto disc = lens_point_spread(lens, mount, asked.coc_radius_px, asked.field_x, asked.field_y,
                                        into.width, asked.raw != 0);
    if (!disc) return fail(disc.error());
    write_pixels(disc->weights, into);
    if (report) {
        const petzval_disc_report whole{report->size, disc->needed_px, disc->lost_share};
        std::memcpy(report, &whole, std::min(report->size, sizeof whole));
    }
    return PETZVAL_OK;
}

BokehTextureSettings settings_of(const petzval_texture* given) {
    const petzval_texture t = c::taken(given);
    BokehTextureSettings settings;
    if (t.columns != 0) settings.columns = t.columns;
    if (t.largest_coc_px != 0) settings.largest_coc_px = t.largest_coc_px;
    if (t.rows_per_px != 0) settings.rows_per_px = t.rows_per_px;
    settings.dense_near_focus = t.even == 0;
    settings.raw = t.raw != 0;
    settings.threads = t.threads;
    return settings;
}

petzval_status write_texture(const BokehTexture& texture, bool view, const ColourView& into) {
    const Picture& made = view ? texture.view : texture.energy;
    if (into.height < made.height())
        return fail(PETZVAL_INVALID_ARGUMENT, "out is " + std::to_string(into.height) +
                                                  " pixels high; this texture needs " +
                                                  std::to_string(made.height()));
    Picture padded(into.width, into.height);
    for (int y = 0; y < made.height(); ++y)
        for (int x = 0; x < made.width(); ++x) padded(x, y) = made(x, y);
    write_pixels(padded, into);
    return PETZVAL_OK;
}

LensAtlasSettings settings_of(const petzval_atlas* given) {
    const petzval_atlas a = c::taken(given);
    LensAtlasSettings settings;
    if (a.largest_coc_px != 0) settings.largest_coc_px = a.largest_coc_px;
    if (a.zones != 0) settings.zones = a.zones;
    return settings;
}

}  // namespace

petzval_status petzval_lens_disc_size(const petzval_lens* lens, const petzval_lens_mount* mount,
                                      const petzval_disc* disc, int* size_px) {
    if (!lens) return missing("lens");
    if (!disc) return missing("disc");
    if (!size_px) return missing("size_px");
    return guarded([&] {
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        const auto size = largest_disc_px(lens->lens, *mounted, c::taken(disc).coc_radius_px);
        if (!size) return fail(size.error());
        *size_px = *size;
        return PETZVAL_OK;
    });
}

petzval_status petzval_lens_disc(const petzval_lens* lens, const petzval_lens_mount* mount,
                                 const petzval_disc* disc, const petzval_pixels* out,
                                 petzval_disc_report* report) {
    if (!lens) return missing("lens");
    if (!disc) return missing("disc");
    return guarded([&] {
        const auto into = c::colour_view(out, "out");
        if (!into) return fail(into.error());
        if (into->width != into->height || into->width % 2 == 0)
            return fail(PETZVAL_INVALID_ARGUMENT, "out must be a square of an odd number of pixels");
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        return write_disc(lens->lens, *mounted, c::taken(disc), *into, report);
    });
}

petzval_status petzval_lens_texture_rows(const petzval_lens* lens, const petzval_lens_mount* mount,
                                         const petzval_texture* texture, int* rows) {
    if (!lens) return missing("lens");
    if (!rows) return missing("rows");
    return guarded([&] {
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        const auto most = most_texture_rows(lens->lens, *mounted, settings_of(texture));
        if (!most) return fail(most.error());
        *rows = *most;
        return PETZVAL_OK;
    });
}

petzval_status petzval_lens_texture(const petzval_lens* lens, const petzval_lens_mount* mount,
                                    const petzval_texture* texture, const petzval_pixels* out,
                                    double* coc_radius_px, int* used_rows) {
    if (!lens) return missing("lens");
    return guarded([&] {
        const auto into = c::colour_view(out, "out");
        if (!into) return fail(into.error());
        const BokehTextureSettings settings = settings_of(texture);
        if (into->width != settings.columns)
            return fail(PETZVAL_INVALID_ARGUMENT, "out must be texture.columns wide");
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        const auto made = bokeh_texture(lens->lens, *mounted, settings);
        if (!made) return fail(made.error());
        const petzval_status status = write_texture(*made, c::taken(texture).view != 0, *into);
        if (status != PETZVAL_OK) return status;
        if (coc_radius_px) std::copy(made->coc_radius_px.begin(), made->coc_radius_px.end(), coc_radius_px);
        if (used_rows) *used_rows = made->energy.height();
        return status;
    });
}

petzval_status petzval_lens_atlas_bytes(const petzval_atlas* atlas, size_t* bytes) {
    if (!bytes) return missing("bytes");
    const LensAtlasSettings settings = settings_of(atlas);
    return guarded([&] {
        if (const Status fine = check(settings, {}); !fine) return fail(fine.error());
        *bytes = lens_atlas_bytes(settings);
        return PETZVAL_OK;
    });
}

petzval_status petzval_lens_atlas(const petzval_lens* lens, const petzval_lens_mount* mount,
                                  const petzval_atlas* atlas, void* texels, size_t byte_count,
                                  petzval_text** header) {
    if (!header) return missing("header");
    *header = nullptr;
    if (!lens) return missing("lens");
    if (!texels) return missing("texels");
    return guarded([&] {
        const auto mounted = c::mount_of(mount, lens->lens);
        if (!mounted) return fail(mounted.error());
        const LensAtlasSettings settings = settings_of(atlas);
        if (const Status fine = check(settings, lens->lens.choice()); !fine) return fail(fine.error());
        if (byte_count < lens_atlas_bytes(settings))
            return fail(PETZVAL_INVALID_ARGUMENT, "byte_count is " + std::to_string(byte_count) +
                                                      "; this atlas needs " +
                                                      std::to_string(lens_atlas_bytes(settings)));
        const auto made = lens_atlas(lens->lens, *mounted, settings);
        if (!made) return fail(made.error());
        *header = new petzval_text{lens_atlas_json(*made, lens->lens.name(), *mounted)};
        std::memcpy(texels, made->texels.data(), made->texels.size());
        return PETZVAL_OK;
    });
}
