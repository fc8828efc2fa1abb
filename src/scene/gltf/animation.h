// Animations of a glTF file: where its nodes are at a time.
#pragma once

#include "petzval/result.h"

#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace petzval::scene {

// Puts translations, rotations and scales of the model's nodes to where its animations have them, all played
// at once from 0; of two that move the same thing the first. Before its first key and after its last a node
// stays. Steps, lines (rotations along the arc) and cubic splines, as glTF 2.0 has them, appendix C. Returns
// when the last of them ends, s; 0 where nothing moves. Errors: InvalidFile with the path.
Result<double> pose(tinygltf::Model& model, double at_s, const std::string& path,
                    std::vector<std::string>& warnings);

}  // namespace petzval::scene
