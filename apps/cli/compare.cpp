// petzval compare: how far a picture is from a reference.
#include "petzval/shots/compare_files.h"

#include "console/report.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"
#include "verbs.h"

#include <array>
#include <cstdio>
#include <memory>
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
    bool is_shot = false;
};

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

// "1  12,340 to 44,372   RMS 30.5 codes" for each of the worst places.
std::string places_text(const std::vector<WorstPlace>& worst) {
    std::string text;
    for (std::size_t i = 0; i < worst.size(); ++i) {
        const Rect& r = worst[i].area;
        std::array<char, 120> line{};
        std::snprintf(line.data(), line.size(), "%-16s%d,%d to %d,%d: %.2f codes RMS\n",
                      ("worst place " + std::to_string(i + 1)).c_str(), r.x0, r.y0, r.x1, r.y1,
                      255 * worst[i].rms);
        text += line.data();
    }
    return text;
}

CompareFiles files_of(const CompareFlags& flags) {
    return {flags.reference.source(),   flags.test, flags.mask, flags.output, flags.exposure,
            !flags.overwrite.no_clobber};
}

Status compare_pair(const CompareFlags& flags) {
    if (!flags.output.empty() && flags.overwrite.skips({flags.output})) return Done{};
    const auto compared = compare_files(files_of(flags), terminal());
    if (!compared) return compared.error();
    return tell(table(compared->comparison) + places_text(compared->worst), Json::parse(compared->record),
                flags.run.json);
}

// A row a frame, then the mean and the worst: a shot is as good as its worst frame.
class ShotTable {
public:
    void add(int frame, const ComparedFiles& compared) {
        const Comparison& c = compared.comparison;
        rows_ += row(std::to_string(frame), c);
        sum_.psnr_lin += c.psnr_lin;
        sum_.psnr_srgb += c.psnr_srgb;
        sum_.ssim_srgb += c.ssim_srgb;
        if (count_++ == 0 || c.psnr_lin < worst_.psnr_lin) {
            worst_ = c;
            worst_frame_ = frame;
            places_ = places_text(compared.worst);
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

Status compare_frames(const CompareFlags& flags) {
    ShotTable rows;
    FrameWork work = work_of(files_of(flags), terminal(),
                             [&](int frame, const ComparedFiles& compared) { rows.add(frame, compared); });
    work.finish = [&] { return flags.frames.report == "-" ? Status(Done{}) : write_text("-", rows.text()); };
    return make_frames(flags.frames, flags.run, std::move(work));
}

void check(CompareFlags& flags, const Verb& verb) {
    require_argument(verb, flags.reference.path, "REF and TEST");
    require_argument(verb, flags.test, "TEST, the picture to judge");
    flags.run.apply();
    flags.overwrite.check();
    if (!flags.output.empty()) require_png(flags.output);
    flags.reference.read.need_depth = false;
    flags.is_shot = is_sequence(flags.frames, {flags.reference.path, flags.test}, flags.output, flags.run);
    if (flags.is_shot) require_frames(has_pattern(flags.reference.path) || has_pattern(flags.test));
}

}  // namespace

void add_compare(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "compare", "compare a picture with a reference: PSNR, SSIM, largest error, energy",
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
    when_typed(verb, chosen, flags, check,
               [](const auto& given) { return given.is_shot ? compare_frames(given) : compare_pair(given); });
}

}  // namespace petzval::cli
