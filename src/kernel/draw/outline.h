// The outline of the pupil: blades, squeeze, and the barrel's circles, as one closed convex polygon.
//
// Coordinates are those of the f-stop's unit disc in PIXEL orientation (x right, y DOWN), upright as the far
// disc shows it. Curves are drawn as chords so short that on the image they leave the arc by `tolerance`.
#pragma once

#include "petzval/lens_choice.h"

#include "kernel/model/coverage.h"

#include <vector>

namespace petzval::kernel {

// A rim that cuts the pupil, in pupil radii.
struct Circle {
    Point centre;
    double radius = 1;
};

// The f-stop itself: a disc, or a polygon inscribed in the unit circle whose sides bulge by
// `curvature` times the sagitta of the circle; then squeezed so that it stays inside the unit disc.
// Source: docs/reference/lens-files.md, "Shapes and scale". tolerance: largest distance of a chord from its
// arc, pupil radii.
std::vector<Point> aperture_outline(const ApertureShape& shape, double tolerance);

// The part of a convex outline inside a circle; order and convexity are kept. Empty if nothing is inside.
std::vector<Point> clipped(const std::vector<Point>& outline, const Circle& circle, double tolerance);

// The part of one convex outline inside another; both turn from +x to +y.
std::vector<Point> clipped(const std::vector<Point>& outline, const std::vector<Point>& inside);

double area(const std::vector<Point>& outline);  // signed: positive when the turn is from +x to +y
Point centroid(const std::vector<Point>& outline);

}  // namespace petzval::kernel
