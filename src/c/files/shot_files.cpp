// libpetzval-files.so: shots read from files and written back, and scenes with their truth.
#include "petzval/display_files.h"
#include "petzval/files.h"
#include "petzval/names.h"
#include "petzval/petzval_files_c.h"
#include "petzval/scene.h"
#include "petzval/shot.h"
#include "petzval/shots/inspection.h"

#include "c/files/lent_shot.h"
#include "c/handles.h"
#include "c/lent.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

struct petzval_shot_file {
    petzval::Shot shot;
    petzval::Picture truth;
    petzval_pixels truth_pixels{};
    petzval::c::LentShot lent;
    std::string json;
};

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

std::string text_of(const char* text) { return text ? text : ""; }

std::optional<double> given(double number) { return number != 0 ? std::optional(number) : std::nullopt; }

// Errors: InvalidArgument naming the field.
Result<ShotSource> source_of(const petzval_shot_source& s) {
    if (!s.path) return Error{ErrorCode::InvalidArgument, "source.path is null"};
    if (s.layer_count > 0 && !s.layers) return Error{ErrorCode::InvalidArgument, "source.layers is null"};
    ShotSource source;
    source.path = s.path;
    ReadOptions& read = source.read;
    read.layer = text_of(s.layer), read.view_name = text_of(s.view_name);
    read.depth_file = text_of(s.depth_file), read.depth_channel = text_of(s.depth_channel);
    for (std::uint64_t i = 0; i < s.layer_count; ++i) read.layers.push_back(text_of(s.layers[i]));
    read.threads = s.threads, read.max_memory_bytes = std::size_t(s.max_memory_bytes);
    if (s.depth_kind) {
        const auto kind = parse<DepthKind>(s.depth_kind);
        if (!kind) return Error{ErrorCode::InvalidArgument, "source.depth_kind is " + kind.error().message};
        source.depth.kind = *kind, source.depth_kind_given = true;
    }
    if (s.depth_unit_m != 0) source.depth.unit_scale_m = s.depth_unit_m;
    if (s.depth_range) source.depth.range_near = s.depth_range[0], source.depth.range_far = s.depth_range[1];
    source.behind = text_of(s.behind), source.holdout = text_of(s.holdout);
    source.mask = text_of(s.mask), source.lights = text_of(s.lights);
    const petzval_camera camera = c::taken(s.camera);
    source.camera.focal_length_mm = given(camera.focal_length_mm);
    source.camera.sensor_width_mm = given(camera.sensor_width_mm);
    source.camera.f_number = given(camera.f_number);
    source.camera.focus_distance_m = given(camera.focus_distance_m);
    if (camera.thin_lens != 0) source.camera.image_scale = ImageScale::ThinLens;
    return source;
}

