// petzval compare: how far a picture is from a reference.
#include "petzval/compare.h"

#include "petzval/views.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>
#include <utility>

namespace petzval::cli {
namespace {

struct CompareFlags {
    InputFlags reference;  // --layer and --view-name hold for both
    std::string test, mask, output;
    double exposure = 1;
    FrameFlags frames;
    OverwriteFlags overwrite;
    RunFlags run;
};

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

Status check_sizes(const CompareFlags& flags, const Picture& reference, const Picture& test,
                   const Plane& mask) {
    const auto differs = [&](const std::string& path, int width, int height) -> Status {
        if (width == reference.width() && height == reference.height()) return Done{};
        return Error{ErrorCode::InvalidArgument, path + " has " + size_text(width, height) + " pixels, but " +
                                                     flags.reference.path + " has " +
                                                     size_text(reference.width(), reference.height())};
    };
    if (Status same = differs(flags.test, test.width(), test.height()); !same) return same;
    return mask.empty() ? Status(Done{}) : differs(flags.mask, mask.width(), mask.height());
}

std::string table(const Comparison& c) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(),
                  "%-16s%10s%10s%10s\n"
                  "%-16s%10.2f%10.2f%10.2f\n"
                  "%-16s%10.4f%10.4f\n"
                  "%-16s%10.4g  at pixel %d,%d\n"
                  "%-16s%10.6f\n",
                  "", "linear", "sRGB", "log", "PSNR, dB", c.psnr_lin, c.psnr_srgb, c.psnr_log, "SSIM",
                  c.ssim_lin, c.ssim_srgb, "largest error", c.max_error, c.max_error_x, c.max_error_y,
                  "energy ratio", c.energy_ratio);
    return text.data();
}

Json report_of(const Comparison& c, const CompareFlags& flags) {
    Json report = new_report("compare");
    report["input"] = {flags.reference.path, flags.test};
    report["exposure"] = flags.exposure;
    report["mask"] = flags.mask.empty() ? Json(nullptr) : Json(flags.mask);
    report["psnr_lin"] = number(c.psnr_lin);
    report["ssim_lin"] = number(c.ssim_lin);
    report["psnr_srgb"] = number(c.psnr_srgb);
    report["ssim_srgb"] = number(c.ssim_srgb);
    report["psnr_log"] = number(c.psnr_log);
    report["max_error"] = number(c.max_error);
    report["max_error_at"] = {c.max_error_x, c.max_error_y};
    report["energy_ratio"] = number(c.energy_ratio);
    return report;
}

// "1  12,340 to 44,372   RMS 30.5 codes" for each of the worst places.
std::string places_text(const Difference& difference) {
    std::string text;
    for (std::size_t i = 0; i < difference.worst.size(); ++i) {
        const Rect& r = difference.worst[i].area;
        std::array<char, 120> line{};
        std::snprintf(line.data(), line.size(), "%-16s%d,%d to %d,%d: %.2f codes RMS\n",
                      ("worst place " + std::to_string(i + 1)).c_str(), r.x0, r.y0, r.x1, r.y1,
                      255 * difference.worst[i].rms);
        text += line.data();
    }
    return text;
}

Json places_json(const Difference& difference) {
    Json places = Json::array();
    for (const WorstPlace& place : difference.worst)
        places.push_back({{"area", {place.area.x0, place.area.y0, place.area.x1, place.area.y1}},
                          {"rms_codes", 255 * place.rms}});
    return places;
}

Status write_heat_map(const CompareFlags& flags, const Difference& difference) {
    if (flags.output.empty()) return Done{};
    std::vector<Rect> areas;
    for (const WorstPlace& place : difference.worst) areas.push_back(place.area);
    const Picture map = heat_map(difference.error.view(), areas);
    const Status done = write_developed(flags.output, map.view(), {.tone = ToneCurve::None, .dither = false},
                                        !flags.overwrite.no_clobber);
    if (done) note("wrote " + flags.output);
    return done;
}

struct Compared {
    Comparison comparison;
    Json report;
    std::string places;
};

Result<Compared> compare_files(const CompareFlags& flags) {
    const Stopwatch watch;
    InputFlags test_input = flags.reference;
    test_input.path = flags.test;
    auto first = load_shot(flags.reference.source());
    if (!first) return first.error();
    auto second = load_shot(test_input.source());
    if (!second) return second.error();
    const std::size_t broken = first->non_finite_colour + second->non_finite_colour;
    for (const Shot* shot : {&*first, &*second})
        for (const auto& line : shot->warnings) warning(line);
    const Picture reference = over_display_window(first->colour, first->place);
    const Picture test = over_display_window(second->colour, second->place);
    Plane mask;
    if (!flags.mask.empty()) {
        auto read = read_mask(flags.mask);
        if (!read) return read.error();
        mask = std::move(*read);
    }
    if (Status same = check_sizes(flags, reference, test, mask); !same) return same.error();
    const double read_s = watch.seconds();
    const CompareSettings settings{.exposure = flags.exposure, .mask = mask.view()};
    const auto result = compare(reference.view(), test.view(), settings);
    if (!result) return result.error();
    const auto where = difference(reference.view(), test.view(), settings);
    if (!where) return where.error();
    if (Status done = write_heat_map(flags, *where); !done) return done.error();
    Json report = report_of(*result, flags);
    report["worst_places"] = places_json(*where);
    report["output"] = flags.output.empty() ? Json(nullptr) : Json(flags.output);
    report["non_finite"]["colour"] = broken;
    report["seconds"]["read"] = read_s;
    report["seconds"]["compute"] = watch.seconds() - read_s;
    report["seconds"]["total"] = watch.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return Compared{*result, std::move(report), places_text(*where)};
}

