// The registry of lenses: from a user's words to an opened lens.
#include "petzval/lens.h"

#include "base/build_id.h"
#include "base/content_hash.h"
#include "base/nearest_word.h"
#include "kernel/draw/pupil.h"
#include "kernel/lenses/aberration_curves.h"
#include "kernel/lenses/image_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "kernel/lenses/third_order.h"
#include "lens_files/shelf.h"
#include "optics/lens_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace petzval {
namespace {

using File = std::shared_ptr<const lens_files::LensFile>;

Error refuse(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }
Error refuse_field(const char* field, const std::string& message) {
    return {ErrorCode::InvalidArgument, message, field};
}

Status check_residuals(const LensChoice& choice) {
    const auto in = [](double value, double limit) { return std::abs(value) <= limit; };  // false for NaN
    if (!in(choice.spherical, 10))
        return refuse_field("lens.spherical", "lens.spherical must lie between -10 and 10");
    if (!in(choice.axial_colour, 10))
        return refuse_field("lens.axial_colour", "lens.axial_colour must lie between -10 and 10");
    if (!in(choice.lateral_colour, 10))
        return refuse_field("lens.lateral_colour", "lens.lateral_colour must lie between -10 and 10");
    if (!in(choice.coma, 10)) return refuse_field("lens.coma", "lens.coma must lie between -10 and 10");
    if (!in(choice.astigmatism, 10))
        return refuse_field("lens.astigmatism", "lens.astigmatism must lie between -10 and 10");
    const AddedAberrations& added = choice.added;
    if (!in(added.spherical_waves, 10000))
        return refuse_field("lens.added_spherical_waves",
                            "lens.added_spherical_waves must lie between -10000 and 10000 waves");
    if (added.at_f_number != 0 && !(added.at_f_number >= 0.5 && added.at_f_number <= 64))
        return refuse_field("lens.added_at_f_number",
                            "lens.added_at_f_number must be 0 (the camera's) or 0.5 to 64");
    if (!in(added.axial_colour_mm, 100))
        return refuse_field("lens.added_axial_colour_mm",
                            "lens.added_axial_colour_mm must lie between -100 and 100 mm");
    if (!in(added.field_curvature_mm, 100))
        return refuse_field("lens.added_field_curvature_mm",
                            "lens.added_field_curvature_mm must lie between -100 and 100 mm");
    if (!in(added.lateral_colour_percent, 10))
        return refuse_field("lens.added_lateral_colour_percent",
                            "lens.added_lateral_colour_percent must lie between -10 and 10");
    if (!in(choice.distortion, 0.3))
        return refuse_field("lens.distortion", "lens.distortion must lie between -0.3 and 0.3");
    if (!in(choice.focus_shift_mm, 1000))
        return refuse_field("lens.focus_shift_mm", "lens.focus_shift_mm must lie between -1000 and 1000 mm");
    if (choice.wavelengths < 0 || choice.wavelengths > 1000)
        return refuse_field("lens.wavelengths", "lens.wavelengths must be 0 (as many as needed) to 1000");
    return Done{};
}

// Checks for options that this kind of lens does not have.
Status check_kind(const LensChoice& c, LensModelKind kind) {
    if (kind != LensModelKind::Prescription && c.lateral_colour != 1)
        return refuse(
            "lens.lateral_colour multiplies the lateral colour of a lens traced from its surfaces; \"" +
            c.name + "\" has none: lens.added_lateral_colour_percent adds some");
    if (kind == LensModelKind::Prescription && (c.spherical != 1 || c.axial_colour != 1))
        return refuse(
            "lens.spherical and lens.axial_colour multiply the curves of a lens that is defined by curves; "
            "\"" +
            c.name +
            "\" is traced from its surfaces: use lens.added_spherical_waves and "
            "lens.added_axial_colour_mm");
    if (kind == LensModelKind::Prescription && c.distortion != 0)
        return refuse("lens.distortion shapes lenses drawn as curves (lens list); \"" + c.name +
                      "\" is traced from its surfaces");
    return Done{};
}

// Everything about a choice that needs no camera.
Status check(const LensChoice& choice, LensModelKind kind) {
    if (const Status status = kernel::check_aperture(choice); !status) return status;
    if (const Status status = check_residuals(choice); !status) return status;
    if (choice.kernel_images.far || choice.kernel_images.near)
        return kernel::check_kernel_images(choice.kernel_images);
    return check_kind(choice, kind);
}

std::vector<std::string> known_names() {
    std::vector<std::string> names{"ideal"};
    for (const std::string& preset : kernel::curve_preset_names()) names.push_back(preset);
    for (const lens_files::ShelfItem& item : lens_files::shelf()) names.emplace_back(item.name);
    return names;
}

// True for a name that only a file has: with a folder, or with an ending that lens files have.
bool is_file_name(const std::string& name) {
    constexpr std::array kEndings{".json", ".zmx", ".seq", ".dat", ".txt"};
    return name.find('/') != std::string::npos ||
           std::any_of(kEndings.begin(), kEndings.end(),
                       [&](const char* end) { return name.ends_with(end); });
}

// Names the lenses that a person may have meant: names that begin alike or hold the word.
Error unknown(const std::string& name) {
    const std::string shown = "\"" + name.substr(0, 100) + "\"";
    if (is_file_name(name)) return refuse_field("lens.name", "the lens file " + shown + " does not exist");
    const std::vector<std::string> known = known_names();
    std::string near_it;
    for (const std::string& lens : known) {
        const bool is_near = lens.find(name) != std::string::npos || lens.substr(0, 4) == name.substr(0, 4);
        if (is_near && near_it.size() < 250) near_it.append(near_it.empty() ? "" : ", ").append(lens);
    }
    const std::string nearest = nearest_word(name, known);
    std::string help = nearest.empty() ? "" : " (did you mean " + nearest + "?)";
    if (!near_it.empty())
        help += "; near it: " + near_it;
    else if (nearest.empty())
        help += "; some are ideal, doublet, double-gauss and petzval-portrait";
    return refuse_field("lens.name", "there is no lens or lens file " + shown + help +
                                         "; petzval lens list shows all " + std::to_string(known.size()));
}

File holding(const optics::AberrationCurves& curves) {
    lens_files::LensFile file;
    file.curves = curves;
    return std::make_shared<const lens_files::LensFile>(std::move(file));
}

// The ideal lens with added aberrations: curves without any shift.
File straight_curves() {
    return holding({"ideal", "no aberrations except those added", 50, 1, 36, {587.56}, {0, 0.5}, {{0, 0}}});
}

Result<File> file_of(const std::string& name) {
    if (name == "ideal") return straight_curves();
    if (const optics::AberrationCurves* curves = kernel::curve_preset(name)) return holding(*curves);
    auto file = lens_files::find_lens(name);
    // Damaged files keep their own message.
    if (!file) return file.error().code == ErrorCode::InvalidArgument ? unknown(name) : file.error();
    return std::make_shared<const lens_files::LensFile>(std::move(*file));
}

void add_pixels(ContentHash& hash, const void* pixels, std::size_t bytes, int width, int height) {
    hash.add(width).add(height).add(std::string_view(static_cast<const char*>(pixels), bytes));
}

template <typename Pixels>
void add_picture(ContentHash& hash, const std::shared_ptr<const Pixels>& picture) {
    hash.add(picture != nullptr);
    if (picture) add_pixels(hash, picture->pixels(), picture->bytes(), picture->width(), picture->height());
}

// Names of lenses that ship stand for themselves: the program holds their data.
std::string key_of(const LensChoice& c, const lens_files::LensFile& file) {
    ContentHash hash;
    hash.add(c.name).add(file.content_key);
    const ApertureShape& a = c.aperture;
    hash.add(a.blades).add(a.rotation_deg).add(a.curvature).add(a.squeeze).add(a.round_at_f_number);
    hash.add(c.cats_eye).add(c.barrel.size());
    for (const BarrelRim& rim : c.barrel) hash.add(rim.radius_mm).add(rim.distance_mm);
    hash.add(c.barn_doors.left).add(c.barn_doors.right).add(c.barn_doors.top).add(c.barn_doors.bottom);
    const PupilTexture& t = c.texture;
    hash.add(t.dust).add(t.scratches).add(t.onion_rings).add(t.seed);
    add_picture(hash, t.image);
    add_picture(hash, c.kernel_images.far);
    add_picture(hash, c.kernel_images.near);
    hash.add(c.focus_mode).add(c.focus_shift_mm).add(c.spherical).add(c.axial_colour).add(c.lateral_colour);
    const AddedAberrations& added = c.added;
    hash.add(added.spherical_waves).add(added.at_f_number).add(added.axial_colour_mm);
    hash.add(added.field_curvature_mm).add(added.lateral_colour_percent);
    hash.add(c.coma).add(c.astigmatism).add(c.distortion).add(c.wavelengths).add(c.light).add(c.wave);
    return hash.text();
}

bool has_images(const LensChoice& choice) { return choice.kernel_images.far || choice.kernel_images.near; }

Lens::Contents contents_of(File file, const LensChoice& choice) {
    Lens::Contents contents;
    contents.choice = choice;
    contents.kind = file->curves ? LensModelKind::Curves : LensModelKind::Prescription;
    contents.file = std::move(file);
    return contents;
}

}  // namespace

