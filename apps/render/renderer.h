// From a scene to a picture: who is seen in each pixel, and how bright.
#pragma once

#include "apps/render/camera.h"
#include "apps/render/image.h"
#include "apps/render/scene.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::render {

struct Style {
  bool wireframe = false;    ///< draws the edges of the faces on top
  bool transparent = false;  ///< where nothing is seen; else white
};

/// Flat shading, so that the faces of a coarse mesh show: grey clay below an overcast sky, both
/// sides of a face alike. Same result for every runner. Throws Cancelled.
Image Render(const Scene& scene, const Camera& camera, const Style& style, parallel::Runner& runner,
             parallel::Progress& progress);

}  // namespace folprom::render
