#include "files/exr/read.h"

#include "base/parallel.h"
#include "files/carried.h"
#include "files/exr/deep.h"
#include "files/exr/layers.h"
#include "files/exr/motion.h"
#include "files/exr/pixels.h"
#include "files/exr/prescan.h"
#include "files/exr_write/header.h"
#include "files/memory_limit.h"
#include "files/wording.h"

#include <algorithm>

#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>

namespace petzval {
namespace {

std::vector<PartSummary> summaries_of(const Layout& layout) {
    std::vector<PartSummary> summaries;
    for (const Part& part : layout.parts) {
        PartSummary s{part.name, part.type, part.view, part.compression, part.data_window, {}};
        for (const Channel& c : part.channels)
            s.channels.push_back(c.name + (c.type == ChannelType::Half    ? " half"
                                           : c.type == ChannelType::Float ? " float"
                                                                          : " uint"));
        summaries.push_back(std::move(s));
    }
    return summaries;
}

std::optional<std::array<double, 16>> camera_matrix_of(const ExrFile& exr, std::size_t colour_part) {
    std::optional<std::array<double, 16>> rows;
    for (int p = 0; p < exr.parts->parts(); ++p) {
        const Imf::Header& header = exr.parts->header(p);
        if (!Imf::hasWorldToCamera(header) || (rows && std::size_t(p) != colour_part)) continue;
        const Imath::M44f& matrix = Imf::worldToCamera(header);
        rows.emplace();
        for (std::size_t i = 0; i < 16; ++i) (*rows)[i] = double(matrix[int(i / 4)][int(i % 4)]);
    }
    return rows;
}

// The colour's part speaks first: in a multi-part file every part may hold its own metadata.
FoundCamera camera_of(const ExrFile& exr, std::size_t colour_part) {
    std::vector<NumericAttribute> attributes = numeric_attributes(exr.parts->header(int(colour_part)));
    for (int p = 0; p < exr.parts->parts(); ++p) {
        if (std::size_t(p) == colour_part) continue;
        for (NumericAttribute& a : numeric_attributes(exr.parts->header(p)))
            attributes.push_back(std::move(a));
    }
    FoundCamera camera = camera_from_metadata(attributes);
    camera.camera_from_world = camera_matrix_of(exr, colour_part);
    return camera;
}

void describe_camera(const FoundCamera& camera, std::vector<std::string>& detected) {
    const auto say = [&](const char* what, const std::optional<FoundNumber>& n, const char* unit) {
        if (n) detected.push_back(std::string(what) + ": " + number(n->value) + unit + " from " + n->origin);
    };
    say("focal length", camera.focal_length_mm, " mm");
    say("sensor width", camera.sensor_width_mm, " mm");
    say("f-number", camera.f_number, "");
    const auto& focus = camera.focus_distance_m;
    say("focus distance", focus, focus && focus->scene_units ? " units" : " m");
    if (!camera.focal_length_mm || !camera.sensor_width_mm)
        say("field of view", camera.horizontal_fov_deg, " deg");
}

void describe_view(const Layout& layout, const ColourChoice& colour, const ReadOptions& options,
                   std::vector<std::string>& detected) {
    if (layout.views.empty()) return;
    std::string line = "view: " + (colour.view.empty() ? "none" : printable(colour.view));
    if (layout.views.size() == 1) return detected.push_back(line + ", the only one");
    line += options.view_name.empty() ? ", the first that fits" : ", asked for with read.view_name";
    detected.push_back(line + "; the file has " + listed(layout.views));
}

std::optional<PrimariesConversion> primaries_of(const ExrFile& exr, std::size_t part, Frame& frame) {
    const Imf::Header& header = exr.parts->header(int(part));
    if (!Imf::hasChromaticities(header) && !Imf::hasAdoptedNeutral(header)) return std::nullopt;
    const Imf::Chromaticities c =  // without the attribute: Rec.709
        Imf::hasChromaticities(header) ? Imf::chromaticities(header) : Imf::Chromaticities();
    std::optional<Chromaticity> neutral;
    if (Imf::hasAdoptedNeutral(header))
        neutral = {Imf::adoptedNeutral(header).x, Imf::adoptedNeutral(header).y};
    const Chromaticities xy{c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
    auto conversion = conversion_of(xy, neutral);
    if (conversion) {
        std::vector<std::string> xy_text;
        for (std::size_t k = 0; k < xy.size(); k += 2)
            xy_text.push_back(number(xy[k]) + "," + number(xy[k + 1]));
        frame.detected.push_back("primaries: from those of the file (" + joined(xy_text, " ") +
                                 ") to Rec.709; written back in those of the file");
        if (const auto& from = conversion->adapted_from)
            frame.detected.push_back("white: colours are adapted from " + number((*from)[0]) + "," +
                                     number((*from)[1]) + (neutral ? " (adoptedNeutral)" : "") +
                                     " to that of Rec.709 (Bradford), and back when written");
    } else if (!is_rec709(xy)) {
        frame.warnings.emplace_back("its chromaticities do not describe a colour space; Rec.709 is assumed");
    }
    return conversion;
}

void convert(Picture& colour, const Matrix3& matrix, Workers& workers) {
    parallel_for(colour.height(), workers, [&](int y) {
        Rgba* p = colour.row(y);
        for (int x = 0; x < colour.width(); ++x) p[x] = transformed(matrix, p[x]);
    });
}

// Single channels have no primaries.
void convert(Frame& frame, const std::vector<LayerChoice>& layers, const Matrix3& matrix, Workers& workers) {
    convert(frame.colour, matrix, workers);
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (layers[i].is_colour) convert(frame.layers[i].colour, matrix, workers);
}

struct Choices {
    ColourChoice colour;
    std::optional<DepthChoice> depth;
    std::vector<LayerChoice> layers;
};

// Finds depth in the same file if it is wanted; a header alone may have none.
Status choose_depth_of(const ExrFile& exr, const ReadOptions& options, bool pixels, Choices& choices,
                       Frame& frame) {
    if (!options.depth_file.empty()) return Done{};
    const auto found =
        choose_depth(exr.file->path(), exr.layout, &choices.colour, options, has_camera_matrix(exr));
    const bool asked = !options.depth_channel.empty();
    if (!found && (asked || (options.need_depth && pixels))) return found.error();
    if (!found) {
        frame.detected.emplace_back("depth: none");
        return Done{};
    }
    choices.depth = *found;
    frame.detected.push_back(found->line);
    return Done{};
}

// Deep samples bring their own depth, and their part is written back flat.
Status check_deep(const ExrFile& exr, const Choices& choices, const ReadOptions& options, Frame& frame) {
    const std::string& path = exr.file->path();
    if (!options.depth_file.empty())
        return Error{
            ErrorCode::InvalidArgument,
            printable(path, 4096) + ": is deep, its samples have their own depth; leave out read.depth_file"};
    if (!choices.depth || choices.depth->part != choices.colour.part)
        return invalid_file(path, "is deep but its samples have no Z");
    std::vector<std::string> dropped;
    const ColourChoice& c = choices.colour;
    for (const Channel& channel : exr.layout.parts[c.part].channels)
        if (channel.layer != c.layer || channel.view != c.view) dropped.push_back(channel.name);
    if (!dropped.empty())
        frame.warnings.push_back("deep channels cannot be kept in a flat output: " + listed(dropped));
    frame.detected.emplace_back("depth: read from the deep samples; a flat output holds none");
    return Done{};
}

Status read_deep_pixels(const ExrFile& exr, const Choices& choices, const ReadOptions& options,
                        Frame& frame) {
    Result<DeepPicture> deep =
        read_deep(exr, choices.colour, *choices.depth, options, frame.non_finite_colour);
    if (!deep) return deep.error();
    frame.deep = std::move(*deep);
    frame.detected.push_back("deep: " + std::to_string(frame.deep.sample_count()) + " samples");
    return Done{};
}

// Compression that would eat a little of the carried channels each time a file passes through.
void warn_of_lossy_compression(const Part& part, const ColourChoice& colour, Frame& frame) {
    std::vector<std::string> losing;
    for (const Channel& c : part.channels) {
        const auto names = {colour.red,       colour.green,    colour.blue,    colour.alpha,
                            colour.luminance, colour.chroma_r, colour.chroma_b};
        const bool is_colour = std::find(names.begin(), names.end(), c.name) != names.end();
        if (!is_colour && loses_again(part.compression, c)) losing.push_back(c.name);
    }
    if (!losing.empty() && !part.deep)
        frame.warnings.push_back("its compression " + part.compression + " would change " + listed(losing) +
                                 " again; written as zip");
}

void warn_of_lost_parts(const Layout& layout, Frame& frame) {
    for (const Part& part : layout.parts) {
        if (!part.readable)
            frame.warnings.push_back(part.title + " is of an unknown type and will not be kept");
        if (!part.complete) frame.warnings.push_back(part.title + " is incomplete and will not be kept");
    }
}

Status read_pixels(const ExrFile& exr, const Choices& choices, const ReadOptions& options, Frame& frame) {
    if (Status s = fits_memory(*exr.file, frame.place.data_window, sizeof(Rgba) + sizeof(float), options); !s)
        return s;
    const bool together =
        choices.depth && choices.depth->part == choices.colour.part && !choices.depth->is_position();
    const std::string channel = together ? choices.depth->channel : "";
    if (Status s = read_colour(exr, choices.colour, frame.colour, together ? &frame.depth : nullptr, channel);
        !s)
        return s;
    if (choices.depth && !together) {
        Result<Plane> depth = read_depth(exr, *choices.depth);
        if (!depth) return depth.error();
        const Rect window = exr.layout.parts[choices.depth->part].data_window;
        note_missing_depth(window, frame.place.data_window, frame.detected);
        frame.depth = window == frame.place.data_window ? std::move(*depth)
                                                        : pasted(*depth, window, frame.place.data_window);
    }
    if (!options.depth_file.empty())
        if (Status s = take_depth_file(options, frame); !s) return s;
    return read_motion(exr, choices.colour, options, frame);
}

// Reports the origin of the picture and earlier processing.
void tell_past(const ExrFile& exr, const ColourChoice& colour, Frame& frame) {
    frame.views = exr.layout.views;
    frame.view = colour.view;
    frame.colour_name = colour.is_luminance() ? colour.luminance : colour.red;
    const Imf::Header& header = exr.parts->header(int(colour.part));
    if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>("petzval:history"))
        frame.history = text->value();
}

// Warns about properties that no camera picture has.
void warn_of_what_is_not_said(const Imf::Header& header, Frame& frame) {
    if (header.hasTileDescription() && header.tileDescription().mode != Imf::ONE_LEVEL)
        frame.warnings.emplace_back("it has mip levels: the first is read, the others are not kept");
    if (Imf::hasEnvmap(header))
        frame.warnings.emplace_back("it is an environment map, but is read as the picture of a camera");
}

std::size_t replace_non_finite(Picture& colour, Workers& workers) {
    std::vector<std::size_t> of_row(std::size_t(colour.height()));
    parallel_for(colour.height(), workers, [&](int y) {
        Rgba* p = colour.row(y);
        for (int x = 0; x < colour.width(); ++x)
            for (float* v : {&p[x].r, &p[x].g, &p[x].b, &p[x].a}) of_row[std::size_t(y)] += made_finite(*v);
    });
    std::size_t sum = 0;
    for (std::size_t n : of_row) sum += n;
    return sum;
}

// Game engines and painting programs leave an alpha of 0 behind pictures that are opaque. As coverage it
// would make all of the picture glow that hides nothing. It stays in the file.
void take_empty_alpha_as_none(ColourChoice& colour, Frame& frame) {
    constexpr float kNothing = 1.0f / 512;  // half a code of 8 bits: noise of compression
    bool has_light = false;
    for (std::size_t i = 0; i < frame.colour.size(); ++i) {
        const Rgba c = frame.colour.pixels()[i];
        if (c.a > 0) return;
        has_light = has_light || std::max({c.r, c.g, c.b}) > kNothing;
    }
    if (!has_light || !frame.has_alpha) return;
    for (std::size_t i = 0; i < frame.colour.size(); ++i) frame.colour.pixels()[i].a = 1;
    frame.has_alpha = false;
    frame.warnings.push_back("its alpha " + printable(colour.alpha) +
                             " is 0 in every pixel, but there is light: the picture is taken as opaque, and "
                             "the channel is kept as it is");
    colour.alpha.clear();
}

}  // namespace

Result<Frame> read_exr_frame(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                             bool pixels) {
    Result<ExrFile> opened = ExrFile::open(file, options.max_pixels, *options.workers);
    if (!opened) return opened.error();
    const ExrFile& exr = *opened;
    Frame frame;
    frame.place.display_window = exr.layout.display_window;
    frame.place.pixel_aspect = exr.layout.pixel_aspect;
    frame.parts = summaries_of(exr.layout);

    Result<ColourChoice> colour = choose_colour(file->path(), exr.layout, options);
    if (!colour && !pixels && colour.error().code == ErrorCode::InvalidFile) {
        // A header of depth or circles of confusion alone is worth showing.
        frame.detected.emplace_back("colour: none");
        frame.place.data_window = exr.layout.parts[0].data_window;
        frame.camera = camera_of(exr, 0);
        describe_camera(frame.camera, frame.detected);
        return frame;
    }
    if (!colour) return colour.error();
    Choices choices{*colour, std::nullopt, {}};
    const Part& part = exr.layout.parts[colour->part];
    frame.place.data_window = part.data_window;
    frame.has_alpha = !colour->alpha.empty();
    frame.detected.push_back(colour->line);
    warn_of_lossy_compression(part, *colour, frame);
    warn_of_lost_parts(exr.layout, frame);
    describe_view(exr.layout, *colour, options, frame.detected);
    if (Status s = choose_depth_of(exr, options, pixels, choices, frame); !s) return s.error();
    warn_of_what_is_not_said(exr.parts->header(int(colour->part)), frame);
    if (part.deep)
        if (Status s = check_deep(exr, choices, options, frame); !s) return s.error();
    Result<LayersChoice> layers = choose_layers(file->path(), exr.layout, *colour, choices.depth, options);
    if (!layers) return layers.error();
    describe_layers(*layers, frame);
    choices.layers = std::move(layers->layers);
    frame.camera = camera_of(exr, colour->part);
    describe_camera(frame.camera, frame.detected);
    tell_past(exr, *colour, frame);
    const auto primaries = primaries_of(exr, colour->part, frame);
    if (!pixels) return frame;

    if (part.deep) {
        if (Status s = read_deep_pixels(exr, choices, options, frame); !s) return s.error();
        if (primaries)
            for (DeepSample& s : frame.deep.samples()) s.colour = transformed(primaries->to_rec709, s.colour);
        flatten(frame.deep, frame.colour, frame.depth, 0, options.workers);
    } else {
        if (Status s = read_pixels(exr, choices, options, frame); !s) return s.error();
        frame.non_finite_colour = replace_non_finite(frame.colour, *options.workers);
        take_empty_alpha_as_none(*colour, frame);
        if (Status s = read_layers(exr, choices.layers, frame); !s) return s.error();
        if (primaries) convert(frame, choices.layers, primaries->to_rec709, *options.workers);
    }
    const bool own_depth = choices.depth && choices.depth->part == colour->part;
    frame.carried = std::make_shared<CarriedContent>(
        CarriedContent{file, exr.layout, *colour, std::move(choices.layers),
                       own_depth ? choices.depth->channel : "", primaries, options.max_pixels});
    return frame;
}

}  // namespace petzval
