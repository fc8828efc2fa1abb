// petzval sheet: the frames of a shot beside each other, or one after the other, to be looked at.
#include "petzval/develop.h"
#include "petzval/output.h"
#include "petzval/place.h"
#include "petzval/views.h"

#include "console/console.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "lens/on_picture.h"
#include "output.h"
#include "verbs.h"
#include "video.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace petzval::cli {
namespace {

struct SheetFlags {
    InputFlags input;
    std::string output;
    int columns = 0;  // 0: about as wide as high
    std::optional<int> width_px;
    std::optional<double> rate;  // 24 where it is not given
    bool no_labels = false;
    DevelopFlags develop;
    OverwriteFlags overwrite;
    FrameFlags frames;
    RunFlags run;
    LensesOnPictureFlags lenses;

    bool makes_video() const { return is_video(output); }
};

Status write_sheet(const SheetFlags& flags, const Picture& sheet) {
    return write_developed(flags.output, sheet.view(),
                           {.tone = ToneCurve::None, .dither = false, .threads = flags.run.threads},
                           !flags.overwrite.no_clobber);
}

Status make_lens_sheet(SheetFlags& flags) {
    if (const auto reason = flags.overwrite.reason_to_skip({flags.output}, {})) {
        note(*reason);
        return Done{};
    }
    const LensViewSheet settings{.cell_width_px = flags.width_px.value_or(480),
                                 .columns = flags.columns,
                                 .captions = !flags.no_labels};
    const auto sheet = flags.lenses.make(flags.input, settings, flags.develop, flags.run);
    if (!sheet) return sheet.error();
    if (Status done = write_sheet(flags, *sheet); !done) return done;
    note("wrote " + flags.output);
    return Done{};
}

class Sheet {
public:
    explicit Sheet(const SheetFlags& flags) : all_(flags) {}

    Status operator()() {
        if (const auto reason = all_.overwrite.reason_to_skip({all_.output}, {})) {
            note(*reason);
            return Done{};
        }
        FrameWork work;
        work.input = all_.input.path;
        work.files = [&](int frame) -> Result<FrameWork::Files> {
            return FrameWork::Files{{at_frame(all_.input.path, frame)}, {}};
        };
        work.make = [&](int frame, bool) { return record_of(add(frame)); };
        work.black = [&](int frame, int) { return place(frame, Picture(width_, height_)); };
        work.finish = [&] { return write(); };
        return make_frames(all_.frames, all_.run, work);
    }

private:
    Result<Json> add(int frame) {
        InputFlags input = all_.input;
        input.path = at_frame(input.path, frame);
        const auto shot = load_shot(input.source());
        if (!shot) return shot.error();
        const Place& at = shot->place;
        Picture whole = through_window(shot->colour, at.data_window, at.display_window, Rgba{});
        if (width_ == 0) choose_size(whole, at.pixel_aspect);
        // A frame of another shape keeps it, centred.
        const double scale =
            std::min(width_ / (whole.width() * at.pixel_aspect), double(height_) / whole.height());
        const int width = std::clamp(int(std::lround(whole.width() * at.pixel_aspect * scale)), 1, width_);
        const int height = std::clamp(int(std::lround(whole.height() * scale)), 1, height_);
        const Picture seen =
            shown(resized(whole, width, height),
                  all_.develop.settings(shot->display_referred, all_.input.transfer, all_.run.threads));
        Picture cell(width_, height_, {0, 0, 0, 1});
        for (int y = 0; y < height; ++y)
            std::copy_n(seen.row(y), width, cell.row(y + (height_ - height) / 2) + (width_ - width) / 2);
        if (Status done = place(frame, std::move(cell)); !done) return done.error();
        return Json{{"input", input.path}, {"warnings", shot->warnings}};
    }

    // Size of the first readable frame, in square pixels; videos need even numbers.
    void choose_size(const Picture& first, double aspect) {
        const double wide = first.width() * aspect;
        const double wanted = all_.width_px        ? *all_.width_px
                              : all_.makes_video() ? std::min(wide, 1920.0)
                                                   : 320;
        const auto even = [&](double length) {
            const int whole = std::clamp(int(std::lround(length)), 2, 65536);
            return all_.makes_video() ? whole / 2 * 2 : whole;
        };
        width_ = even(wanted);
        height_ = even(wanted * first.height() / wide);
    }

