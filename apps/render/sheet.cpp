#include "apps/render/sheet.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/folprom/report.h"
#include "apps/render/caption.h"
#include "apps/render/levels.h"
#include "engine/measure/triangle_mesh.h"
#include "folprom/folprom.h"
#include "folprom/result.h"

namespace folprom::render {
namespace {

constexpr size_t kLevels = 5;

// Pixels.
constexpr uint32_t kMargin = 16;
constexpr uint32_t kLine = kLetterHeight + 4;
constexpr uint32_t kCaption = 2 * kLine + 4;
constexpr uint32_t kTitle = 2 * kLine;

constexpr uint8_t kDark = 30, kPale = 105;

SheetEntry EntryOf(const FileInfo& info, uint32_t layers) {
  const LayerInfo& layer = info.layers[layers - 1];
  return {layers, layer.vertices, layer.faces, layer.end_byte, layer.bits_per_vertex};
}

// Where the pictures lie: in one row up to three, else in two.
struct Grid {
  Grid(const PictureOptions& options, size_t pictures)
      : columns(static_cast<uint32_t>(pictures <= 3 ? pictures : (pictures + 1) / 2)),
        cell_width(options.width + kMargin),
        cell_height(options.height + kCaption + kMargin) {
    const auto rows = static_cast<uint32_t>((pictures + columns - 1) / columns);
    width = kMargin + columns * cell_width;
    height = kMargin + kTitle + rows * cell_height;
  }
  uint32_t Left(size_t index) const {
    return kMargin + static_cast<uint32_t>(index % columns) * cell_width;
  }
  uint32_t Top(size_t index) const {
    return kMargin + kTitle + static_cast<uint32_t>(index / columns) * cell_height;
  }

  uint32_t columns, cell_width, cell_height;
  uint32_t width = 0, height = 0;
};

void Copy(const Image& from, uint32_t left, uint32_t top, Image* to) {
  for (uint32_t y = 0; y < from.height(); ++y) {
    for (uint32_t x = 0; x < from.width(); ++x) to->At(left + x, top + y) = from.At(x, y);
  }
}

void WriteTitle(const std::string& path, const FileInfo& info, const Grid& grid, Image* image) {
  const uint32_t room = grid.width - 2 * kMargin;
  const std::string name = std::filesystem::path(path).filename().string();
  Write(image, kMargin, kMargin, Fitted(name, room), kDark);
  const std::string figures = fmt::format("{} vertices, {} faces, {}", cli::Grouped(info.vertices),
                                          cli::Grouped(info.faces), cli::BytesShort(info.bytes));
  const auto used = static_cast<uint32_t>(Fitted(name, room).size() + 2) * kLetterWidth;
  if (used < room) Write(image, kMargin + used, kMargin, Fitted(figures, room - used), kPale);
}

void WriteCaption(const SheetEntry& entry, bool whole, uint32_t width, uint32_t left, uint32_t top,
                  Image* image) {
  const std::string vertices =
      cli::Grouped(entry.vertices) + " vertices" + (whole ? ", the whole mesh" : "");
  const std::string rate = fmt::format("{:.2f} bits per vertex, {}", entry.bits_per_vertex,
                                       cli::BytesShort(entry.bytes));
  Write(image, left, top, Fitted(vertices, width), kDark);
  Write(image, left, top + kLine, Fitted(rate, width), kPale);
}

}  // namespace

uint64_t SheetPixels(const PictureOptions& options, size_t pictures) {
  const Grid grid(options, pictures);
  return uint64_t{grid.width} * grid.height;
}

Sheet DrawSheet(const std::string& path, const PictureOptions& options,
                std::span<const double> rates, parallel::Runner& runner,
                parallel::Progress& progress) {
  if (!measure::IsFolp(path)) {
    throw Failure(ErrorKind::kUsage,
                  path + ": is no .folp file; a sheet shows the levels of detail of one");
  }
  const FileInfo info = ReadInfo(path, options.decode.limits).value();
  Sheet sheet;
  const auto finest = static_cast<uint32_t>(std::min(info.layers_present, info.layers.size()));
  std::vector<uint32_t> levels =
      rates.empty() ? SpreadLevels(info, kLevels) : LevelsAt(info, rates);
  std::erase(levels, finest);
  levels.push_back(finest);
  for (const uint32_t layers : levels) sheet.entries.push_back(EntryOf(info, layers));

  const Grid grid(options, levels.size());
  sheet.image = Image(grid.width, grid.height);
  WriteTitle(path, info, grid, &sheet.image);
  for (size_t i = 0; i < levels.size(); ++i) {
    PictureOptions each = options;
    each.decode.layers = levels[i];
    Picture picture = Draw(path, each, runner, progress);
    Copy(picture.image, grid.Left(i), grid.Top(i), &sheet.image);
    const bool whole = levels[i] == info.layers_total;
    WriteCaption(sheet.entries[i], whole, options.width, grid.Left(i),
                 grid.Top(i) + options.height + 4, &sheet.image);
    // Of the finest; it has those of all others.
    if (i + 1 == levels.size()) sheet.warnings = std::move(picture.warnings);
  }
  return sheet;
}

}  // namespace folprom::render
