// One frame of a run: read, focused, completed by its neighbours and other eyes, blurred, written, recorded.
#pragma once

#include "petzval/reports/stopwatch.h"
#include "petzval/seen_elsewhere.h"
#include "petzval/shot_run.h"

#include "records/record_json.h"
#include "sequence/write_view.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace petzval::sequence {

using records::add_stages;
using records::as_text;
using records::Json;
using records::number;

// Facts of one frame beside its settings.
struct FrameContext {
    std::optional<TrackedFrame> tracked = {};  // what a track changed
    std::vector<std::string> neighbours = {};  // files of the frames around it
    std::shared_ptr<Result<Shot>> shot = {};   // read ahead; used up
    bool again = false;                        // what is there does not count
    // Surfaces that neighbouring frames and other eyes see behind this frame's; empty: not requested.
    std::function<Result<SeenElsewhere>(const Shot&, std::span<const Shot* const> eyes)> around = {};
};

// Errors: those of make_picture(). The record as JSON.
Result<Json> make_frame(Session& session, const ShotRunSettings& settings, const ShotRunHost& host,
                        const FrameContext& context);
// A frame without light, of the size of `like`.
Status make_black_frame(const ShotRunSettings& settings, const ShotRunSettings& like);

// The assumption in words, for logs and the attribute petzval:expandHighlights.
std::string in_words(const HighlightExpansion& expansion);
// "x0,y0,x1,y1", as shot.region has it.
std::string corners_text(const Rect& r);

// Settings that Update compares.
MadeWith made_with(const ShotRunSettings& settings, const FrameContext& context);

class FrameMaker {
public:
    // All outlive it.
    FrameMaker(Session& session, ShotRunSettings settings, const ShotRunHost& host,
               const FrameContext& context)
        : session_(session), settings_(std::move(settings)), host_(host), context_(context) {}

    Status make();
    const Json& record() const { return record_; }

private:
    Status leave(const std::string& why);
    Status read();
    Status read_other_views();
    Status look_around();
    void take_behind(SeenElsewhere seen);
    Status choose_camera();
    Status open_wide();
    void warn_of_wrong_units(const Camera& camera);
    bool warn_of_radius(double radius_px);
    Status grow();
    Result<Rect> wanted_window();
    Status grow_to(const Rect& window);
    Result<Rect> window_of_light(bool within_frame);
    // The look of the picture or of the view that replaces it.
    Look chosen() const;
    Control control() const;
    Status compute();
    Status render(const Rendered& lent);
    std::optional<Rect> region() const;
    Status check_region();
    void crop_to_region();
    void report_frame(const DefocusReport& done, double seconds);
    Result<DefocusReport> take(const Rendered& lent);
    std::optional<CodesWanted> codes_wanted() const;
    Json parameters() const;
    Status write();
    ViewSettings view_settings(std::vector<std::string>& warnings);
    bool is_left_alone(const std::string& path) const;
    Status save_look();
    Status finish();
    void say_layers();
    void name_track();

    void say(Say how, const std::string& line) const {
        if (host_.say) host_.say(how, line);
    }
    void note(const std::string& line) const { say(Say::Note, line); }
    void warn(const std::vector<std::string>& lines);
    void tell_new_warnings();
    bool is_cancelled() const { return host_.cancelled && host_.cancelled(); }

    int threads() const { return settings_.source.read.threads; }
    DevelopSettings display() const {
        return settings_.display.settings(shot_.code_bits, settings_.transfer, threads());
    }
    const Look& look() const { return settings_.look; }
    bool replaces() const { return settings_.existing != ExistingOutputs::Keep || context_.again; }
    // Glare, falloff and restored highlights are part of the picture, not of other views.
    bool is_beauty() const { return settings_.view == ShotView::Beauty; }
    bool expands_plate() const { return look().expand_highlights && is_beauty(); }
    bool has_radii() const {
        return settings_.source.depth_kind_given && settings_.source.depth.kind == DepthKind::CocPx;
    }
    bool needs_camera() const { return !has_radii() && settings_.view != ShotView::Depth; }

    Session& session_;
    ShotRunSettings settings_;
    const ShotRunHost& host_;
    const FrameContext& context_;
    Stopwatch total_;
    Json record_ = Json::parse(empty_record("defocus"));
    Shot shot_;
    bool has_large_radius_ = false;                    // and was warned of it
    std::size_t warnings_told_ = 0;                    // of the shot
    std::optional<Lens> lens_;                         // once read
    ViewSource view_;                                  // what compute() made and write() needs
    std::vector<std::unique_ptr<FrameMaker>> others_;  // views of a stereo file
    std::size_t held_bytes_ = 0;                       // by frames around
    std::string made_with_;                            // what the output will say
};

}  // namespace petzval::sequence
