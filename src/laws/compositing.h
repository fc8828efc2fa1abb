// Numbers of compositing that engines, the CPU's loops and the GPU's programs share. C++ and GLSL both read
// this file: it holds constants alone, and comments.
#ifndef PETZVAL_LAWS_COMPOSITING
#define PETZVAL_LAWS_COMPOSITING
#include "laws/language.h"
PETZVAL_LAWS_BEGIN

// Layers are intervals of signed radius, nearest first (engine/samples/layers.h). Each is followed by a layer
// for the emptiness at its depth.
PETZVAL_LAW int kEmptinessAfter = 1;
PETZVAL_LAW int kNextLayer = 2;
// Two samples of a pixel with at least so many layers between them belong to different surfaces.
PETZVAL_LAW int kAnotherSurface = 6;
PETZVAL_LAW int kEmptyLayer = 0x7fffffff;  // emptiness behind everything

// A pixel with less of its lens free is full: discrete sources of an opaque surface leave so much.
PETZVAL_LAW float kSpent = 0.002f;

// The areas of six sectors add up to 1 within this: alpha as close to 1 is 1, so opaque stays opaque.
PETZVAL_LAW float kOpaqueRounding = 1e-6f;

// A sample this close in radius to light that passes it is at the light's own depth and does not dim it.
PETZVAL_LAW float kSameDepthPx = 0.02f;

// A gathered pixel with less lens area covered by a surface is not covered by it.
PETZVAL_LAW float kLeastGathered = 1e-6f;
// A blurred layer of engine gaussian with less area at a pixel has no colour there.
PETZVAL_LAW float kLeastBlurred = 1e-5f;

PETZVAL_LAWS_END
#endif