    Status place(int frame, Picture cell) {
        if (!all_.no_labels) draw_caption(cell, std::to_string(frame));
        if (!all_.makes_video()) {
            cells_.push_back(std::move(cell));
            return Done{};
        }
        if (!video_) {
            video_ = std::make_unique<Video>();
            if (Status open = video_->open(all_.output, width_, height_, all_.rate.value_or(24)); !open) {
                video_.reset();
                return open;
            }
        }
        std::vector<std::uint8_t> rgb;
        rgb.reserve(3 * cell.size());
        for (std::size_t i = 0; i < cell.size(); ++i)
            for (const float v : {cell.pixels()[i].r, cell.pixels()[i].g, cell.pixels()[i].b})
                rgb.push_back(std::uint8_t(std::lround(255 * srgb_encode(double(v)))));
        return video_->add(rgb);
    }

    Status write() {
        if (all_.makes_video() ? !video_ : cells_.empty())
            return Error{ErrorCode::InvalidFile, "no frame could be read"};
        const Status done =
            all_.makes_video() ? video_->finish() : write_sheet(all_, contact_sheet(cells_, all_.columns));
        if (done) note("wrote " + all_.output);
        return done;
    }

    const SheetFlags& all_;
    int width_ = 0, height_ = 0;  // of a cell
    std::vector<Picture> cells_;  // display-linear
    std::unique_ptr<Video> video_;
};

void check(SheetFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "IN.####.exr");
    require_argument(verb, flags.output, "-o SHEET.png");
    flags.run.apply();
    flags.overwrite.check();
    flags.lenses.check(verb, flags.input);
    const auto kind = kind_of_output(flags.output);
    if (!flags.makes_video() && (!kind || *kind != FileKind::Png))
        throw UsageError("-o " + flags.output + ": the name must end in .png, or .mp4, .mov, .mkv or .webm");
    if (!flags.makes_video() && flags.rate) throw UsageError("--rate has no effect on a contact sheet");
    if (flags.makes_video() && flags.columns > 0) throw UsageError("--columns has no effect on a video");
    if (flags.lenses.is_on()) {
        if (flags.makes_video()) throw UsageError("--lenses makes a sheet of one picture: -o FILE.png");
        if (!flags.frames.given().empty() || has_pattern(flags.input.path))
            throw UsageError("--lenses shows one picture: give one frame of " + flags.input.path);
        return;
    }
    if (!is_sequence(flags.frames, {flags.input.path}, "", flags.run))
        throw UsageError("no frames: the input has no #### or %04d");
}

}  // namespace

void add_sheet(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "sheet",
                          "the frames of a shot, or one picture through several lenses, on a contact sheet",
                          "petzval sheet out.####.exr -o sheet.png\n"
                          "petzval sheet out.####.exr -o shot.mp4 --frames 1001-1100\n"
                          "petzval sheet night.exr --lenses doublet,biotar,petzval-portrait -o lenses.png");
    auto flags = std::make_shared<SheetFlags>();
    flags->input.add_to(verb);
    flags->input.add_transfer_to(verb);
    flags->lenses.add_to(verb, flags->input);
    FlagGroup(verb, "Output")
        .writes("-o,--output", "FILE",
                "a contact sheet (.png), or a video by ffmpeg (.mp4, .mov, .mkv, .webm)", flags->output)
        .value("--columns", "N", "frames beside each other (default: about as many as below each other)",
               parse_count, flags->columns)
        .value(
            "--width", "PX",
            "width of a frame (default 320 on a sheet, 480 with --lenses, its own in a video, 1920 at most)",
            parse_size_px, flags->width_px)
        .value("--rate", "FPS", "frames a second of a video (default 24)", parse_positive, flags->rate)
        .on("--no-labels", "no frame numbers or lens names", flags->no_labels);
    flags->overwrite.add_to(verb, false);
    flags->develop.add_to(verb);
    flags->frames.add_to(verb);
    flags->run.add_threads_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return flags->lenses.is_on() ? make_lens_sheet(*flags) : Sheet(*flags)(); };
    });
}

}  // namespace petzval::cli
