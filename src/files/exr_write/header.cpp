#include "files/exr_write/header.h"

#include "files/exr/file.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVecAttribute.h>

namespace petzval {
namespace {

Imf::ChannelList channel_list(const std::vector<Channel>& channels) {
    Imf::ChannelList list;
    for (const Channel& c : channels)
        list.insert(c.name, Imf::Channel(c.type == ChannelType::Half    ? Imf::HALF
                                         : c.type == ChannelType::Float ? Imf::FLOAT
                                                                        : Imf::UINT,
                                         c.x_sampling, c.y_sampling));
    return list;
}

std::optional<Imf::Compression> compression_of(const std::string& name) {
    for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c)
        if (compression_name(c) == lower(name)) return Imf::Compression(c);
    return std::nullopt;
}

// A copy without some attributes. Header::erase() of OpenEXR 3.1 leaks the removed attribute.
Imf::Header without(const Imf::Header& input, const std::vector<std::string>& names) {
    Imf::Header header;
    for (auto a = input.begin(); a != input.end(); ++a)
        if (std::find(names.begin(), names.end(), a.name()) == names.end())
            header.insert(a.name(), a.attribute());
    return header;
}

// Replaces an attribute whatever its type was; inserting another type would throw.
void put(Imf::Header& header, const std::string& name, const Imf::Attribute& attribute) {
    const auto old = header.find(name);
    if (old != header.end() && std::string_view(old.attribute().typeName()) != attribute.typeName())
        header = without(header, {name});
    header.insert(name, attribute);
}

// `flat`: what only deep parts have is left out.
Imf::Header copied_header(const Imf::Header& input, const Frame& frame, bool flat) {
    std::vector<std::string> unwanted{"chunkCount"};  // OpenEXR counts anew
    if (flat) unwanted.insert(unwanted.end(), {"version", "maxSamplesPerPixel"});
    Imf::Header header = without(input, unwanted);
    header.displayWindow() = box_of(frame.place.display_window);
    if (!header.hasType()) header.setType(header.hasTileDescription() ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    return header;
}

}  // namespace

bool loses_again(const std::string& compression, const Channel& channel) {
    if (compression == "b44" || compression == "b44a") return channel.type == ChannelType::Half;
    if (compression != "dwaa" && compression != "dwab") return false;
    const std::string base = lower(channel.base);
    constexpr std::array lossy{"r", "g", "b", "y", "ry", "by", "red", "green", "blue"};
    return std::find(lossy.begin(), lossy.end(), base) != lossy.end();
}

Imath::Box2i box_of(const Rect& r) { return {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}; }

Imf::Header new_header(const Place& place, const std::vector<Channel>& channels) {
    Imf::Header header(box_of(place.display_window), box_of(place.data_window), float(place.pixel_aspect),
                       Imath::V2f(0, 0), 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
    header.setType(Imf::SCANLINEIMAGE);
    header.channels() = channel_list(channels);
    return header;
}

Imf::Header kept_header(const Imf::Header& input, const Frame& frame) {
    return copied_header(input, frame, false);
}

Imf::Header colour_header(const Imf::Header& input, const Frame& frame, const std::vector<Channel>& channels,
                          std::size_t colours) {
    const bool deep = input.hasType() && Imf::isDeepData(input.type());
    Imf::Header header = copied_header(input, frame, deep);
    header.dataWindow() = box_of(frame.place.data_window);
    header.channels() = channel_list(channels);
    header.lineOrder() = Imf::INCREASING_Y;
    const bool tiled = Imf::isTiled(header.type());
    if (deep) header.setType(tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (tiled) {
        Imf::TileDescription tiles = header.tileDescription();
        tiles.mode = Imf::ONE_LEVEL;
        header.setTileDescription(tiles);
    }
    for (std::size_t i = colours; i < channels.size(); ++i)
        if (loses_again(compression_name(header.compression()), channels[i]))
            header.compression() = Imf::ZIP_COMPRESSION;
    return header;
}

Status apply(const WriteOptions& options, const Rect& display_window, Imf::Header& header) {
    if (!options.compression.empty()) {
        const auto compression = compression_of(options.compression);
        if (!compression)
            return Error{ErrorCode::InvalidArgument,
                         "unknown EXR compression '" + printable(options.compression) +
                             "'; none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab"};
        header.compression() = *compression;
    }
    for (const auto& [name, text] : options.attributes) put(header, name, Imf::StringAttribute(text));
    const FoundCamera& camera = options.camera;
    const auto put_float = [&](const char* name, const std::optional<FoundNumber>& n) {
        if (n && !n->scene_units) put(header, name, Imf::FloatAttribute(float(n->value)));
    };
    put_float("pinholeFocalLength", camera.focal_length_mm);
    put_float("aperture", camera.f_number);
    put_float("focus", camera.focus_distance_m);
    if (camera.sensor_width_mm) {
        const double width = camera.sensor_width_mm->value;
        const double height =
            width * display_window.height() / display_window.width() / header.pixelAspectRatio();
        put(header, "sensorOverallDimensions", Imf::V2fAttribute(Imath::V2f(float(width), float(height))));
    }
    if (camera.camera_from_world) {
        Imath::M44f matrix;
        for (std::size_t i = 0; i < 16; ++i)
            matrix[int(i / 4)][int(i % 4)] = float((*camera.camera_from_world)[i]);
        put(header, "worldToCamera", Imf::M44fAttribute(matrix));
    }
    return Done{};
}

}  // namespace petzval
