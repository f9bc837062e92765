// From a file to a picture of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/render/camera.h"
#include "apps/render/image.h"
#include "apps/render/renderer.h"
#include "folprom/settings.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::render {

struct PictureOptions {
  uint32_t width = 1280, height = 960;  ///< pixels, at least 1
  View view;
  Style style;
  /// What the picture is to show, so that several share one view; else the box of the file's
  /// original.
  std::optional<Box> box;
  /// Of a .folp file: the level of detail. Of all files: the folder for temporary files, and the
  /// memory that may be used.
  DecodeOptions decode;
};

struct Picture {
  Image image;
  Box box;                           ///< that was looked at
  uint64_t vertices = 0, faces = 0;  ///< of the mesh
  std::vector<std::string> warnings;
};

/// Draws a scan or a .folp file. Same picture for every runner. Throws Failure: kInput, kCorrupt,
/// kOutput (temporary files), kLimit (memory); and Cancelled.
Picture Draw(const std::string& path, const PictureOptions& options, parallel::Runner& runner,
             parallel::Progress& progress);

}  // namespace folprom::render
