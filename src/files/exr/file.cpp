#include "files/exr/file.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "files/exr/prescan.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <system_error>

#include <Imath/ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfVecAttribute.h>

namespace petzval {
namespace {

Rect rect_of(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}; }

// Cryptomatte 1.2: attributes cryptomatte/<key>/name hold what its channels begin with.
std::vector<std::string> cryptomattes_of(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto a = header.begin(); a != header.end(); ++a) {
        const std::string name = a.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (text && !text->value().empty() && name.starts_with("cryptomatte/") && name.ends_with("/name"))
            names.push_back(text->value());
    }
    return names;
}

Part part_of(const Imf::Header& header, const std::vector<std::string>& declared_views) {
    Part part;
    if (header.hasName()) part.name = header.name();
    if (header.hasView()) part.view = header.view();
    part.label = without_view(part.name, part.view);
    part.type = header.hasType()              ? header.type()
                : header.hasTileDescription() ? Imf::TILEDIMAGE
                                              : Imf::SCANLINEIMAGE;
    part.deep = Imf::isDeepData(part.type);
    part.tiled = Imf::isTiled(part.type);
    part.readable = Imf::isSupportedType(part.type);
    part.compression = compression_name(header.compression());
    part.data_window = rect_of(header.dataWindow());
    part.cryptomattes = cryptomattes_of(header);
    const Imf::ChannelList& list = header.channels();
    for (auto c = list.begin(); c != list.end(); ++c) {
        Channel channel = split_channel_name(c.name(), declared_views);
        if (channel.view.empty()) channel.view = part.view;
        const Imf::PixelType type = c.channel().type;
        channel.type = type == Imf::UINT    ? ChannelType::Uint
                       : type == Imf::FLOAT ? ChannelType::Float
                                            : ChannelType::Half;
        channel.x_sampling = c.channel().xSampling, channel.y_sampling = c.channel().ySampling;
        part.channels.push_back(channel);
    }
    return part;
}

Layout layout_of(const Imf::MultiPartInputFile& file) {
    Layout layout;
    layout.display_window = rect_of(file.header(0).displayWindow());
    layout.pixel_aspect = file.header(0).pixelAspectRatio();
    const auto add_view = [&](const std::string& view) {
        for (const std::string& known : layout.views)
            if (known == view) return;
        if (!view.empty()) layout.views.push_back(view);
    };
    for (int p = 0; p < file.parts(); ++p) {
        const Imf::Header& header = file.header(p);
        std::vector<std::string> declared;
        if (Imf::hasMultiView(header)) declared = Imf::multiView(header);
        layout.parts.push_back(part_of(header, declared));
        layout.parts.back().complete = file.partComplete(p);
        add_view(layout.parts.back().view);
        for (const std::string& view : declared) add_view(view);
    }
    for (std::size_t p = 0; p < layout.parts.size() && layout.parts.size() > 1; ++p) {
        Part& part = layout.parts[p];
        part.title = "part " + std::to_string(p);
        if (!part.name.empty()) part.title += " '" + printable(part.name) + "'";
    }
    return layout;
}

std::vector<double> values_of(const Imf::Attribute& a) {
    if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&a)) return {double(f->value())};
    if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&a)) return {d->value()};
    if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&a)) return {double(i->value())};
    if (const auto* r = dynamic_cast<const Imf::RationalAttribute*>(&a)) return {double(r->value())};
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&a)) return numbers_in_text(s->value());
    if (const auto* v = dynamic_cast<const Imf::V2fAttribute*>(&a)) return {v->value().x, v->value().y};
    if (const auto* v = dynamic_cast<const Imf::V2dAttribute*>(&a)) return {v->value().x, v->value().y};
    if (const auto* v = dynamic_cast<const Imf::V2iAttribute*>(&a))
        return {double(v->value().x), double(v->value().y)};
    if (const auto* v = dynamic_cast<const Imf::V3fAttribute*>(&a))
        return {v->value().x, v->value().y, v->value().z};
    return {};
}

Status caught(const std::string& path, const std::function<Status()>& body) {
    try {
        return body();
    } catch (const Cancelled&) {
        throw;
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfMemory, printable(path, 4096) + ": does not fit into memory"};
    } catch (const std::system_error& e) {
        // OpenEXR starts threads, whose stacks may not fit; nothing is wrong with the file.
        return Error{ErrorCode::OutOfMemory,
                     printable(path, 4096) + ": no memory or threads left to read it: " + e.code().message()};
    } catch (const std::exception& e) {
        // OpenEXR repeats the path in quotes; once is enough.
        std::string what = printable(e.what(), 500);
        if (const std::size_t at = what.find("\"" + path + "\""); at != std::string::npos)
            what.replace(at, path.size() + 2, "it");
        // Our message, after OpenEXR's description of the step.
        if (const std::size_t at = what.rfind("it ends too early"); at != std::string::npos)
            what.erase(0, at);
        return unreadable(path, what);
    } catch (...) {
        return invalid_file(path, "is damaged or not readable");
    }
}

}  // namespace

std::vector<NumericAttribute> numeric_attributes(const Imf::Header& header) {
    std::vector<NumericAttribute> numbers;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (auto values = values_of(a.attribute()); !values.empty()) numbers.push_back({a.name(), values});
    return numbers;
}

std::string compression_name(int compression) {
    constexpr std::array names{"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
    return compression >= 0 && compression < int(names.size()) ? names[std::size_t(compression)] : "unknown";
}

Status guarded(const InputFile& file, const std::function<Status()>& body) {
    const Status done = caught(file.path(), body);
    if (done || done.error().code == ErrorCode::OutOfMemory) return done;
    const auto failure = file.failure();
    return failure ? *failure : done;
}

int exr_threads(const Workers& workers) {
    static std::mutex mutex;
    static int given = 0;
    if (workers.width() <= 1) return 0;
    const std::lock_guard lock(mutex);
    const int there = Imf::globalThreadCount();
    if (there == given && there < workers.width())
        Imf::setGlobalThreadCount(given = std::min(workers.width(), usable_threads()));
    return std::min(workers.width(), Imf::globalThreadCount());
}

Result<ExrFile> ExrFile::open(std::shared_ptr<const InputFile> file, std::size_t max_pixels,
                              Workers& workers) {
    const std::string path = file->path();
    ExrFile exr;
    exr.workers = &workers;
    exr.file = file;
    const Status opened = guarded(*file, [&]() -> Status {
        if (const auto reason = refuse_exr(*file, max_pixels, exr.headers_end))
            return invalid_file(path, *reason);
        exr.stream = std::make_unique<ExrInputStream>(file, workers);
        // A file whose table of chunks is unfinished is still being written or was cut off: no
        // reconstruction.
        exr.parts = std::make_unique<Imf::MultiPartInputFile>(*exr.stream, exr_threads(workers), false);
        exr.layout = layout_of(*exr.parts);
        return Done{};
    });
    if (!opened) return opened.error();
    return exr;
}

Status ExrFile::check_complete(std::size_t part) const {
    if (layout.parts[part].complete) return Done{};
    return invalid_file(file->path(), "is incomplete: it was cut off or is still being written");
}

}  // namespace petzval