Result<Lens> Lens::open(const LensChoice& choice) {
    if (optics::is_lens_text(choice.name)) {
        const auto lens = read(choice.name, optics::kLensOfText);
        return lens ? lens->with(choice) : lens;
    }
    auto file = file_of(choice.name);
    if (!file) return file.error();
    Contents contents = contents_of(std::move(*file), choice);
    if (choice.name == "ideal") contents.kind = LensModelKind::Ideal;
    return Lens(std::make_shared<const Contents>(std::move(contents))).with(choice);
}

Result<Lens> Lens::read(std::string_view bytes, const std::string& name) {
    if (bytes.size() > lens_files::kLargestLensFile)
        return Error{ErrorCode::InvalidFile, name + ": " + std::to_string(bytes.size()) +
                                                 " bytes; lens files have at most " +
                                                 std::to_string(lens_files::kLargestLensFile)};
    auto file = lens_files::read_lens(bytes, name);
    if (!file) return file.error();
    LensChoice choice;
    choice.name = name;
    auto shared = std::make_shared<const lens_files::LensFile>(std::move(*file));
    return Lens(std::make_shared<const Contents>(contents_of(std::move(shared), choice))).with(choice);
}

Result<Lens> Lens::with(const LensChoice& choice) const {
    Contents contents = *contents_;
    contents.choice = choice;
    contents.choice.name = name();
    if (const Status status = check(contents.choice, kind()); !status) return status.error();
    contents.key = key_of(contents.choice, *contents.file);
    contents.last_mount = std::make_shared<kernel::LastMount>();
    return Lens(std::make_shared<const Contents>(std::move(contents)));
}

