// The thread that reads shots and makes frames of them.
#pragma once

#include "petzval/camera.h"
#include "petzval/defocus.h"
#include "petzval/look.h"
#include "petzval/session.h"
#include "petzval/shot.h"

#include "darkroom.h"
#include "depth_histogram.h"
#include "instanced_draw.h"
#include "live_scene.h"
#include "tev.h"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace petzval::view {

struct OpenShot {
    Shot shot;
    DepthHistogram histogram;
    // Hidden surfaces and the holdout, samples composited over one another; null: none.
    std::shared_ptr<const Picture> hidden, holdout;
    bool is_pushed = false;  // by another program: there is no file
    std::string no_depth;    // why the shot is shown without its depth; empty: it has it
    // Fields of a scene:
    bool is_live = false, is_moving = false;  // moving: its drafts alone are made
    int samples = 0, coarse = 1;              // rays a pixel; so many by so many pixels are one
    std::optional<double> subject_m;
    int frames = 1;
    std::vector<std::string> cameras;  // of a file's
    double build_s = 0, render_s = 0;
};
using ShotPointer = std::shared_ptr<const OpenShot>;

// A frame that somebody would like to see.
struct Wish {
    ShotPointer shot;
    Camera camera;
    Look look;
    std::string shown = "result";     // one that is_made()
    std::optional<Rect> region = {};  // in pixels as the data window is
    bool final_quality = false;       // after standard quality
    bool on_cpu = false;              // in place of the session's device
    int coarse = 1;                   // so many by so many pixels are one in its draft
    // Display settings of a draft that may arrive as codes. They do not make a wish different.
    std::optional<DevelopSettings> codes = {};
};
// True if the wishes differ only in region, refinement, first step and its display.
bool same_frame(const Wish& a, const Wish& b);

// One step of it, done.
struct MadeFrame {
    int side = 0;
    std::uint64_t wish = 0;
    int step = 0;
    bool last = false;
    std::optional<Error> error;
    Rect area;             // where its pixels lie
    bool is_part = false;  // they are those of the wish's region
    int coarse = 1;        // so many by so many of them are one
    std::shared_ptr<const Picture> picture;
    std::shared_ptr<const DraftCodes> codes;  // in place of the picture
    std::shared_ptr<const Plane>
        numbers;                         // signed radii in place of the picture, where that is what it holds
    std::shared_ptr<const Plane> radii;  // of the whole data window; with the first step
    std::vector<Panel> panels;
    std::string engine, device, lens;
    Quality quality = Quality::Draft;
    std::vector<StageTime> stages;
    std::vector<std::string> warnings;
    double seconds = 0;
};

struct ReadShot {
    bool is_against = false;
    std::string path;
    ShotPointer shot;  // null: error
    std::optional<Error> error;
};

// Something to be opened.
struct Reading {
    ShotSource source;
    bool is_against = false;
    std::optional<WorldPoint> focus_point = {};  // what its camera is to be focused on, if anything
    std::optional<SceneWish> scene = {};         // in place of the source, as
    std::shared_ptr<const Pushed> pushed = {};   // what came from another program
};

class Warmup;

class Maker {
public:
    // `wake` is called, by the maker's thread, whenever there is news.
    // `cpu_session`: of wishes that are on_cpu, of drafts until the other's device has its programs, and of
    // all once that is lost; null: there is no other.
    // `gl_context`: of sprites of 2009; null: they are not offered.
    Maker(std::shared_ptr<Session> session, std::shared_ptr<Session> cpu_session, GlContext gl_context,
          std::function<void()> wake);
    ~Maker();  // cancels
    Maker(const Maker&) = delete;
    Maker& operator=(const Maker&) = delete;

    void read(Reading reading);
    // Replaces the wish of that side (0, 1); returns its number.
    std::uint64_t make(int side, Wish wish);
    void forget(int side);

    struct News {
        std::vector<ReadShot> shots;
        std::vector<MadeFrame> frames;
        std::vector<std::string> changed;  // files that are no longer what was read
        std::string lost;                  // what was said of the device when it was lost
        double cancel_s = 0;  // the longest from a move to the end of what was being made before it
    };
    News news();
    bool is_idle() const;

private:
    struct Order {
        Wish wish;
        std::uint64_t number = 0;
        int step = 0;
    };
    struct Watched {
        std::string path;
        std::optional<std::filesystem::file_time_type> time;
    };

    void work();
    void interrupt();  // the mutex is held
    void tell(MadeFrame frame);
    void do_reading(const Reading& reading);
    Result<OpenShot> opened(const Reading& reading);
    void watch(const Reading& reading, std::optional<std::filesystem::file_time_type> time);
    void take_up_again(const Reading& reading);
    void do_step(int side, const Order& order);
    MadeFrame made(const Order& order, const Control& control);
    MadeFrame made_somehow(const Order& order, const Control& control);
    Session& session_of(const Wish& wish) const;
    // The device has not drawn with the wish's engine yet: the CPU makes its draft, the rest waits.
    bool is_cold(const Wish& wish) const;
    bool can_be_made(const std::optional<Order>& order) const;
    bool comes_as_codes(const Order& order, const Look& look) const;
    void warm_up();
    Status take_picture(const Order& order, const Rendered& rendered, const Control& control,
                        MadeFrame& frame);
    // A sprite for each pixel; while the camera moves, for each square of pixels that its rays share.
    Status take_sprites(const Order& order, const Rendered& rendered, const Control& control,
                        MadeFrame& frame);
    void look_at_files();
    Result<DefocusReport> shown(const Wish& wish, const Rendered& rendered, const Look& look,
                                const Control& control);

    std::shared_ptr<Session> session_, cpu_session_;
    GlContext gl_context_;
    std::atomic<bool> device_is_lost_ = false;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable something_;
    std::array<std::optional<Order>, 2> orders_;
    std::vector<Reading> readings_;
    News news_;
    std::vector<Watched> watched_;  // of the thread alone, as
    LiveScene scene_;
    std::uint64_t numbers_ = 0;
    std::chrono::steady_clock::time_point interrupted_;
    bool busy_ = false, ending_ = false;
    std::atomic<bool> interrupt_ = false;  // what is being made is no longer the most urgent
    std::unique_ptr<Warmup> warmup_;       // where there is a CPU besides the device
    std::thread thread_;                   // last: it uses all of the above
};

// Contents a side may show: the result, its inputs, buffers of engines. For layers of a shot also kLayer and
// kSharpLayer with name_of(layer).
const std::vector<std::string>& shown_names();
inline const std::string kLayer = "layer:", kSharpLayer = "sharp-layer:";
std::string name_of(const FrameLayer& layer);
// Those that an engine makes; the others are there already.
bool is_made(const std::string& shown);
// Those that are shown whole, whatever is seen of them, as they lie elsewhere than the picture.
bool is_buffer(const std::string& shown);
// Those that the method of 2009 draws; they need an OpenGL context.
bool is_instanced(const std::string& shown);

}  // namespace petzval::view
