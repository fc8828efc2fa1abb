#include "files/exr/pixels.h"

#include "base/parallel.h"
#include "files/exr/chunks.h"
#include "files/wording.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include <Imath/ImathMatrix.h>
#include <Imath/half.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace petzval {
namespace {

// Luminance and chroma of half resolution: OpenEXR's own reconstruction, in half precision.
Status read_luminance_chroma(const ExrFile& exr, const ColourChoice& choice, Picture& colour) {
    if (choice.part != 0)
        return Error{ErrorCode::Unsupported,
                     printable(exr.file->path(), 4096) +
                         ": luminance and chroma (Y RY BY) can be read from the first part "
                         "only; convert it to RGB"};
    return guarded(*exr.file, [&]() -> Status {
        if (Status s = FlatChunks(exr, 0).check(); !s) return s;
        ExrInputStream stream(exr.file, *exr.workers);
        const std::string& y = choice.luminance;
        const std::string layer = y.size() > 2 ? y.substr(0, y.size() - 2) : "";
        Imf::RgbaInputFile file(stream, layer);
        const Rect window = exr.layout.parts[0].data_window;
        Imf::Array2D<Imf::Rgba> pixels(window.height(), window.width());
        file.setFrameBuffer(&pixels[0][0] - window.x0 - std::ptrdiff_t(window.y0) * window.width(), 1,
                            std::size_t(window.width()));
        file.readPixels(window.y0, window.y1 - 1);
        for (int py = 0; py < window.height(); ++py)
            for (int px = 0; px < window.width(); ++px) {
                const Imf::Rgba& p = pixels[py][px];
                colour(px, py) = {float(p.r), float(p.g), float(p.b), float(p.a)};
            }
        return Done{};
    });
}

// World positions through the camera matrix; its +Z is the viewing direction. The origin itself is what
// renderers leave where nothing was hit.
Plane depth_of_positions(const std::array<Plane, 3>& position, const Imath::M44f& camera_from_world) {
    Plane depth = Plane::uninitialised(position[0].width(), position[0].height());
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            const Imath::V3f p(position[0](x, y), position[1](x, y), position[2](x, y));
            depth(x, y) =
                p == Imath::V3f(0) ? std::numeric_limits<float>::infinity() : (p * camera_from_world).z;
        }
    return depth;
}

template <typename Sample>
void copy_samples(const unsigned char* from, int count, float* to, std::ptrdiff_t step) {
    for (int x = 0; x < count; ++x, from += sizeof(Sample), to += step) {
        Sample sample;
        std::memcpy(&sample, from, sizeof sample);
        *to = float(sample);
    }
}

Status unpacked_floats(const Part& part, FlatChunks& chunks, const std::vector<FloatTarget>& targets) {
    std::vector<std::string> names;
    std::vector<ChannelType> types;
    for (const FloatTarget& t : targets)
        names.push_back(t.channel), types.push_back(part.find(t.channel)->type);
    const Rect window = part.data_window;
    return chunks.for_pixels(names, window.y0, window.y1, [&](std::size_t n, const FlatChunks::Row& row) {
        const FloatTarget& t = targets[n];
        float* const to = t.first + (row.y - window.y0) * t.row_step + (row.x - window.x0) * t.pixel_step;
        if (types[n] == ChannelType::Half)
            copy_samples<Imath::half>(row.samples, row.width, to, t.pixel_step);
        else if (types[n] == ChannelType::Float)
            copy_samples<float>(row.samples, row.width, to, t.pixel_step);
        else
            copy_samples<std::uint32_t>(row.samples, row.width, to, t.pixel_step);
    });
}

}  // namespace

Status read_floats(const ExrFile& exr, std::size_t part, const std::vector<FloatTarget>& targets) {
    if (Status s = exr.check_complete(part); !s) return s;
    return guarded(*exr.file, [&]() -> Status {
        const Rect window = exr.layout.parts[part].data_window;
        {
            FlatChunks chunks(exr, part);
            if (chunks.can_be_unpacked()) return unpacked_floats(exr.layout.parts[part], chunks, targets);
            if (Status s = chunks.check(); !s) return s;
        }
        Imf::InputPart input(*exr.parts, int(part));
        Imf::FrameBuffer buffer;
        for (const FloatTarget& t : targets) {
            // OpenEXR addresses pixels by their place in the frame, so the base lies outside of the plane.
            const auto origin =
                reinterpret_cast<std::intptr_t>(t.first) -
                std::intptr_t(sizeof(float)) * (window.x0 * t.pixel_step + window.y0 * t.row_step);
            buffer.insert(t.channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin),
                                                sizeof(float) * std::size_t(t.pixel_step),
                                                sizeof(float) * std::size_t(t.row_step)));
        }
        input.setFrameBuffer(buffer);
        input.readPixels(window.y0, window.y1 - 1);
        return Done{};
    });
}

