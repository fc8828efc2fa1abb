#include "petzval/shots/shot_sheet.h"

#include "petzval/develop.h"
#include "petzval/frames.h"
#include "petzval/place.h"
#include "petzval/views.h"

#include "records/record_json.h"
#include "sequence/video.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace petzval {
namespace {

class Sheet {
public:
    Sheet(ShotSheet sheet, FrameLoopHost host) : sheet_(std::move(sheet)), host_(std::move(host)) {}

    const std::string& input() const { return sheet_.source.path; }
    Status check() const { return petzval::check(sheet_); }

    Result<FrameRecord> add(int frame) {
        ShotSource source = sheet_.source;
        source.path = at_frame(source.path, frame);
        const auto shot = read_shot(source, {.cancelled = host_.cancelled});
        if (!shot) return shot.error();
        const Place& at = shot->place;
        Picture whole = through_window(shot->colour, at.data_window, at.display_window, Rgba{});
        if (width_ == 0) choose_size(whole, at.pixel_aspect);
        // A frame of another shape keeps it, centred.
        const double scale =
            std::min(width_ / (whole.width() * at.pixel_aspect), double(height_) / whole.height());
        const int width = std::clamp(int(std::lround(whole.width() * at.pixel_aspect * scale)), 1, width_);
        const int height = std::clamp(int(std::lround(whole.height() * scale)), 1, height_);
        const Picture seen = shown(resized(whole, width, height),
                                   sheet_.display.settings(shot->code_bits, sheet_.transfer, sheet_.threads));
        Picture cell(width_, height_, {0, 0, 0, 1});
        for (int y = 0; y < height; ++y)
            std::copy_n(seen.row(y), width, cell.row(y + (height_ - height) / 2) + (width_ - width) / 2);
        if (Status done = place(frame, std::move(cell)); !done) return done.error();
        return frame_record(
            records::as_text(records::Json{{"input", source.path}, {"warnings", shot->warnings}}));
    }

    Status add_black(int frame) { return place(frame, Picture(width_, height_)); }

    Status write() {
        if (makes_video() ? !video_ : cells_.empty())
            return Error{ErrorCode::InvalidFile, "no frame could be read"};
        const Status done = makes_video() ? video_->finish() : write_cells();
        if (done && host_.say) host_.say(Say::Note, "wrote " + sheet_.output);
        return done;
    }

private:
    bool makes_video() const { return is_video(sheet_.output); }

    Status write_cells() const {
        const DevelopSettings as_it_is{.tone = ToneCurve::None, .dither = false, .threads = sheet_.threads};
        return write_developed(sheet_.output, contact_sheet(cells_, sheet_.columns).view(), as_it_is,
                               sheet_.overwrite);
    }

    // Size of the first readable frame, in square pixels; videos need even numbers.
    void choose_size(const Picture& first, double aspect) {
        const double wide = first.width() * aspect;
        const double own = makes_video() ? std::min(wide, 1920.0) : 320;
        const double wanted = sheet_.width_px ? *sheet_.width_px : own;
        const auto even = [&](double length) {
            const int whole = std::clamp(int(std::lround(length)), 2, 65536);
            return makes_video() ? whole / 2 * 2 : whole;
        };
        width_ = even(wanted);
        height_ = even(wanted * first.height() / wide);
    }

    Status place(int frame, Picture cell) {
        if (sheet_.labels) draw_caption(cell, std::to_string(frame));
        if (!makes_video()) {
            cells_.push_back(std::move(cell));
            return Done{};
        }
        if (!video_) {
            auto video = std::make_unique<sequence::Video>();
            Status open = video->open(sheet_.output, width_, height_, sheet_.frames_per_second.value_or(24));
            if (!open) return open;
            video_ = std::move(video);
        }
        std::vector<std::uint8_t> rgb;
        rgb.reserve(3 * cell.size());
        for (std::size_t i = 0; i < cell.size(); ++i)
            for (const float v : {cell.pixels()[i].r, cell.pixels()[i].g, cell.pixels()[i].b})
                rgb.push_back(std::uint8_t(std::lround(255 * srgb_encode(double(v)))));
        return video_->add(rgb);
    }

    ShotSheet sheet_;
    FrameLoopHost host_;
    int width_ = 0, height_ = 0;  // of a cell
    std::vector<Picture> cells_;  // display-linear
    std::unique_ptr<sequence::Video> video_;
};

}  // namespace

Status check(const ShotSheet& sheet) {
    const auto refused = [](const std::string& field, const std::string& why) {
        return Error{ErrorCode::InvalidArgument, field + why, field};
    };
    const auto kind = kind_of_output(sheet.output);
    if (is_video(sheet.output))
        return sheet.columns > 0 ? Status(refused("sheet.columns", " has no effect on a video")) : Done{};
    if (!kind || *kind != FileKind::Png)
        return refused("run.output",
                       " " + sheet.output + ": the name must end in .png, or .mp4, .mov, .mkv or .webm");
    if (sheet.frames_per_second)
        return refused("sheet.frames_per_second", " has no effect on a contact sheet");
    return Done{};
}

FrameWork work_of(ShotSheet settings, FrameLoopHost host) {
    const auto sheet = std::make_shared<Sheet>(std::move(settings), std::move(host));
    FrameWork work;
    work.input = sheet->input();
    work.files = [sheet](int frame) -> Result<FrameWork::Files> {
        if (const Status fine = sheet->check(); !fine) return fine.error();
        return FrameWork::Files{{at_frame(sheet->input(), frame)}, {}};
    };
    work.make = [sheet](int frame, bool) { return sheet->add(frame); };
    work.black = [sheet](int frame, int) { return sheet->add_black(frame); };
    work.finish = [sheet] { return sheet->write(); };
    return work;
}

}  // namespace petzval
