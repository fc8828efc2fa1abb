// petzval lens psf, table, volume, atlas and buffer: from a lens and a camera to files and their record.
#include "petzval/display_files.h"
#include "petzval/lens_json.h"
#include "petzval/lens_report.h"
#include "petzval/look_check.h"
#include "petzval/output.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/reports/words.h"
#include "petzval/session.h"

#include "records/record_json.h"

#include <algorithm>
#include <filesystem>
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

// True for a kernel or a volume of the middle; a table is always of the middle, and says so by its kind.
bool is_of_the_middle(const LensPictureFile& file) {
    if (const auto* disc = std::get_if<LensDiscSettings>(&file.picture))
        return disc->field_x == 0 && disc->field_y == 0;
    const auto* volume = std::get_if<BokehVolumeSettings>(&file.picture);
    return volume && volume->field_x == 0 && volume->field_y == 0;
}

// The first field that the look chose and `holds` is true for; empty if there is none.
template <typename Holds>
std::string first_chosen(const Look& look, const Holds& holds) {
    const std::vector<std::string> chosen = chosen_fields(look);
    const auto found = std::find_if(chosen.begin(), chosen.end(), holds);
    return found == chosen.end() ? "" : *found;
}

Error refused(const std::string& field, const std::string& why) {
    return {ErrorCode::InvalidArgument, field + " " + why, field};
}

// The lens and the camera that both kinds of files ask for.
struct Mounted {
    Lens lens;
    LensMount mount;
};
template <typename File>
Result<Mounted> mounted(File& file) {
    if (Status done = read_lens_images(file.look); !done) return done.error();
    const auto lens = Lens::open(file.look.lens);
    if (!lens) return lens.error();
    const auto mount = mounted_on(*lens, file.camera, file.width_px, file.height_px);
    if (!mount) return mount.error();
    return Mounted{*lens, *mount};
}

// The parts of a record that every verb of a lens has.
Json record_of(const std::string& verb, const Look& look, const std::string& lens, const LensMount& mount) {
    Json record = Json::parse(empty_record(verb));
    record["lens"] = Json::parse(record_of_lens(look, lens));
    record["camera"] = Json::parse(record_of_json(lens_mount_json(mount)));
    return record;
}

std::string finished(Json record, const Stopwatch& watch) {
    record["seconds"]["total"] = watch.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    return records::as_text(record);
}

}  // namespace

Status check(const LensPictureFile& file) {
    if (!is_of_the_middle(file)) return Done{};
    const std::string field = first_chosen(file.look, is_off_axis);
    if (field.empty()) return Done{};
    return refused(field,
                   "has no effect in the middle of the picture; give disc.field, as disc.field 0.5,0.3");
}

Result<LensPictureMade> make_lens_picture(LensPictureFile file,
                                          const std::function<void(const LensPictureMade&)>& drawn) {
    const Stopwatch watch;
    const auto kind = kind_of_output(file.output);
    if (!kind) return kind.error();
    if (const Status fine = check(file); !fine) return fine.error();
    const auto on = mounted(file);
    if (!on) return on.error();
    const Drawing draw(file, *kind == FileKind::Png, on->lens, on->mount);  // outlives the picture
    auto picture = std::visit(draw, file.picture);
    if (!picture) return picture.error();
    LensPictureMade made{picture->lens, on->mount.camera, picture->warning, ""};
    if (drawn) drawn(made);
    const Status done = *kind == FileKind::Png ? write_lens_view(file.output, std::move(picture->view),
                                                                 file.display, file.overwrite)
                                               : picture->write_exr();
    if (!done) return done.error();
    Json record = record_of(verb_of(file), file.look, made.lens, on->mount);
    record.update(picture->record);
    record["output"] = file.output;
    made.record = finished(std::move(record), watch);
    return made;
}

std::vector<std::string> outputs_of(const LensAtlasFiles& files) {
    const std::filesystem::path folder = files.folder;
    return {(folder / "atlas.json").string(), (folder / "atlas.bin").string()};
}

Status check(const LensAtlasFiles& files) {
    LensChoice lens = files.look.lens;  // its images are read later
    if (!files.look.aperture_image.empty()) lens.texture.image = std::make_shared<const Plane>();
    if (!files.look.kernel_image_far.empty()) lens.kernel_images.far = std::make_shared<const Picture>();
    if (const Status fine = check(files.atlas, lens); !fine) return fine.error();
    const std::string idle = files.atlas.zones == 1 ? first_chosen(files.look, is_off_axis) : "";
    if (idle.empty()) return Done{};
    return refused(idle, "has no effect with atlas.zones 1, the middle of the picture");
}

Result<LensAtlasMade> make_lens_atlas(LensAtlasFiles files, const std::function<Status()>& may_write) {
    const Stopwatch watch;
    if (const Status fine = check(files); !fine) return fine.error();
    const auto on = mounted(files);
    if (!on) return on.error();
    if (const Status fits = lens_atlas_fits(on->lens, on->mount, files.atlas, files.max_memory_bytes); !fits)
        return fits.error();
    const auto atlas = lens_atlas(on->lens, on->mount, files.atlas);
    if (!atlas) return atlas.error();
    const std::vector<std::string> outputs = outputs_of(files);
    const std::string header = lens_atlas_json(*atlas, files.look.lens.name, on->mount) + "\n";
    Status done = make_folder(files.folder);
    if (done && may_write) done = may_write();
    if (done) done = write_text(outputs[1], atlas->texels);
    if (done) done = write_text(outputs[0], header);
    if (!done) return done.error();
    Json record = record_of("lens atlas", files.look, atlas->lens, on->mount);
    record["output"] = outputs[0], record["outputs"] = outputs;
    record["radii_px"] = atlas->radii_px;
    return LensAtlasMade{atlas->lens, on->mount.camera, finished(std::move(record), watch)};
}

Result<LensBufferMade> make_lens_buffer(LensBufferFile file) {
    constexpr std::size_t kMostBytes = std::size_t(220) << 20;  // measured: 45 places, final quality
    const Stopwatch watch;
    const auto on = mounted(file);
    if (!on) return on.error();
    if (const Status fits = fits_memory("a lens buffer", kMostBytes, file.max_memory_bytes); !fits)
        return fits.error();
    const LensMount& mount = on->mount;
    const auto buffer =
        realtime_lens_buffer(on->lens, mount.camera, mount.width_px, mount.height_px, file.look.quality);
    if (!buffer) return buffer.error();
    const std::string bytes(reinterpret_cast<const char*>(buffer->values.data()),
                            buffer->values.size() * sizeof(float));
    if (const Status done = write_text(file.output, bytes, file.overwrite); !done) return done.error();
    Json record = record_of("lens buffer", file.look, on->lens.name(), mount);
    record["output"] = file.output;
    record["taps"] = buffer->taps;
    record["columns"] = buffer->columns;
    record["rows"] = buffer->rows;
    return LensBufferMade{on->lens.name(), mount.camera, finished(std::move(record), watch)};
}

}  // namespace petzval