std::string json_of(const Shot& shot) {
    using Json = nlohmann::ordered_json;
    Json layers = Json::array();
    for (const FrameLayer& layer : shot.layers) layers.push_back(layer.names);
    return Json{{"detected", shot.detected},
                {"warnings", shot.warnings},
                {"layers", layers},
                {"views", shot.views},
                {"has_alpha", shot.has_alpha},
                {"display_referred", shot.display_referred()}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

void give(std::unique_ptr<petzval_shot_file> made, petzval_shot_file** file) {
    made->lent.fill(made->shot);
    made->json = json_of(made->shot);
    *file = made.release();
}

FoundNumber found(double value) { return {value, "the scene", false}; }

// The scene as a shot, and its truth.
std::unique_ptr<petzval_shot_file> shot_of(RenderedScene scene, int width, int height) {
    auto made = std::make_unique<petzval_shot_file>();
    Shot& shot = made->shot;
    shot.place.display_window = {0, 0, width, height};
    shot.place.data_window = scene.data_window;
    shot.colour = std::move(scene.colour);
    shot.has_alpha = true;
    shot.depth = DepthMetres{std::move(scene.depth_m)};
    shot.behind = std::move(scene.layers);
    shot.camera.focal_length_mm = found(scene.camera.focal_length_mm);
    shot.camera.sensor_width_mm = found(scene.camera.sensor_width_mm);
    shot.camera.f_number = found(scene.camera.f_number);
    shot.camera.focus_distance_m = found(scene.camera.focus_distance_m);
    shot.camera.camera_from_world = scene.camera_from_world;
    shot.image_scale = scene.camera.image_scale;
    made->truth = std::move(scene.truth);
    if (!made->truth.empty()) made->truth_pixels = c::pixels_of(made->truth);
    return made;
}

// The frame for write_exr(): the given pictures, everything else as read.
Result<Frame> frame_like(const Shot& shot, const petzval_pixels* colour, const petzval_pixels* const* layers,
                         std::uint64_t layer_count) {
    const auto read = [&](const petzval_pixels* from, const std::string& name) -> Result<Picture> {
        const auto view = c::colour_view(from, name.c_str());
        if (!view) return view.error();
        if (view->width != shot.colour.width() || view->height != shot.colour.height())
            return Error{ErrorCode::InvalidArgument, name + " must have the size of the shot's colour"};
        Picture picture = Picture::uninitialised(view->width, view->height);
        read_pixels(*view, picture);
        return picture;
    };
    if (layer_count != 0 && (layer_count != shot.layers.size() || !layers))
        return Error{ErrorCode::InvalidArgument, "layer_count is " + std::to_string(layer_count) +
                                                     "; it must be 0 or " +
                                                     std::to_string(shot.layers.size())};
    Frame frame;
    auto picture = read(colour, "colour");
    if (!picture) return picture.error();
    frame.place = shot.place;
    frame.colour = std::move(*picture);
    frame.has_alpha = shot.has_alpha;
    for (std::uint64_t i = 0; i < layer_count; ++i) {
        auto layer = read(layers[i], "layers[" + std::to_string(i) + "]");
        if (!layer) return layer.error();
        const FrameLayer& like = shot.layers[i];
        frame.layers.push_back({like.names, std::move(*layer), like.is_light, like.spectrum});
    }
    frame.layers_carried = shot.layers_carried;
    frame.camera = shot.camera;
    frame.code_bits = shot.code_bits;
    frame.carried = shot.carried;
    // A scene has no file that would hold its depth.
    if (const auto* metres = std::get_if<DepthMetres>(&shot.depth); metres && !shot.carried)
        frame.depth = metres->plane.clone();
    return frame;
}

}  // namespace

const char* petzval_files_error_text(void) { return petzval_error_text(); }

petzval_status petzval_files_read_shot(const petzval_shot_source* source, petzval_shot_file** file) {
    if (!file) return missing("file");
    *file = nullptr;
    if (!source) return missing("source");
    return guarded([&] {
        const auto from = source_of(c::taken(source));
        if (!from) return fail(from.error());
        auto shot = read_shot(*from);
        if (!shot) return fail(shot.error());
        auto made = std::make_unique<petzval_shot_file>();
        made->shot = std::move(*shot);
        give(std::move(made), file);
        return PETZVAL_OK;
    });
}

petzval_status petzval_files_inspect(const char* path, petzval_shot_file** file) {
    if (!file) return missing("file");
    *file = nullptr;
    if (!path) return missing("path");
    return guarded([&] {
        const auto header = read_frame_header(path);
        if (!header) return fail(header.error());
        auto made = std::make_unique<petzval_shot_file>();
        made->lent.shot.size = sizeof made->lent.shot;
        made->json = header_json(*header);
        *file = made.release();
        return PETZVAL_OK;
    });
}

petzval_status petzval_files_make_scene(const char* name, int width, int height, uint64_t seed,
                                        int truth_samples, petzval_shot_file** file) {
    if (!file) return missing("file");
    *file = nullptr;
    if (!name) return missing("name");
    return guarded([&] {
        SceneSettings settings;
        settings.width = width, settings.height = height, settings.seed = seed;
        settings.want_layers = true, settings.want_truth = truth_samples > 0;
        if (truth_samples > 0) settings.truth_samples = truth_samples;
        auto scene = render_scene(name, settings);
        if (!scene) return fail(scene.error());
        give(shot_of(std::move(*scene), width, height), file);
        return PETZVAL_OK;
    });
}

const petzval_shot* petzval_files_shot(const petzval_shot_file* file) {
    return file ? &file->lent.shot : nullptr;
}

const petzval_pixels* petzval_files_truth(const petzval_shot_file* file) {
    return file && !file->truth.empty() ? &file->truth_pixels : nullptr;
}

const char* petzval_files_json(const petzval_shot_file* file) { return file ? file->json.c_str() : ""; }

petzval_status petzval_files_write_like(const petzval_shot_file* file, const petzval_pixels* colour,
                                        const petzval_pixels* const* layers, uint64_t layer_count,
                                        const char* path) {
    if (!file) return missing("file");
    if (!path) return missing("path");
    return guarded([&] {
        const auto kind = kind_of_output(path);
        if (!kind || *kind != FileKind::Exr)
            return fail(Error{ErrorCode::InvalidArgument, std::string(path) + ": the name must end in .exr"});
        const auto frame = frame_like(file->shot, colour, layers, layer_count);
        if (!frame) return fail(frame.error());
        WriteOptions options;
        if (!file->shot.carried) options.camera = file->shot.camera;
        const Status written = write_exr(path, *frame, options);
        return written ? PETZVAL_OK : fail(written.error());
    });
}

void petzval_files_close(petzval_shot_file* file) { delete file; }
