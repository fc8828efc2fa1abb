// State of the window: open files, choices, finished pictures. Drawing is elsewhere.
#pragma once

#include "petzval/track.h"

#include "bench.h"
#include "contact_sheet.h"
#include "curve_edit.h"
#include "darkroom.h"
#include "history.h"
#include "maker.h"
#include "state.h"
#include "tev.h"
#include "texture.h"
#include "view.h"

#include <array>
#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

// Pictures of one side: the whole frame, and the region last shown in detail.
struct SideFrames {
    std::optional<Wish> wish;  // the last
    std::uint64_t number = 0;  // of it
    bool complete = false;     // its last step is there
    std::shared_ptr<const Picture> whole, detail;
    std::shared_ptr<const DraftCodes> codes;  // of a draft, in place of the whole
    Rect whole_area, detail_area;
    bool whole_is_old = false, detail_is_old = false;  // of another wish
    std::shared_ptr<const Plane> numbers;              // in place of the whole; else null
    std::shared_ptr<const Plane> radii;
    std::shared_ptr<const std::vector<Panel>> panels;  // of a buffer; else null
    MadeFrame last;                                    // without its pictures
};

// A picture on the screen: position and content.
struct Shown {
    Texture texture;
    Print print;  // without its codes
    std::optional<Negative> asked;
};

// An entry of the contact sheet and its picture on the screen; empty texture: not made yet, or an error.
struct SheetTile {
    SheetEntry entry;
    Texture texture;
    std::string error;
};

// Position of the canvas in window pixels, and its mapping to pixels of the frame.
struct Mapping {
    double x0 = 0, y0 = 0, width = 0, height = 0;
    double scale_x = 1, scale_y = 1;    // window pixels per pixel of the frame
    double centre_x = 0, centre_y = 0;  // pixels of the frame, in the middle of the canvas

    double screen_x(double x) const { return x0 + width / 2 + (x - centre_x) * scale_x; }
    double screen_y(double y) const { return y0 + height / 2 + (y - centre_y) * scale_y; }
    double frame_x(double sx) const { return centre_x + (sx - x0 - width / 2) / scale_x; }
    double frame_y(double sy) const { return centre_y + (sy - y0 - height / 2) / scale_y; }
    Rect seen() const;  // whole pixels of the frame
};

// Seconds of drafts by their coarseness, 1…4: some are for every pixel, some for every draft.
class DraftTimes {
public:
    static constexpr int kCoarsest = 4;
    void note(int coarse, double seconds);
    double expected_s(int coarse) const;  // 0: nothing is known

private:
    std::array<double, kCoarsest + 1> seconds_{};  // 0: unknown
};

// Longest times so far, in milliseconds.
struct Slowest {
    double tick = 0;           // work of the window's thread between two events
    double first_picture = 0;  // from a change to the first picture of it on the screen
    double last_picture = 0;   // the same, of the last change alone
    double cancel = 0;         // from a move to the end of what was being made before it
};

class App {
public:
    App(const Setup& setup, const std::function<void()>& wake);
    ~App();
    App(const App&) = delete;
    App& operator=(const App&) = delete;

    const Setup& setup() const { return setup_; }
    const ShotPointer& shot() const { return shot_; }
    const ShotPointer& against() const { return against_; }
    const SideFrames& side(int index) const { return sides_[std::size_t(index)]; }
    const LensMade& lens_made() const { return lens_made_; }
    const std::array<Texture, LensMade::kPictures>& lens_pictures() const { return lens_pictures_; }
    const std::array<Shown, Darkroom::kTargets>& on_screen() const { return on_screen_; }

    State state;
    Mapping mapping;  // of the last tick
    // Messages in the window; empty: none. About the last command, the frame, and notices.
    std::string error, trouble, notice;
    std::string copied;             // by the command `copy`, for the clipboard
    std::optional<Error> unopened;  // the first file cannot be shown at all
    bool quit = false;
    Slowest slowest;
    std::map<std::string, Rect> widgets;  // where fields were drawn, by path
    double screen_height = 0;

    // The frame's numbers as far as they are known, and all of them. Errors: those of complete_camera().
    FoundCamera found_camera() const;
    Result<Camera> camera() const;
    // The frame in which things lie: the display window, or a buffer's own size. Empty: nothing is open.
    Rect frame() const;
    double pixel_aspect() const;
    // distance_around_m() of the 5 x 5 pixels around one of the frame, as focus-track has it. Nothing: all of
    // them misses, or no depth.
    std::optional<double> depth_near(PixelPosition pixel) const;
    std::optional<float> radius_at(PixelPosition pixel) const;