Status read_colour(const ExrFile& exr, const ColourChoice& choice, Picture& colour, Plane* depth,
                   const std::string& depth_channel) {
    const Rect window = exr.layout.parts[choice.part].data_window;
    const bool has_light = choice.is_luminance() || !choice.red.empty();
    colour = has_light ? Picture::uninitialised(window.width(), window.height())
                       : Picture(window.width(), window.height());
    const std::ptrdiff_t row = 4 * std::ptrdiff_t(window.width());
    std::vector<FloatTarget> targets;
    const auto take = [&](const std::string& channel, float& first) {
        if (!channel.empty()) targets.push_back({channel, &first, 4, row});
    };
    const bool chroma = !choice.chroma_r.empty() && !choice.chroma_b.empty();
    if (!chroma) {
        Rgba& first = *colour.pixels();
        take(choice.is_luminance() ? choice.luminance : choice.red, first.r);
        take(choice.green, first.g);
        take(choice.blue, first.b);
        take(choice.alpha, first.a);
    } else if (Status s = read_luminance_chroma(exr, choice, colour); !s) {
        return s;
    }
    if (depth) {
        *depth = Plane::uninitialised(window.width(), window.height());
        targets.push_back({depth_channel, depth->pixels(), 1, window.width()});
    }
    if (!targets.empty())
        if (Status s = read_floats(exr, choice.part, targets); !s) return s;
    if (chroma) return Done{};
    parallel_for(colour.height(), *exr.workers, [&](int y) {
        Rgba* p = colour.row(y);
        for (int x = 0; x < colour.width(); ++x) {
            if (choice.is_luminance()) p[x].g = p[x].b = p[x].r;
            if (choice.alpha.empty()) p[x].a = 1;
        }
    });
    return Done{};
}

Result<Plane> read_depth(const ExrFile& exr, const DepthChoice& choice) {
    const Rect window = exr.layout.parts[choice.part].data_window;
    const auto target = [&](const std::string& channel, Plane& plane) {
        plane = Plane::uninitialised(window.width(), window.height());
        return FloatTarget{channel, plane.pixels(), 1, window.width()};
    };
    if (choice.is_position()) {
        std::array<Plane, 3> position;
        std::vector<FloatTarget> targets;
        for (std::size_t i = 0; i < 3; ++i) targets.push_back(target(choice.position[i], position[i]));
        if (Status s = read_floats(exr, choice.part, targets); !s) return s.error();
        for (int p = 0; p < exr.parts->parts(); ++p)
            if (Imf::hasWorldToCamera(exr.parts->header(p)))
                return depth_of_positions(position, Imf::worldToCamera(exr.parts->header(p)));
        return invalid_file(exr.file->path(), "has positions but no worldToCamera to make depth of them");
    }
    Plane depth;
    if (Status s = read_floats(exr, choice.part, {target(choice.channel, depth)}); !s) return s.error();
    return depth;
}

bool has_camera_matrix(const ExrFile& exr) {
    bool found = false;
    for (int p = 0; p < exr.parts->parts(); ++p) found |= Imf::hasWorldToCamera(exr.parts->header(p));
    return found;
}

Plane pasted(const Plane& plane, const Rect& from, const Rect& to) {
    Plane out(to.width(), to.height(), std::numeric_limits<float>::infinity());
    const Rect both = from.intersected(to);
    for (int y = both.y0; y < both.y1; ++y)
        std::copy_n(plane.row(y - from.y0) + (both.x0 - from.x0), std::max(both.width(), 0),
                    out.row(y - to.y0) + (both.x0 - to.x0));
    return out;
}

void note_missing_depth(const Rect& window, const Rect& picture, std::vector<std::string>& detected) {
    if (window.intersected(picture) == picture) return;
    detected.push_back("depth: covers " + std::to_string(window.width()) + " x " +
                       std::to_string(window.height()) + " pixels at " + std::to_string(window.x0) + "," +
                       std::to_string(window.y0) + "; the rest of the picture is infinitely far");
}

}  // namespace petzval
