// Test pictures, and their pixels in a frame at its render scale.
#pragma once

#include "effect.h"

namespace ofx_check {

// A picture with edges, ramps and bright points; every clip has another one.
Picture scene(const ofx::RectI& bounds, int channels, unsigned seed);

ofx::RectI scaled(const ofx::RectI& bounds, ofx::Point scale);
Picture scaled(const Picture& picture, ofx::Point scale);
ofx::RectI scaled_region(const ofx::Effect& effect, const ofx::Clip& clip);
// The picture that a clip gives for the frame under way.
Picture input_of(const ofx::Effect& effect, const ofx::Clip& clip);
int output_channels(const ofx::Effect& effect);
Depth depth_of(const ofx::Effect& effect);
const char* components_name(int channels);

// The part of a picture within a rectangle; 0 outside of the picture.
Picture part_of(const Picture& picture, const ofx::RectI& part);
// The same bits in all pixels.
bool same(const Picture& a, const Picture& b);
std::string first_difference(const Picture& a, const Picture& b);
double mean_difference(const Picture& a, const Picture& b);

}  // namespace ofx_check
