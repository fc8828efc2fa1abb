#include "input.h"

#include "console.h"
#include "fields.h"
#include "guard.h"
#include "interrupt.h"

#include <utility>

namespace petzval::cli {

void InputFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .argument("IN",
                  "a picture: EXR, PNG, JPEG or TIFF (whole numbers are decoded through the sRGB curve); - "
                  "is standard input",
                  path)
        .value("--layer", "NAME", "colour layer or part", parse_text, read.layer)
        .value("--view-name", "NAME", "view of a stereo file, as left; all (defocus): every view", parse_text,
               read.view_name);
}

void InputFlags::add_depth_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .reads("--depth", "FILE", "read depth from another file, EXR, PNG or TIFF, of any size",
               read.depth_file)
        .value("--depth-channel", "NAME", "depth channel, as Z or ViewLayer.Depth.Z", parse_text,
               read.depth_channel)
        .choice<DepthKind>("--depth-kind",
                           "what depth means: planar, along the axis (default, but for whole numbers as of a "
                           "PNG); ray, from the "
                           "pinhole; inverse, 1/planar, and with --depth-range disparity from 0, far, to 1, "
                           "near; normalized, "
                           "device and mist, 0…1, z-buffer and Blender's mist between --depth-range; coc-px, "
                           "signed blur radius "
                           "in pixels",
                           depth_kind)
        .value("--depth-range", "NEAR,FAR",
               "the ends of normalized, device, inverse or mist depth in units of the scene, as 0.1,100; of "
               "coc-px the radii of 0 and 1, as -20,35",
               parse_range, depth_range)
        .value("--unit-scale", "METRES", "metres per unit of depth, as 0.01 or 1cm for centimetres",
               parse_length_m, unit_scale_m);
}

void InputFlags::add_transfer_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .choice<Transfer>("--transfer",
                          "how codes of PNG, JPEG and TIFF stand for light, read and written (default srgb)",
                          transfer);
}

void InputFlags::add_others_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .reads("--behind", "FILE", "what the picture hides: deep EXR, or RGBA and Z", behind)
        .values("--merge", "FILE…", "more pictures of the shot, deep EXR or RGBA and Z, sorted in by depth",
                merge)
        .reads("--holdout", "FILE",
               "a matte, deep EXR or RGBA and Z, that hides what is behind it and stays sharp", holdout)
        .value("--mask", "FILE[:CHANNEL]",
               "where the effect is wanted: 1 as blurred, 0 as given, mixed between; without a channel "
               "alpha, or "
               "luminance where alpha is 1 everywhere",
               parse_text, mask);
}

void InputFlags::add_layers_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .value("--layers", "LIST",
               "blur more layers of the file with the colour, so that what sums to it still does: all, or "
               "names of "
               "layers, parts and channels with commas between; all,-NAME leaves one out; NAME:LAMP says "
               "what its "
               "light is made of, as signs:neon, in the picture too",
               parse_words, read.layers);
}

void InputFlags::add_to(MadeWith& made) const {
    for (const auto& [field, text] : {std::pair("read.layer", &read.layer),
                                      {"read.view_name", &read.view_name},
                                      {"read.depth_channel", &read.depth_channel}})
        if (!text->empty()) made.add(field, *text);
    if (!read.layers.empty()) made.add("read.layers", listed(read.layers));
    if (transfer) made.add("read.transfer", name_of(*transfer));
    if (depth_kind) made.add("depth.kind", name_of(*depth_kind));
    if (depth_range) made.add("depth.range", plain(depth_range->low, 9) + "," + plain(depth_range->high, 9));
    made.add("depth.unit_scale_m", unit_scale_m);
}

void InputFlags::check() const {
    for (const std::string& file : files()) run_files().reads(file);
    if (const Status fine = petzval::check(source()); !fine) throw UsageError(in_flags(fine.error().message));
}

std::vector<std::string> InputFlags::files() const {
    std::vector<std::string> all{path};
    for (const std::string* other : {&read.depth_file, &behind, &holdout, &lights})
        if (!other->empty()) all.push_back(*other);
    all.insert(all.end(), merge.begin(), merge.end());
    if (!mask.empty()) all.push_back(file_channel(mask).file);
    return all;
}

ShotSource InputFlags::source(const CameraFlags& user) const {
    auto source = static_cast<const ShotSource&>(*this);
    source.read.transfer = transfer.value_or(Transfer::Srgb);
    source.depth.kind = depth_kind.value_or(DepthKind::Planar);
    source.depth_kind_given = depth_kind.has_value();
    source.depth.unit_scale_m = unit_scale_m.value_or(1);
    if (depth_range) source.depth.range_near = depth_range->low, source.depth.range_far = depth_range->high;
    source.camera = user.choice();
    return source;
}

Result<Shot> load_shot(const ShotSource& source) {
    return read_shot(source, {.cancelled = [] { return interrupted_by() != 0; }});
}

std::vector<std::string> detected_in_picture(const Shot& shot) {
    const FoundCamera& c = shot.camera_of_file;
    std::vector<std::string> lines = shot.detected;
    for (const auto& number :
         {c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.horizontal_fov_deg})
        if (number)
            std::erase_if(lines,
                          [&](const std::string& l) { return l.ends_with(" from " + number->origin); });
    return lines;
}

}  // namespace petzval::cli
