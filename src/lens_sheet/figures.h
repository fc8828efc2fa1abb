// Every figure of the page, one function each. Files are named after the topic.
#pragma once

#include "lens_sheet/figure.h"
#include "lens_sheet/light.h"

#include <optional>

namespace petzval::lens_sheet {

// cross_section.cpp
Figure cross_section(const Subject& subject);

// along_axis.cpp
Figure zone_curves(const Subject& subject);
Figure colour_curve(const Subject& subject);
Figure axial_fan(const Subject& subject);
Figure rays_near_focus(const Subject& subject, int wavelengths);
std::string small_rays(const Subject& subject);  // the same without axes, for sheets of many lenses

// ray_fan_figures.cpp; empty without a prescription
std::vector<Figure> ray_fan_figures(const Subject& subject);
// field_curves.cpp; empty without a prescription and a field
std::vector<Figure> field_curves(const Subject& subject);
// seidel_figures.cpp; empty without a prescription
std::vector<Figure> seidel_figures(const Subject& subject);

// texture_figures.cpp
Figure bokeh_textures(const Subject& subject);
Figure squared_column(const Subject& subject);

// disc_strip.cpp
// A disc somewhat in front of focus and one behind, 208 by 104, with so many pixels each.
std::string disc_pair(const Subject& subject, int disc_px);
Figure disc_strip(const Subject& subject);
Figure line_strip(const Subject& subject);
// control_ring.cpp; none where the lens cannot be turned
std::optional<Figure> control_ring(const Subject& subject);

// field_discs.cpp
std::vector<Figure> field_discs(const Subject& subject);
// coma_principle.cpp; of lenses that are drawn
Figure coma_principle(const Subject& subject);

// spot_figures.cpp
Figure spot_diagrams(const Subject& subject);

// mtf_figure.cpp
std::vector<Figure> mtf_figures(const Subject& subject);

// wave_figures.cpp
std::vector<Figure> wave_figures(const Subject& subject);

// image_formation.cpp
std::vector<Figure> image_formation(const Subject& subject);
// blur_by_distance.cpp: the circle of confusion, labelled, and its size by distance
std::vector<Figure> blur_by_distance(const Subject& subject);
// sum_of_discs.cpp; none where the lens takes no blades
std::optional<Figure> sum_of_discs(const Subject& subject);

// number_tables.cpp
std::string header_of(const Subject& subject);
std::vector<Figure> number_tables(const Subject& subject);

}  // namespace petzval::lens_sheet
