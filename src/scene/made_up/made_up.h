// The scene `random`: a seed decides place, camera and palette first; then one function builds each part.
//
// Sizes go with the frame at the subject's distance, so a seed may be a still life or a street: only widths
// in pixels and ratios of distances matter to a lens.
#pragma once

#include "petzval/camera.h"

#include "scene/dice.h"
#include "scene/world.h"

#include <array>

namespace petzval::scene {

enum class Setting { Street, Dusk, Night, Room, Garden, Studio, Wall };
constexpr int kSettings = 7;

struct Palette {
    std::array<Vec3, 3> walls;   // quiet
    std::array<Vec3, 6> things;  // the last one is loud
};

struct MadeUp {
    std::uint64_t seed = 0;
    Setting setting = Setting::Street;
    Palette palette;
    Camera camera;
    Viewpoint view;                             // at time 0
    float tan_x = 0, tan_y = 0;                 // of half the angle of view
    float subject_m = 0;                        // its distance
    float frame_m = 0;                          // the height of the frame there
    float near_m = 0;                           // of the nearest thing
    float back_m = 0;                           // of the background
    Vec3 ground{0, 0, 0};                       // a point below the camera, at the height of the floor
    float slope_x = 0, slope_z = 0;             // of the floor
    Vec3 move{0, 0, 0}, subject_move{0, 0, 0};  // of the camera and of one thing, first to last frame, m

    Dice dice(std::uint32_t part) const { return {seed, part}; }
    // In the first frame: u and v -1…1 from edge to edge of a frame of 16:9, v upwards; planar depth z.
    Vec3 at(float u, float v, float z) const {
        return view.position + view.to_world({u * tan_x * z, v * tan_y * z, z});
    }
    Vec3 on_floor(float x, float z) const {
        return {x, ground.y + slope_x * (x - ground.x) + slope_z * (z - ground.z), z};
    }
    // The place on the floor below u, about z away.
    Vec3 foot(float u, float z) const {
        const Vec3 p = at(u, 0, z);
        return on_floor(p.x, p.z);
    }
    bool is_dark() const { return setting == Setting::Dusk || setting == Setting::Night; }
};

// Parts of a seed, for dice().
enum MadeUpPart : std::uint32_t { kShotPart = 1, kPlacePart, kThingsPart, kNearPart, kLampsPart, kPaintPart };

MadeUp made_up(std::uint64_t seed);

// Texture coordinates of a surface: a uv of 1 is so many times its size. Without uv the pattern is
// cut from a block of it.
struct Surface {
    Vec3 origin;
    float size_m = 1;
    float u_sizes = 1, v_sizes = 1;
    bool has_uv = true;
};
// A pattern of one or two colours of the palette, at most as fine as a sixtieth of the size.
Paint made_up_paint(Dice& dice, const Palette& palette, const Surface& surface);
Paint plain_paint(Vec3 albedo);
// Letters of a script nobody reads, on a board with uv 0…1, `columns` of them to a line.
Paint print_paint(Dice& dice, Vec3 back, Vec3 ink, float columns, float lines, float glow);

void add_place(World& world, const MadeUp& shot);  // light, sky, floor, background
void add_subject(World& world, const MadeUp& shot,
                 float time);                     // in the middle distance, with what stands about
void add_near(World& world, const MadeUp& shot);  // before it, cut by the frame or across it
void add_lamps(World& world, const MadeUp& shot);

// A thing of some kind, standing; `foot` is where, height in metres.
void add_thing(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height);
void add_person(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height);

}  // namespace petzval::scene