    // Steps of a tick, in this order: take finished work, then request missing work.
    void take_news();
    void ask();
    // Something was done by hand: if a picture changes by it, it is timed from here.
    void note_action();
    std::string waits_for() const;       // while nothing is open
    bool is_busy() const;                // something is being read, made, developed or saved
    void read_again(bool anew = false);  // anew: a scene's file as well
    void open(const std::string& path);  // another file, or a shot's frames by their pattern
    // One step back, or forward again. Errors: InvalidArgument where there is none.
    Status undo(bool again);
    // Small pictures of this frame through many looks, in their own window. Errors: InvalidArgument where no
    // picture with depth and camera is open.
    Status open_sheet(std::vector<SheetEntry> entries);
    void close_sheet();
    bool has_sheet() const { return !sheet_tiles_.empty(); }
    const std::vector<std::unique_ptr<SheetTile>>& sheet_tiles() const { return sheet_tiles_; }
    void settle_choice();  // a change since the last call becomes a step to undo
    // The choice, with the camera numbers that are assumed: the command line needs them.
    Choice full_choice() const;
    void go_to(int frame);
    bool is_live() const { return !setup_.scene.empty(); }
    // The scene at a frame as its camera looks at it now, or on its path. Requires: is_live().
    SceneWish scene_wish(int frame) const;
    SceneWish scene_wish() const { return scene_wish(state.timeline.frame); }
    void turn_to(const Orbit& wish);  // the scene's camera, as far as it may go
    // .exr: sharp frames with depth; .png: what is shown.
    void record(const std::string& path);
    // Checks that a file of that name may be written: it must not replace an input of this run. A placeholder
    // stands for the number of the frame shown.
    Status may_write(const std::string& name) const;
    void save(const std::string& name);  // of a shot, #### is the frame that is shown
    void finish_saving();                // waits for it, and takes its error
    // Sends the left side's result to a viewer that listens there.
    Status push(int port);
    // Focus, aperture and all else over the frames, as `defocus --track` has it; focus becomes keys.
    void use_track(Track track);
    // The lens in use bends at a zone of its pupil (curve_edit.h) and is used from then on. Errors: those of
    // bent_lens_of(), OutputFailed.
    Status bend_lens(double zone, double by_mm, double only_nm);
    const std::optional<BentLens>& bent() const { return bent_; }

private:
    ShotSource source() const;  // of the frame that is shown
    void start_saving(const std::string& path, std::function<Status()> save);
    void play();
    void take_track(int frame);
    void take_pushed();
    bool waits_for_pictures() const;
    void refine_scene();
    bool is_coarse() const;  // a scene whose camera moved a moment ago
    int coarse_by() const;
    void time_draft(const MadeFrame& made);
    std::string of_this_frame(const std::string& path) const;  // #### filled in
    void has_frames(int count);
    void take_shot(ReadShot read);
    void forget_frames();
    void take_frame(MadeFrame made);
    void take_print(Print print);
    void ask_frame(int index, const Side& side);
    std::optional<Rect> region_for(const SideFrames& frames, const Wish& wish) const;
    void ask_prints(int index, const Side& side);
    void ask_lens();
    void take_lens(LensMade made);
    void take_cell(SheetCell cell);
    void ask_print(int target, Negative negative);
    void clear_print(int target);

    Setup setup_;
    Chosen chosen() const;
    History history_;
    InputChoice opened_, shown_;  // the last that was read, and the last that could be shown
    ShotPointer shot_, against_;
    std::array<SideFrames, 2> sides_;
    std::array<Shown, Darkroom::kTargets> on_screen_;
    std::chrono::steady_clock::time_point acted_;
    std::optional<std::chrono::steady_clock::time_point> changed_;
    std::future<Status> saving_;
    std::string saving_to_;
    bool reading_ = false;
    std::optional<FoundCamera> home_;  // of a scene: its own view
    bool coarse_ = false;              // it is to be seen with few rays, as it moves
    DraftTimes draft_times_;
    std::chrono::steady_clock::time_point moved_;
    std::chrono::steady_clock::time_point shown_since_;  // the frame, while it is played
    LensMade lens_made_;
    std::array<Texture, LensMade::kPictures> lens_pictures_;
    std::optional<LensWish> lens_wish_;
    std::optional<Track> track_;
    std::optional<BentLens> bent_;
    std::string bent_file_;  // in a folder of temporary files, until it is saved
    int bends_ = 0;
    std::unique_ptr<TevListener> listener_;
    std::function<void()> wake_;
    Darkroom darkroom_;
    LensBench bench_;
    ContactSheet sheet_;
    std::vector<std::unique_ptr<SheetTile>> sheet_tiles_;
    Maker maker_;  // last: its thread uses the above
};

}  // namespace petzval::view
