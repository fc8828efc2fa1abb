// Small letters drawn into a picture.
#pragma once

#include "petzval/image.h"

#include <string>

namespace petzval::cli {

int text_width_px(const std::string& text, int scale);
int text_height_px(int scale);

// The top left corner is at (x0, y0); what lies outside the picture is not drawn. scale >= 1 magnifies.
void draw_text(View<Rgba> picture, int x0, int y0, const std::string& text, int scale, Rgba colour);

}  // namespace petzval::cli
