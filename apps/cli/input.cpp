#include "input.h"

#include "petzval/shot_run.h"

#include "console/console.h"
#include "flags/fields.h"
#include "guard.h"

#include <utility>

namespace petzval::cli {

void InputFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .argument("IN",
                  "a picture: EXR, PNG, JPEG or TIFF (integer pictures are decoded with the sRGB curve); - "
                  "is standard input",
                  path)
        .value("--layer", "NAME", "colour layer or part", parse_text, read.layer)
        .value("--view-name", "NAME", "view of a stereo file, such as left; all: every view (only defocus)",
               parse_text, read.view_name);
}

void InputFlags::add_depth_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .reads("--depth", "FILE", "read depth from another file: EXR, PNG or TIFF, of any size",
               read.depth_file)
        .value("--depth-channel", "NAME", "depth channel, such as Z or ViewLayer.Depth.Z", parse_text,
               read.depth_channel)
        .choice<DepthKind>(
            "--depth-kind",
            "meaning of the depth: planar, distance along the axis (default, except for integer files); ray, "
            "distance from the pinhole; inverse, 1/planar, or with --depth-range disparity from 0 (far) to 1 "
            "(near); normalized, device, mist: 0 to 1, z-buffer or Blender's mist between --depth-range; "
            "mist-linear, mist-inverse: mist of falloff Linear or Inverse Quadratic; coc-px, signed blur "
            "radius in pixels",
            depth_kind)
        .value("--depth-range", "NEAR,FAR",
               "range of normalized, device, inverse or mist depth in scene units, such as 0.1,100; for "
               "coc-px, the radii of the values 0 and 1, such as -20,35",
               parse_range, depth_range)
        .value("--unit-scale", "METRES", "metres per unit of depth, such as 0.01, or 1cm", parse_length_m,
               unit_scale_m);
}

void InputFlags::add_transfer_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .choice<Transfer>("--transfer",
                          "transfer curve of PNG, JPEG and TIFF, read and written (default srgb)", transfer);
}

void InputFlags::add_others_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .reads("--plate,--behind", "FILE",
               "clean plate: the background without the foreground (deep EXR, or RGBA and Z)", behind)
        .values("--merge", "FILE…",
                "combine more pictures of the shot (deep EXR, or RGBA and Z), sorted by depth", merge)
        .reads("--holdout", "FILE",
               "holdout matte (deep EXR, or RGBA and Z): hides light behind it and stays sharp", holdout)
        .value("--mask", "FILE[:CHANNEL]",
               "matte that limits the blur: 1 blurred, 0 unchanged, mixed in between; without a channel: "
               "alpha, or "
               "luminance if alpha is 1 everywhere",
               parse_text, mask);
}

void InputFlags::add_layers_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value("--layers", "LIST",
               "blur more layers in the same run, so that layers that sum to the colour still do: all, or "
               "names of layers, parts and channels separated by commas; all,-NAME leaves one out; NAME:LAMP "
               "gives its light a lamp's spectrum, such as signs:neon",
               parse_words, read.layers);
}

std::size_t process_memory_bytes(int threads) {
    static const MemoryLimit limit = memory_limit(threads);
    if (limit.bytes > 0)
        say_in_place_of("--max-memory", limit.name,
                        [](const std::string& message) { return limit.enough(message); });
    return limit.bytes;
}

void InputFlags::check() const {
    for (const std::string& file : files_of(*this)) run_files().reads(file);
    refuse(petzval::check(source()));
}

ShotSource InputFlags::source(const CameraFlags& user) const {
    auto source = static_cast<const ShotSource&>(*this);
    if (read.max_memory_bytes == 0) source.read.max_memory_bytes = process_memory_bytes(read.threads);
    source.read.transfer = transfer.value_or(Transfer::Srgb);
    source.depth.kind = depth_kind.value_or(DepthKind::Planar);
    source.depth_kind_given = depth_kind.has_value();
    source.depth.unit_scale_m = unit_scale_m.value_or(1);
    if (depth_range) source.depth.range_near = depth_range->low, source.depth.range_far = depth_range->high;
    source.camera = user.choice();
    return source;
}

}  // namespace petzval::cli
