// Pictures of small meshes, drawn and looked at.
#pragma once

#include <string>

#include "apps/render/picture.h"
#include "engine/measure/triangle_mesh.h"
#include "parallel/runner.h"

namespace folprom::render {

/// A sphere of 2 rings^2 vertices around the origin.
measure::TriangleMesh Ball(double radius, uint32_t rings);

/// Drawn in its own box on a serial runner unless another is given.
Image PictureOf(const measure::TriangleMesh& mesh, const Style& style = {},
                parallel::Runner* runner = nullptr, uint32_t width = 96, uint32_t height = 72);

/// Options for small pictures.
PictureOptions Small(uint32_t width = 96, uint32_t height = 72);

/// Draws a file on a serial runner.
Picture DrawFile(const std::string& path, const PictureOptions& options);

/// Pixels that are not white.
size_t InkedPixels(const Image& image);
/// Mean of |difference| of grey, of two pictures of one size.
double Difference(const Image& a, const Image& b);

}  // namespace folprom::render
