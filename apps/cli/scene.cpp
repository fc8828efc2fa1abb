// petzval scene: the built-in test scenes.
#include "petzval/shots/scene_files.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/camera.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <optional>
#include <utility>

namespace petzval::cli {
namespace {

struct MakeFlags {
    std::string name, output, truth, layers;
    bool motion = false;
    std::optional<int> frame;
    FrameFlags frames;
    std::optional<int> width, height;
    std::optional<WorldPoint> camera_at, look_at;
    SceneSettings scene;
    CameraFlags camera;
    OverwriteFlags overwrite;
    RunFlags run;

    void add_to(Verb& verb);
    void add_output_to(Verb& verb);
    void check(const Verb& verb);
};

void MakeFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Scene")
        .argument("NAME", "one of petzval scene list, or a .gltf or .glb file", name)
        .value("--width", "PX", "width of the picture (default 960); width or height alone keeps 16:9",
               parse_size_px, width)
        .value("--height", "PX", "height of the picture (default 540)", parse_size_px, height)
        .value("--overscan", "PX",
               "render this many extra pixels on every side, for light that the blur spreads into the frame "
               "(default 0); the truth covers only the frame",
               parse_index, scene.overscan_px)
        .value("--frame", "N", "frame of a moving scene (default 0)", parse_index, frame)
        .value("--frames", "LIST",
               "several frames of a moving scene, such as 0-11; file names contain #### or %04d",
               parse_frames, frames.frames)
        .value("--samples", "N", "lens samples per pixel of the truth (default 1024)", parse_count,
               scene.truth_samples)
        .value("--pinhole-samples", "N", "samples per pixel of the sharp picture (default 64)", parse_count,
               scene.samples)
        .value("--seed", "N",
               "seed of all random choices (default 1); for the scene random, also of the scene itself",
               parse_seed, scene.seed)
        .value("--scene-camera", "NAME",
               "camera of a glTF file, by name or by number from 1 (default: the first)", parse_text,
               scene.own_camera)
        .value("--camera-at", "X,Y,Z",
               "position of the camera in the scene's world, m (default: the scene's)", parse_place,
               camera_at)
        .value("--look-at", "X,Y,Z",
               "the point of the world in the middle of the picture (default: the scene's)", parse_place,
               look_at)
        .choice(
            "--lit-in",
            "light (default), or codes: light the scene in display codes, as programs that ignore gamma do; "
            "show that picture with --transfer linear --tone none",
            NameTable<bool>{{"light", false}, {"codes", true}}, scene.lit_in_codes)
        .choice("--depth-filter",
                "centre (default), depth of the surface at each pixel's centre; mean, antialiased: the mean "
                "of the pixel's samples, as many renderers write it",
                NameTable<bool>{{"centre", false}, {"mean", true}}, scene.depth_is_mean)
        .value("--depth-blur", "PX",
               "depth as neural networks estimate it: 1/depth blurred by a Gaussian of this standard "
               "deviation; truth "
               "and layers stay exact",
               parse_not_negative, scene.depth_blur_px)
        .value("--depth-bits", "N", "round 1/depth to 2^N even steps; N is 8 or 16", parse_bits,
               scene.depth_bits);
    camera.add_to(verb, "scene");
    add_output_to(verb);
    run.add_threads_to(verb);
    run.add_log_to(verb, true);
}

void MakeFlags::add_output_to(Verb& verb) {
    FlagGroup(verb, "Output")
        .writes_frames("-o,--output", "FILE.exr", "sharp picture, planar Z in metres and camera numbers",
                       output)
        .writes_frames("--truth", "FILE.exr",
                       "also write the ray-traced truth: the picture that this camera's lens records", truth)
        .writes_frames("--layers", "FILE.exr",
                       "also write the hidden surfaces, as a deep EXR for defocus --plate", layers)
        .on("--motion",
            "also write motion vectors of a moving scene into the sharp picture: forward.u, forward.v to the "
            "next frame, backward.u, backward.v to the previous one, in pixels, y upwards",
            motion);
    run.add_json_of_frames_to(verb);
    overwrite.add_to(verb, false);
}

SceneFiles files_of(const MakeFlags& flags) {
    SceneFiles files{.scene = flags.name, .settings = flags.scene};
    files.camera = flags.camera.choice();
    files.image_scale = flags.camera.image_scale;
    files.output = flags.output;
    files.truth = flags.truth;
    files.layers = flags.layers;
    files.existing = flags.overwrite.existing();
    files.max_memory_bytes = process_memory_bytes(flags.scene.threads);
    return files;
}

void MakeFlags::check(const Verb& verb) {
    require_argument(verb, name, "the NAME of a scene");
    require_argument(verb, output, "-o FILE.exr");
    run.apply();
    overwrite.check();
    camera.check();
    set_size(scene, width, height);
    if (camera_at) scene.camera_at = ScenePoint{camera_at->x, camera_at->y, camera_at->z};
    if (look_at) scene.look_at = ScenePoint{look_at->x, look_at->y, look_at->z};
    scene.want_truth = !truth.empty();
    scene.want_layers = !layers.empty();
    scene.want_motion = motion;
    scene.threads = run.threads;
    const SceneFiles all = files_of(*this);
    refuse(petzval::check(all));
    refuse_both(frame.has_value(), "--frame", !frames.frames.empty(), "--frames");
    scene.frame = frame.value_or(0);
    const bool many = is_sequence(frames, {}, output, run);
    if (many && frames.frames.empty())
        throw UsageError("-o " + output + " names many frames: give --frames, such as --frames 0-11");
    for (const std::string& file : outputs_of(all))
        if (many != has_pattern(file))
            throw UsageError(file + (many ? ": the output of many frames must contain #### or %04d"
                                          : ": names many frames, but -o is one picture"));
}

Status make_scene(const MakeFlags& flags) {
    ShownProgress shown(flags.run, "scene");
    SceneFiles files = files_of(flags);
    files.settings.progress = shown.progress;
    const auto made = make_scene_files(files, shown.host);
    if (!made) return made.error();
    return write_record(made->record, flags.run.json);
}

Status make_scenes(const MakeFlags& flags) {
    SceneFiles files = files_of(flags);
    RunFlags run = flags.run;
    files.record_file.swap(run.json);
    return make_frames(flags.frames, run, work_of(files, terminal()));
}

void add_list(Verb& scene, Action& chosen) {
    Verb& verb = add_verb(scene, "list", "list the scenes and their cameras", "petzval scene list");
    auto run = std::make_shared<RunFlags>();
    run->add_json_to(verb);
    when_typed(verb, [run, &chosen] {
        chosen = [run] { return tell(scene_list_text(), scene_list_record(), run->json); };
    });
}

void add_make(Verb& scene, Action& chosen) {
    Verb& verb = add_verb(
        scene, "make", "render a sharp picture with depth and camera numbers, and the ray-traced truth",
        "petzval scene make night -o night.exr\n"
        "petzval scene make post -o post.####.exr --truth truth.####.exr --frames 20-31\n"
        "petzval scene make fence -o fence.exr --truth truth.exr --width 480 --height 270 --fstop 4");
    auto flags = std::make_shared<MakeFlags>();
    flags->add_to(verb);
    when_typed(
        verb, chosen, flags, [](MakeFlags& typed, const Verb& of) { typed.check(of); },
        [](const auto& given) {
            return given.frames.frames.empty() ? make_scene(given) : make_scenes(given);
        });
}

}  // namespace

void add_scene(Verb& program, Action& chosen) {
    Verb& scene = add_verb(program, "scene", "the built-in test scenes: list and make; points of light",
                           "petzval scene list\n"
                           "petzval scene make night -o night.exr\n"
                           "petzval scene points city -o city.csv");
    add_list(scene, chosen);
    add_make(scene, chosen);
    add_scene_points(scene, chosen);
    when_typed(scene, [&scene] { require_verb(scene); });
}

}  // namespace petzval::cli
