// Sizes of tiles and batches, shared by plans, the CPU and the GPU's programs. C++ and GLSL both read this
// file. A program with another size than its plan would write beyond its buffers.
#ifndef PETZVAL_LAWS_TILES
#define PETZVAL_LAWS_TILES
#include "laws/language.h"
PETZVAL_LAWS_BEGIN

PETZVAL_LAW int kGroupSide = 16;  // a group of invocations on a GPU draws a square of pixels or cells
PETZVAL_LAW int kGroup = kGroupSide * kGroupSide;

PETZVAL_LAW int kScatterTile = 64;   // pixels on a side
PETZVAL_LAW int kScatterBorder = 2;  // cells around a tile that enlarging reads, by cubics

PETZVAL_LAW int kGatherTile = 128;
PETZVAL_LAW int kGatherBorder = 1;  // by tents

// Lights that are drawn by themselves: dimmed tap by tap, or stamped on the cells of levels. One program of a
// GPU draws tiles of the first and blocks of the second.
PETZVAL_LAW int kLightsTile = 64;
PETZVAL_LAW int kStampedTile = 256;
PETZVAL_LAW int kStampedBlock = kLightsTile;  // cells of a level
PETZVAL_LAW int kStampedBorder = 1;

// A light's mask of the pupil has so many points on a side.
PETZVAL_LAW int kMaskSide = 8;

PETZVAL_LAWS_END
#endif
