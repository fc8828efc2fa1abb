// petzval lens psf, table and volume: from a lens and a camera to a file and its record.
#include "petzval/display_files.h"
#include "petzval/lens_json.h"
#include "petzval/lens_report.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/reports/words.h"

#include "records/record_json.h"

#include <utility>

namespace petzval {
namespace {

using records::Json;

// The picture before it is written.
struct Drawn {
    std::string lens, warning = {};
    Json record = {};                        // the keys of this kind of picture
    Picture view = {};                       // for a PNG
    std::function<Status()> write_exr = {};  // the numbers
};

class Drawing {
public:
    Drawing(const LensPictureFile& file, bool is_png, const Lens& lens, const LensMount& mount)
        : file_(file), is_png_(is_png), lens_(lens), mount_(mount) {}

    Result<Drawn> operator()(const LensDiscSettings& of) const {
        const Status fits =
            lens_disc_fits(lens_, mount_, of.coc_radius_px, of.size_px, file_.max_memory_bytes);
        if (!fits) return fits.error();
        auto disc =
            lens_point_spread(lens_, mount_, of.coc_radius_px, of.field_x, of.field_y, of.size_px, of.raw);
        if (!disc) return disc.error();
        Drawn drawn{disc->lens};
        if (disc->lost_share > 1e-3)
            drawn.warning = plain(100 * disc->lost_share, 3) +
                            " % of the light falls outside of disc.size_px " + plain(of.size_px);
        drawn.record = {{"defocus_px", of.coc_radius_px},
                        {"field", {of.field_x, of.field_y}},
                        {"size", disc->weights.width()},
                        {"lost_share", disc->lost_share},
                        {"raw", of.raw}};
        if (is_png_) drawn.view = std::move(disc->weights);
        drawn.write_exr = [this, of, disc = std::make_shared<LensDisc>(std::move(*disc))] {
            return write_lens_disc(file_.output, *disc, of.coc_radius_px, of.field_x, of.field_y,
                                   file_.overwrite);
        };
        return drawn;
    }

    Result<Drawn> operator()(const BokehTextureSettings& of) const {
        const Status fits = bokeh_texture_fits(lens_, mount_, of, file_.max_memory_bytes);
        if (!fits) return fits.error();
        auto texture = bokeh_texture(lens_, mount_, of);
        if (!texture) return texture.error();
        Drawn drawn{texture->lens};
        drawn.record = {{"columns", of.columns},
                        {"rows", texture->energy.height()},
                        {"rows_per_px", of.rows_per_px},
                        {"coc_radius_px", texture->coc_radius_px}};
        if (is_png_) drawn.view = std::move(texture->view);
        drawn.write_exr = [this, of, texture = std::make_shared<BokehTexture>(std::move(*texture))] {
            return write_bokeh_texture(file_.output, *texture, of, mount_, file_.overwrite);
        };
        return drawn;
    }

    Result<Drawn> operator()(const BokehVolumeSettings& of) const {
        if (Status fits = bokeh_volume_fits(of, file_.max_memory_bytes); !fits) return fits.error();
        auto volume = bokeh_volume(lens_, mount_, of);
        if (!volume) return volume.error();
        Drawn drawn{volume->lens};
        drawn.record = {{"coc_radius_px", volume->coc_radius_px}, {"size", volume->slices[0].width()}};
        if (is_png_) drawn.view = stacked_slices(*volume);
        drawn.write_exr = [this, volume = std::make_shared<BokehVolume>(std::move(*volume))] {
            return write_bokeh_volume(file_.output, *volume, mount_, file_.overwrite);
        };
        return drawn;
    }

private:
    const LensPictureFile& file_;
    const bool is_png_;
    const Lens& lens_;
    const LensMount& mount_;
};

const char* verb_of(const LensPictureFile& file) {
    constexpr const char* kVerbs[] = {"lens psf", "lens table", "lens volume"};
    return kVerbs[file.picture.index()];
}

}  // namespace

Result<LensPictureMade> make_lens_picture(LensPictureFile file,
                                          const std::function<void(const LensPictureMade&)>& drawn) {
    const Stopwatch watch;
    const auto kind = kind_of_output(file.output);
    if (!kind) return kind.error();
    if (Status done = read_lens_images(file.look); !done) return done.error();
    const auto lens = Lens::open(file.look.lens);
    if (!lens) return lens.error();
    const auto mount = mounted_on(*lens, file.camera, file.width_px, file.height_px);
    if (!mount) return mount.error();
    const Drawing draw(file, *kind == FileKind::Png, *lens, *mount);  // outlives the picture
    auto picture = std::visit(draw, file.picture);
    if (!picture) return picture.error();
    LensPictureMade made{picture->lens, mount->camera, picture->warning, ""};
    if (drawn) drawn(made);
    const Status done = *kind == FileKind::Png ? write_lens_view(file.output, std::move(picture->view),
                                                                 file.display, file.overwrite)
                                               : picture->write_exr();
    if (!done) return done.error();
    Json record = Json::parse(empty_record(verb_of(file)));
    record.update(picture->record);
    record["output"] = file.output;
    record["lens"] = Json::parse(record_of_lens(file.look, made.lens));
    record["camera"] = Json::parse(record_of_json(lens_mount_json(*mount)));
    record["seconds"]["total"] = watch.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    made.record = records::as_text(record);
    return made;
}

}  // namespace petzval
