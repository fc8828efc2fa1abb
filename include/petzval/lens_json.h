// The numbers of a lens as JSON text, for hosts that are not C++.
//
// Names carry units. Unknown values are null; infinity is written as 1e999, valid JSON that readers take as
// infinity.
#pragma once

#include "petzval/export.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_kernel.h"
#include "petzval/lens_section.h"

#include <string>
#include <vector>

namespace petzval {

// The facts as in `petzval lens show --json`, without the keys about the run: the lens, its format, notes,
// warnings, first-order numbers, Seidel sums, focus of each zone and wavelength, numbers over the field.
PETZVAL_API std::string lens_facts_json(const LensFacts& facts);
// An array as in `petzval lens list --json`.
PETZVAL_API std::string lens_list_json(const std::vector<LensSummary>& lenses);
// The curves among the facts: {"longitudinal_aberration_mm": …, "field": […]}, as in lens_facts_json().
PETZVAL_API std::string lens_curves_json(const LensFacts& facts);
// The camera and the picture that a lens is mounted for.
PETZVAL_API std::string lens_mount_json(const LensMount& mount);
// The header of an atlas, atlas.json (docs/reference/lens-atlas.md), on one line. `name`: the lens as
// requested.
PETZVAL_API std::string lens_atlas_json(const LensAtlas& atlas, const std::string& name,
                                        const LensMount& mount);
// Glass as closed outlines, rays as paths: points are [z_mm, y_mm].
PETZVAL_API std::string lens_section_json(const LensSection& section);

}  // namespace petzval