Status compare_pair(const CompareFlags& flags) {
    if (!flags.output.empty())
        if (const auto reason = flags.overwrite.reason_to_skip({flags.output}, {})) {
            note(*reason);
            return Done{};
        }
    const auto compared = compare_files(flags);
    if (!compared) return compared.error();
    return tell(table(compared->comparison) + compared->places, compared->report, flags.run.json);
}

// A row a frame, then the mean and the worst: a shot is as good as its worst frame.
class ShotTable {
public:
    void add(int frame, const Comparison& c, const std::string& places) {
        rows_ += row(std::to_string(frame), c);
        sum_.psnr_lin += c.psnr_lin;
        sum_.psnr_srgb += c.psnr_srgb;
        sum_.ssim_srgb += c.ssim_srgb;
        if (count_++ == 0 || c.psnr_lin < worst_.psnr_lin) {
            worst_ = c;
            worst_frame_ = frame;
            places_ = places;
        }
    }
    std::string text() const {
        if (count_ == 0) return "";
        std::array<char, 160> head{}, mean{};
        std::snprintf(head.data(), head.size(), "%-8s%14s%14s%12s%16s%14s\n", "frame", "PSNR lin dB",
                      "PSNR sRGB dB", "SSIM sRGB", "largest error", "energy ratio");
        std::snprintf(mean.data(), mean.size(), "%-8s%14.2f%14.2f%12.4f\n", "mean", sum_.psnr_lin / count_,
                      sum_.psnr_srgb / count_, sum_.ssim_srgb / count_);
        return head.data() + rows_ + mean.data() + "worst is frame " + std::to_string(worst_frame_) + "\n" +
               places_;
    }

private:
    static std::string row(const std::string& name, const Comparison& c) {
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(), "%-8s%14.2f%14.2f%12.4f%16.4g%14.6f\n", name.c_str(),
                      c.psnr_lin, c.psnr_srgb, c.ssim_srgb, c.max_error, c.energy_ratio);
        return text.data();
    }
    std::string rows_, places_;
    Comparison sum_{}, worst_{};
    int count_ = 0, worst_frame_ = 0;
};

Status compare_frames(const CompareFlags& all) {
    const auto of_frame = [&](int frame) {
        CompareFlags flags = all;
        put_frame(frame, {&flags.reference.path, &flags.test, &flags.mask, &flags.output, &flags.run.json});
        return flags;
    };
    ShotTable rows;
    FrameWork work;
    work.input = has_pattern(all.test) ? all.test : all.reference.path;
    work.files = [&](int frame) -> Result<FrameWork::Files> {
        const CompareFlags flags = of_frame(frame);
        FrameWork::Files files{{flags.reference.path, flags.test}, {}};
        if (!flags.mask.empty()) files.inputs.push_back(flags.mask);
        if (!flags.output.empty()) files.outputs.push_back(flags.output);
        if (!flags.run.json.empty()) files.outputs.push_back(flags.run.json);
        return files;
    };
    work.make = [&](int frame, bool) -> Result<FrameRecord> {
        const CompareFlags flags = of_frame(frame);
        auto compared = compare_files(flags);
        if (!compared) return compared.error();
        rows.add(frame, compared->comparison, compared->places);
        if (!flags.run.json.empty())
            if (Status done = write_report(compared->report, flags.run.json); !done) return done.error();
        return record_of(compared->report);
    };
    work.finish = [&] { return all.frames.report == "-" ? Status(Done{}) : write_text("-", rows.text()); };
    return make_frames(all.frames, all.run, work);
}

}  // namespace

void add_compare(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "compare",
                          "how far a picture is from a reference: PSNR, SSIM, largest error, energy",
                          "petzval compare truth.exr out.exr\n"
                          "petzval compare truth.exr out.exr --exposure 0.8 --json - | jq .psnr_lin\n"
                          "petzval compare truth.exr out.exr -o difference.png\n"
                          "petzval compare truth.####.exr out.####.exr --frames 1001-1100");
    auto flags = std::make_shared<CompareFlags>();
    FlagGroup(verb, "Input")
        .argument("REF", "the reference: EXR or PNG", flags->reference.path)
        .argument("TEST", "the picture to judge, of the same size", flags->test)
        .value("--layer", "NAME", "colour layer or part, of both", parse_text, flags->reference.read.layer)
        .value("--view-name", "NAME", "view of stereo files, of both", parse_text,
               flags->reference.read.view_name)
        .value("--exposure", "FACTOR", "multiply both by this before they are clipped to 1", parse_positive,
               flags->exposure)
        .reads("--mask", "FILE", "count only pixels where this picture is above one half", flags->mask);
    FlagGroup(verb, "Output")
        .writes("-o,--output", "FILE.png",
                "heat map of the difference in sRGB codes, logarithmic, with the worst places outlined",
                flags->output);
    flags->overwrite.add_to(verb, false);
    flags->frames.add_to(verb);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        require_argument(verb, flags->reference.path, "REF and TEST");
        require_argument(verb, flags->test, "TEST, the picture to judge");
        flags->run.apply();
        flags->overwrite.check();
        if (const auto kind = kind_of_output(flags->output);
            !flags->output.empty() && (!kind || *kind != FileKind::Png))
            throw UsageError("-o " + flags->output + ": the name must end in .png");
        flags->reference.read.need_depth = false;
        const bool many =
            is_sequence(flags->frames, {flags->reference.path, flags->test}, flags->output, flags->run);
        chosen = [flags, many] { return many ? compare_frames(*flags) : compare_pair(*flags); };
    });
}

}  // namespace petzval::cli
