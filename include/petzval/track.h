// Values of a shot that change from frame to frame: focus, aperture, zoom, any number of the look. Component
// petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace petzval {

// Values of a track for one frame; unset values are the file's or the user's.
struct TrackedFrame {
    CameraChoice camera;
    std::optional<PixelPosition> focus_pixel;  // the focus is at its depth in this frame
    std::optional<WorldPoint> focus_point;
    std::map<std::string, std::string> look;  // fields by path, values as look_with() takes them
    bool is_between_keys = false;             // true if the focus moves between its keys
};

// Keys of a look and of focus at some frames, and the interpolation between them. Distances are
// interpolated linearly in dioptres, f-numbers in stops, other numbers linearly; any other value stays
// until its next key. Before the first key and after the last one, the values of that key apply.
//
// In a CSV file, the first line that is not empty names the columns, '#' begins a comment, and an empty value
// sets no key. A JSON file has the same names: {"frames": [{"frame": 1001, "focus": 3.2}, …]}. The names are
// frame; focus (metres; inf), or focus_x and focus_y (a pixel of the display window), or point_x, point_y and
// point_z (the world, in scene units); follow; fstop; focal_length (mm); and any field of a look by its path,
// as lens.blades.
//
// A focus pixel refers to its own key frame: its depth is measured there (measured_at, set_focus), and
// between keys the focus moves linearly in dioptres. While follow is on, until the next key that turns it
// off, the pixel itself moves from key to key, and every frame is focused on the surface that it shows there.
// Use follow for a tracked object, not for a rack, because anything may lie between two pixels.
class PETZVAL_API Track {
public:
    // Errors: InvalidFile with the path and the line or the key: missing, damaged, an unknown column, a frame
    // twice, a value that is not a number where one is needed, no key at all.
    static Result<Track> read(const std::string& path);

    // A rack: "1001:80,45" is a pixel in a frame, "1024:3.2" a distance in metres. Errors: InvalidArgument.
    static Result<Track> rack(const std::vector<std::string>& keys);
    // Focus distances in metres by frame. Requires: a key, all above 0.
    static Track of_focus(const std::map<int, double>& distances_m);
    // Adds the values of another track. Errors: InvalidArgument if both change the same value.
    Status add(Track other);

    // The pixels whose depth is needed for these frames, by the frame in which it is measured.
    std::map<int, PixelPosition> measured_at(std::span<const int> frames) const;
    // Sets their depths in metres. Until then such pixels are followed.
    void set_focus(const std::map<int, double>& distances_m);

    TrackedFrame at(int frame) const;
    // The focus moves slowly near its keys and faster between them.
    void ease_focus();
    // Limits the focus change from frame to frame, in dioptres; the focus arrives late if its keys are
    // faster. Only for tracks of focus distances. Requires: > 0.
    void limit_focus_speed(double dioptres_per_frame);
    // Frames of the first key and of the last.
    int first() const { return first_; }
    int last() const { return last_; }

private:
    struct Column {
        std::string name;
        std::map<int, std::string> keys;  // as written
        std::map<int, double> numbers;    // on the scale of the interpolation; empty: no numbers
    };
    static std::optional<double> number_at(const Column& column, int frame);
    const Column* find(const std::string& name) const;
    std::optional<PixelPosition> pixel_at(int frame) const;
    bool follows(int frame) const;

    std::vector<Column> columns_;
    int first_ = 0, last_ = 0;
    bool is_measured_ = false;  // set_focus() was called
    bool is_moving_ = false;    // ease_focus() or limit_focus_speed(): the focus has a number in each frame
    friend class TrackReader;
};

// The source of one frame, with the number filled into every path.
PETZVAL_API ShotSource at_frame(ShotSource source, int frame);

// Measures the pixels of Track::measured_at(), each in its own frame of the shot; paths of the source may
// contain a frame number. Errors: those of read_shot() and focus_on_pixel(), with the frame and the pixel.
PETZVAL_API Status measure_focus(Track& track, std::span<const int> frames, const ShotSource& source,
                                 const Control& control = {});

}  // namespace petzval
