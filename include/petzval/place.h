// Position of a picture's pixels in the frame: display window, data window and pixel
// aspect.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"

namespace petzval {

// A point of the frame: -1…1 of half the display window's diagonal, x right, y UP (as lenses are drawn).
struct FieldPosition {
    double x = 0, y = 0;
};

// Maps the pixels of one picture, counted from its own first pixel, to the field.
struct PixelField {
    double field_centre_x = 0, field_centre_y = 0;  // of the display window, in the picture's pixels
    double field_per_px = 0;                        // half diagonals
    double pixel_aspect = 1;

    // Field position of the centre of pixel (x, y).
    FieldPosition field_at(double x, double y) const {
        return {(x + 0.5 - field_centre_x) * field_per_px,
                -(y + 0.5 - field_centre_y) * field_per_px / pixel_aspect};
    }
};

struct Place {                // corners of both windows are from -2^29 to 2^29 px
    Rect display_window;      // the frame, which a viewer shows and the sensor's width spans
    Rect data_window;         // the existing pixels: smaller, larger or offset
    double pixel_aspect = 1;  // width / height of a pixel

    // A picture that is its own frame.
    static Place whole(const Rect& frame, double pixel_aspect = 1) { return {frame, frame, pixel_aspect}; }

    // The frame's height in widths of a pixel, the unit of radii.
    double display_height_px() const { return display_window.height() / pixel_aspect; }
    // More pixels around the same frame.
    Place grown(int by_px) const { return {display_window, data_window.grown(by_px), pixel_aspect}; }
    // True if the frame shows pixels of the picture.
    bool is_in_sight() const { return !data_window.intersected(display_window).empty(); }
    // True if a picture of that size fills the data window.
    bool fits(int width, int height) const {
        return width == data_window.width() && height == data_window.height();
    }
    PETZVAL_API PixelField field() const;

    friend bool operator==(const Place&, const Place&) = default;
};

// The part of the pixels in `data` that `window` shows; `fill` where there are none. Both windows are in
// pixels of the same frame.
template <typename T>
Image<T> through_window(const Image<T>& pixels, const Rect& data, const Rect& window, T fill) {
    Image<T> seen(window.width(), window.height(), fill);
    const Rect shared = data.intersected(window);
    for (int y = shared.y0; y < shared.y1; ++y)
        for (int x = shared.x0; x < shared.x1; ++x)
            seen(x - window.x0, y - window.y0) = pixels(x - data.x0, y - data.y0);
    return seen;
}

// Largest displacement in pixels of visible points by radial distortion (LensChoice::distortion): outward for
// amounts above 0. For amounts below 0 the frame shows points up to that far beyond its edge.
PETZVAL_API int distortion_reach_px(const Place& place, double amount);

// Errors: InvalidArgument for an empty window, a corner beyond 2^29 px, or a pixel aspect beyond 1e-6 to 1e6.
PETZVAL_API Status check(const Place& place);

}  // namespace petzval
