// The neighbours of the frames of a run: how they are read, what they see, and whether that can be known at
// all.
#pragma once

#include "petzval/neighbours.h"
#include "petzval/shot_run.h"

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace petzval::sequence {

// Surfaces that each frame hides and its neighbouring frames show, for each view separately.
class ShotNeighbours {
public:
    // The settings of a frame; outlives this.
    using OfFrame = std::function<Result<ShotRunSettings>(int frame)>;
    // Errors: those of listing the files.
    static Result<std::shared_ptr<ShotNeighbours>> make(const ShotRunSettings& settings, OfFrame of_frame,
                                                        std::function<bool()> cancelled);

    // Pictures that a frame is made of beside its own: where they are newer than it, it is made again.
    std::vector<std::string> files_near(int frame) const;
    Result<SeenElsewhere> behind(const Shot& shot, int frame, Workers& workers,
                                 std::span<const Shot* const> eyes);

private:
    Result<Shot> read(int frame, const std::string& view) const;

    std::vector<int> frames_;
    OfFrame of_frame_;
    std::function<bool()> cancelled_;
    int each_side_ = 0;
    std::size_t max_memory_bytes_ = 0;
    bool all_views_ = false;
    MotionReading::From from_ = MotionReading::From::File;
    std::map<std::string, std::unique_ptr<Neighbours>> of_view_;
};

// Errors: InvalidArgument where the frame has neither a camera nor vectors, by which its neighbours could be
// moved, or not the layer of vectors that is named.
Status check_motion(const ShotRunSettings& of_frame);

}  // namespace petzval::sequence
