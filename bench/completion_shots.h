// Pictures whose hidden parts have to be guessed, with their truth: what `./dev bench completion` judges by.
#pragma once

#include "petzval/camera.h"
#include "petzval/deep.h"
#include "petzval/image.h"

#include <string>
#include <vector>

namespace petzval::bench {

struct Still {
    DeepPicture hidden;  // every hidden surface of the scene, if requested
    Picture sharp, truth;
    Plane depth_m;
    Image<unsigned char> counts;  // 1: in reach of the blur of a silhouette, where hidden surfaces show
    Camera camera;
    std::string sharp_file, truth_file;
};

struct CompletionShot {
    std::vector<Still> frames;  // three in a row of built-in scenes that move and of two seeds in five
    float exposure = 1;         // at which it is compared
};

// `name`: the number of a seed of the scene `random` (320 x 180), a built-in scene (the same size), or
// branch:TILT:FSTOP (branch.h). Sharp pictures and truths lie in `folder` and are made where they are
// missing. Ends the program with one line where the name is unknown or a file cannot be read or written.
// with_hidden: also renders the hidden layers. A branch has none: the program ends with one line.
CompletionShot completion_shot(const std::string& name, const std::string& folder, bool with_hidden);

// Pixels that a silhouette's blur reaches: discs of the larger of both radii around every step of depth of
// more than a tenth.
Image<unsigned char> silhouettes_reach(const Plane& depth_m, const Camera& camera);

}  // namespace petzval::bench
