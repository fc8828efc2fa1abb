#include "petzval/shots/compare_files.h"

#include "petzval/display_files.h"
#include "petzval/frames.h"
#include "petzval/place.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/views.h"

#include "records/record_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

namespace petzval {
namespace {

using records::Json;
using records::number;

// The picture over the whole display window, empty where the file has no pixels.
Picture over_display_window(const Picture& colour, const Place& place) {
    return through_window(colour, place.data_window, place.display_window, Rgba{});
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

bool is_png(const std::string& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;  // a pipe could not be read again
    std::ifstream file(path, std::ios::binary);
    std::array<char, 4> start{};
    file.read(start.data(), start.size());
    return file && std::string_view(start.data(), start.size()) == "\x89PNG";
}

// A PNG's first channel as stored, or the luminance of an EXR.
Result<Plane> read_mask(const std::string& path) {
    if (is_png(path)) {
        const auto png = read_png(path);
        if (!png) return png.error();
        Plane mask(png->width, png->height);
        const float white = float((1 << png->bits) - 1);
        for (std::size_t i = 0; i < mask.size(); ++i)
            mask.pixels()[i] = float(png->samples[i * std::size_t(png->channels)]) / white;
        return mask;
    }
    ReadOptions options;
    options.need_depth = false;
    auto frame = read_frame(path, options);
    if (!frame) return frame.error();
    const Picture colour = over_display_window(frame->colour, frame->place);
    Plane mask(colour.width(), colour.height());
    for (std::size_t i = 0; i < mask.size(); ++i) mask.pixels()[i] = luminance(colour.pixels()[i]);
    return mask;
}

Status check_sizes(const CompareFiles& files, const Picture& reference, const Picture& test,
                   const Plane& mask) {
    const auto differs = [&](const std::string& path, int width, int height) -> Status {
        if (width == reference.width() && height == reference.height()) return Done{};
        return Error{ErrorCode::InvalidArgument, path + " has " + size_text(width, height) + " pixels, but " +
                                                     files.reference.path + " has " +
                                                     size_text(reference.width(), reference.height())};
    };
    if (Status same = differs(files.test, test.width(), test.height()); !same) return same;
    return mask.empty() ? Status(Done{}) : differs(files.mask, mask.width(), mask.height());
}

Json record_of(const Comparison& c, const CompareFiles& files) {
    Json record = Json::parse(empty_record("compare"));
    record["input"] = {files.reference.path, files.test};
    record["exposure"] = files.exposure;
    record["mask"] = files.mask.empty() ? Json(nullptr) : Json(files.mask);
    record["psnr_lin"] = number(c.psnr_lin);
    record["ssim_lin"] = number(c.ssim_lin);
    record["psnr_srgb"] = number(c.psnr_srgb);
    record["ssim_srgb"] = number(c.ssim_srgb);
    record["psnr_log"] = number(c.psnr_log);
    record["max_error"] = number(c.max_error);
    record["max_error_at"] = {c.max_error_x, c.max_error_y};
    record["energy_ratio"] = number(c.energy_ratio);
    return record;
}

Json record_of(const std::vector<WorstPlace>& worst) {
    Json places = Json::array();
    for (const WorstPlace& place : worst)
        places.push_back({{"area", {place.area.x0, place.area.y0, place.area.x1, place.area.y1}},
                          {"rms_codes", 255 * place.rms}});
    return places;
}

Status write_heat_map(const CompareFiles& files, const Difference& difference) {
    if (files.heat_map.empty()) return Done{};
    std::vector<Rect> areas;
    for (const WorstPlace& place : difference.worst) areas.push_back(place.area);
    const Picture map = heat_map(difference.error.view(), areas);
    return write_developed(files.heat_map, map.view(), {.tone = ToneCurve::None, .dither = false},
                           files.overwrite);
}

// The pictures over their display windows; an empty mask counts everywhere.
struct Pictures {
    Picture reference, test;
    Plane mask;
    std::size_t non_finite = 0;
    bool have_alpha = false;  // both files do
};

// Numbers of a comparison are about colour; a matte that is wrong would go unnoticed. Empty if alpha agrees.
std::string note_of_alpha(const Pictures& p) {
    constexpr float kSame = 1.0f / 512;
    float most = 0;
    if (p.have_alpha)
        for (std::size_t i = 0; i < p.reference.size(); ++i)
            most = std::max(most, std::abs(p.reference.pixels()[i].a - p.test.pixels()[i].a));
    if (most <= kSame) return "";
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(),
                  "alpha differs by up to %.3g; the numbers compare red, green and blue", double(most));
    return text.data();
}

CompareFiles of_frame(CompareFiles files, int frame) {
    for (std::string* path : {&files.reference.path, &files.test, &files.mask, &files.heat_map})
        *path = at_frame(*path, frame);
    return files;
}

void say(const FrameLoopHost& host, Say how, const std::string& line) {
    if (host.say) host.say(how, line);
}

Result<Pictures> read(const CompareFiles& files, const FrameLoopHost& host) {
    const Control control{.cancelled = host.cancelled};
    ShotSource other = files.reference;
    other.path = files.test;
    const auto first = read_shot(files.reference, control);
    if (!first) return first.error();
    const auto second = read_shot(other, control);
    if (!second) return second.error();
    Pictures pictures;
    for (const Shot* shot : {&*first, &*second}) {
        pictures.non_finite += shot->non_finite_colour;
        for (const std::string& line : shot->warnings) say(host, Say::Warning, line);
    }
    pictures.have_alpha = first->has_alpha && second->has_alpha;
    pictures.reference = over_display_window(first->colour, first->place);
    pictures.test = over_display_window(second->colour, second->place);
    if (files.mask.empty()) return pictures;
    auto mask = read_mask(files.mask);
    if (!mask) return mask.error();
    pictures.mask = std::move(*mask);
    return pictures;
}

}  // namespace

Result<ComparedFiles> compare_files(const CompareFiles& files, const FrameLoopHost& host) {
    const Stopwatch watch;
    const auto pictures = read(files, host);
    if (!pictures) return pictures.error();
    const auto& [reference, test, mask, non_finite, have_alpha] = *pictures;
    if (Status same = check_sizes(files, reference, test, mask); !same) return same.error();
    if (const std::string note = note_of_alpha(*pictures); !note.empty()) say(host, Say::Warning, note);
    const double read_s = watch.seconds();
    const CompareSettings settings{.exposure = files.exposure, .mask = mask.view()};
    const auto result = compare(reference.view(), test.view(), settings);
    if (!result) return result.error();
    auto where = difference(reference.view(), test.view(), settings);
    if (!where) return where.error();
    if (Status done = write_heat_map(files, *where); !done) return done.error();
    if (!files.heat_map.empty()) say(host, Say::Note, "wrote " + files.heat_map);
    Json record = record_of(*result, files);
    record["worst_places"] = record_of(where->worst);
    record["output"] = files.heat_map.empty() ? Json(nullptr) : Json(files.heat_map);
    record["non_finite"]["colour"] = non_finite;
    record["seconds"]["read"] = read_s;
    record["seconds"]["compute"] = watch.seconds() - read_s;
    record["seconds"]["total"] = watch.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    return ComparedFiles{*result, std::move(where->worst), records::as_text(record)};
}

FrameWork work_of(const CompareFiles& files, const FrameLoopHost& host,
                  const std::function<void(int frame, const ComparedFiles&)>& compared) {
    FrameWork work;
    work.input = has_frame_number(files.test) ? files.test : files.reference.path;
    work.files = [files](int frame) -> Result<FrameWork::Files> {
        const CompareFiles of = of_frame(files, frame);
        FrameWork::Files both{{of.reference.path, of.test}, {}};
        if (!of.mask.empty()) both.inputs.push_back(of.mask);
        if (!of.heat_map.empty()) both.outputs.push_back(of.heat_map);
        return both;
    };
    work.make = [files, host, compared](int frame, bool) -> Result<FrameRecord> {
        const auto result = compare_files(of_frame(files, frame), host);
        if (!result) return result.error();
        compared(frame, *result);
        return frame_record(result->record);
    };
    return work;
}

}  // namespace petzval
