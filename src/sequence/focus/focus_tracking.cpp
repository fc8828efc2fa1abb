#include "petzval/focus_track.h"
#include "petzval/frames.h"
#include "petzval/output.h"
#include "petzval/track.h"

#include "records/record_json.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace petzval {
namespace {

using records::Json;

class Tracking {
public:
    Tracking(FocusTracking all, FrameLoopHost host) : all_(std::move(all)), host_(std::move(host)) {}

    ShotSource source(int frame) const { return at_frame(all_.source, frame); }
    const ShotSource& source() const { return all_.source; }

    Result<FrameRecord> measure(int frame) {
        const auto shot = read_shot(source(frame), {.cancelled = host_.cancelled});
        if (!shot) return shot.error();
        const PixelPosition pixel = pixel_at(all_.picks, frame);
        const auto distance = distance_around_m(*shot, pixel, all_.within_px);
        if (!distance) return distance.error();
        Json record = {{"input", shot->path}, {"pixel", {pixel.x, pixel.y}}, {"warnings", shot->warnings}};
        record["focus_distance_m"] = *distance ? records::number(**distance) : Json(nullptr);
        if (*distance)
            measured_.push_back({frame, **distance});
        else
            record["warnings"].push_back("frame " + std::to_string(frame) + ": no surface at " +
                                         std::to_string(pixel.x) + "," + std::to_string(pixel.y) +
                                         "; focus is interpolated between its neighbours");
        return frame_record(records::as_text(record));
    }

    Status write() {
        if (measured_.empty())
            return Error{ErrorCode::InvalidFile, "no frame shows anything at the pixels of focus.picks"};
        std::sort(measured_.begin(), measured_.end(),
                  [](const FocusKey& a, const FocusKey& b) { return a.frame < b.frame; });
        const std::vector<FocusKey> track = smoothed(measured_, all_.smooth_frames);
        if (Status done = write_text(all_.output, track_csv(track), all_.overwrite); !done) return done;
        say("wrote " + all_.output + ", " + std::to_string(track.size()) + " keys");
        if (all_.plot.empty()) return Done{};
        const Status drawn = write_text(all_.plot, focus_plot(measured_, track), all_.overwrite);
        if (drawn) say("wrote " + all_.plot);
        return drawn;
    }

private:
    void say(const std::string& line) const {
        if (host_.say) host_.say(Say::Note, line);
    }

    FocusTracking all_;
    FrameLoopHost host_;
    std::vector<FocusKey> measured_;
};

}  // namespace

FrameWork work_of(FocusTracking settings, FrameLoopHost host) {
    const auto tracking = std::make_shared<Tracking>(std::move(settings), std::move(host));
    const ShotSource& source = tracking->source();
    FrameWork work;
    work.input = has_frame_number(source.path) ? source.path : source.read.depth_file;
    work.files = [tracking](int frame) -> Result<FrameWork::Files> {
        return FrameWork::Files{files_of(tracking->source(frame)), {}};
    };
    work.make = [tracking](int frame, bool) { return tracking->measure(frame); };
    work.finish = [tracking] { return tracking->write(); };
    return work;
}

}  // namespace petzval
