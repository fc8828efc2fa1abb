// The numbers of a lens as JSON text, for hosts that are not C++.
//
// Names carry units. What is unknown is null; infinity is written as 1e999, valid JSON that readers take as
// infinity.
#pragma once

#include "petzval/export.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_section.h"

#include <string>
#include <vector>

namespace petzval {

// The facts as in `petzval lens show --json`, without the keys about the run: the lens, its format, notes,
// warnings, first-order numbers, Seidel sums, focus of each zone and wavelength, numbers over the field.
PETZVAL_API std::string lens_facts_json(const LensFacts& facts);
// An array, as `petzval lens list --json` has it.
PETZVAL_API std::string lens_list_json(const std::vector<LensSummary>& lenses);
// The curves among the facts: {"longitudinal_aberration_mm": …, "field": […]}, as in lens_facts_json().
PETZVAL_API std::string lens_curves_json(const LensFacts& facts);
// Glass as closed outlines, rays as paths: points are [z_mm, y_mm].
PETZVAL_API std::string lens_section_json(const LensSection& section);

}  // namespace petzval
