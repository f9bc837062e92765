// A contact sheet: levels of detail of a file beside its finest, each with its figures.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/render/picture.h"

namespace folprom::render {

struct SheetEntry {
  uint32_t layers = 0;
  uint64_t vertices = 0, faces = 0;
  uint64_t bytes = 0;  ///< of the file up to and with these layers
  double bits_per_vertex = 0;
};

struct Sheet {
  Image image;
  std::vector<SheetEntry> entries;  ///< in the order of the pictures
  std::vector<std::string> warnings;
};

/// `options`: of each picture; which level of detail is chosen here. `rates`: bits per vertex of
/// the pictures before the finest; empty: five, as SpreadLevels has them. Errors as Draw has them,
/// and kUsage where the file is no .folp file.
Sheet DrawSheet(const std::string& path, const PictureOptions& options,
                std::span<const double> rates, parallel::Runner& runner,
                parallel::Progress& progress);

/// Pixels of a sheet of so many pictures.
uint64_t SheetPixels(const PictureOptions& options, size_t pictures);

}  // namespace folprom::render