const LensChoice& Lens::choice() const { return contents_->choice; }
LensModelKind Lens::kind() const { return contents_->kind; }
const std::string& Lens::key() const { return contents_->key; }

// Rays of a prescription are traced from the focus distance; all else takes the radius and nothing more.
bool Lens::depends_on_focus() const { return !is_drawn() && !has_images(choice()); }

namespace kernel {
namespace {

// Aberrations, rims and waves have a size only on a camera; a flat disc and an image are of any.
bool depends_on_camera(const Lens& lens) {
    const LensChoice& c = lens.choice();
    if (!c.barrel.empty() || c.aperture.round_at_f_number > 0) return true;
    if (has_images(c)) return false;
    return lens.kind() != LensModelKind::Ideal || c.wave || adds_aberrations(c) || c.distortion != 0;
}

}  // namespace

const optics::Prescription* prescription_of(const Lens& lens) {
    return lens.is_drawn() ? nullptr : &lens.contents().file->lens;
}

const optics::AberrationCurves* curves_of(const Lens& lens) {
    return lens.is_drawn() ? &*lens.contents().file->curves : nullptr;
}

std::string lens_key(const Lens& lens, const Mount& m) {
    const std::string program = build_id();
    if (program.empty()) return {};
    ContentHash hash;
    hash.add(program).add(lens.key()).add(m.pixel_aspect);
    const Camera& camera = m.camera;
    if (depends_on_camera(lens)) {
        hash.add(camera.focal_length_mm).add(camera.sensor_width_mm).add(camera.f_number);
        hash.add(m.display_width_px).add(m.display_height_px);
    }
    if (lens.depends_on_focus()) hash.add(camera.focus_distance_m);
    return hash.text();
}

}  // namespace kernel
}  // namespace petzval
