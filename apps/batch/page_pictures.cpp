#include "apps/batch/page_pictures.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <string_view>

#include "apps/folprom/report.h"
#include "apps/render/levels.h"
#include "apps/render/picture.h"
#include "apps/render/png_code.h"
#include "engine/measure/triangle_mesh.h"
#include "folprom/folprom.h"
#include "folprom/result.h"
#include "io/files/atomic_file.h"
#include "io/files/mapped_file.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;
using cli::BytesShort;
using cli::Grouped;

constexpr size_t kLevels = 3;

class Artist {
 public:
  Artist(const PictureSettings& settings, HashCache* hashes, parallel::Runner& runner,
         parallel::Progress& progress)
      : settings_(settings), hashes_(hashes), runner_(runner), progress_(progress) {
    std::error_code error;
    fs::create_directories(settings.folder, error);
    if (error) throw Failure(ErrorKind::kOutput, settings.folder + ": " + error.message());
  }

  std::vector<PagePicture> PicturesOf(const ScanResults& scan) {
    const OperationResult& first = *scan.operations.front();
    std::vector<PagePicture> pictures;
    std::optional<render::Box> box;
    std::string folp_hash;
    uint64_t vertices = first.operation == Operation::kDecode ? 0 : first.vertices;
    const bool encoded = std::any_of(scan.operations.begin(), scan.operations.end(),
                                     [](const auto* result) { return IsThere(*result); });
    if (encoded && !first.folp.empty()) {
      Guarded(first.folp, &pictures, [&] {
        const FileInfo info = ReadInfo(first.folp).value();
        box = render::Box{info.box_lo, info.box_hi};
        vertices = info.vertices;
        folp_hash = hashes_->Get(first.folp, progress_).hash;
        AddLevels(first, info, folp_hash, &pictures);
      });
    }
    Guarded(first.input, &pictures,
            [&] { pictures.push_back(Whole(first.input, vertices, box, folp_hash)); });
    return pictures;
  }

  // Pictures that no scan has any more.
  void RemoveOthers() const {
    std::error_code ignored;
    std::vector<fs::path> others;
    for (const auto& entry : fs::directory_iterator(settings_.folder, ignored)) {
      const fs::path& path = entry.path();
      if (path.extension() == ".png" && !used_.contains(path.filename().string())) {
        others.push_back(path);
      }
    }
    for (const fs::path& path : others) fs::remove(path, ignored);
  }

 private:
  // What goes wrong with one picture is told in its place.
  template <class Work>
  void Guarded(const std::string& path, std::vector<PagePicture>* pictures, const Work& work) {
    const auto tell = [&](const std::string& problem) {
      pictures->push_back({fs::path(path).filename().string(), "", {}, problem});
    };
    try {
      work();
    } catch (const Failure& failure) {
      tell(failure.error().message);
    } catch (const parallel::Cancelled&) {
      tell("not drawn, the batch was interrupted");
    } catch (const std::bad_alloc&) {
      tell("not drawn, out of memory");
    }
  }

  void AddLevels(const OperationResult& result, const FileInfo& info, const std::string& hash,
                 std::vector<PagePicture>* pictures) {
    for (const uint32_t layers : render::SpreadLevels(info, kLevels)) {
      const LayerInfo& layer = info.layers[layers - 1];
      render::PictureOptions options = Options();
      options.decode.layers = layers;
      PagePicture picture;
      picture.title = Grouped(layer.vertices) + " vertices";
      picture.caption = fmt::format("{:.2f} bits per vertex, {}", layer.bits_per_vertex,
                                    BytesShort(layer.end_byte));
      picture.png = Png(result.folp, options, fmt::format("{}-{}", hash, layers));
      pictures->push_back(std::move(picture));
    }
  }

  // The scan, or of a job without scans all of its .folp file.
  PagePicture Whole(const std::string& input, uint64_t vertices,
                    const std::optional<render::Box>& box, const std::string& folp_hash) {
    render::PictureOptions options = Options();
    options.box = box;
    const std::string whole = measure::IsFolp(input) ? "the whole file" : "the scan itself";
    PagePicture picture;
    picture.title = vertices > 0 ? Grouped(vertices) + " vertices" : whole;
    picture.caption = vertices > 0 ? whole : "";
    // The box, and with it the view, is that of the .folp file, which has rounded it.
    picture.png =
        Png(input, options, fmt::format("{}-{}", hashes_->Get(input, progress_).hash, folp_hash));
    return picture;
  }

  render::PictureOptions Options() const {
    render::PictureOptions options;
    options.width = settings_.width;
    options.height = settings_.height;
    options.style.transparent = true;
    options.decode.temporary_folder = settings_.temporary_folder;
    options.decode.limits.memory_bytes = settings_.memory_bytes;
    return options;
  }

  // From the folder, or drawn and kept there.
  std::vector<uint8_t> Png(const std::string& path, const render::PictureOptions& options,
                           const std::string& key) {
    const std::string name =
        fmt::format("{}-{}x{}-{}.png", FOLPROM_VERSION, settings_.width, settings_.height, key);
    const std::string kept = settings_.folder + "/" + name;
    used_.insert(name);
    if (auto png = Kept(kept)) return *png;
    const std::vector<uint8_t> png =
        render::PngOf(render::Draw(path, options, runner_, progress_).image);
    const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
    io::WriteWholeFile(kept, bytes, true).value();
    return png;
  }

  static std::optional<std::vector<uint8_t>> Kept(const std::string& path) {
    constexpr std::array<uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return std::nullopt;
    auto file = io::MappedFile::Open(path);
    if (!file) return std::nullopt;
    const auto bytes = file->bytes();
    if (bytes.size() < kPng.size() || !std::equal(kPng.begin(), kPng.end(), bytes.begin())) {
      return std::nullopt;
    }
    return std::vector<uint8_t>(bytes.begin(), bytes.end());
  }

  const PictureSettings& settings_;
  HashCache* hashes_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  std::set<std::string> used_;
};

}  // namespace

std::vector<std::vector<PagePicture>> PicturesOf(const std::vector<ScanResults>& scans,
                                                 const PictureSettings& settings, HashCache* hashes,
                                                 parallel::Runner& runner,
                                                 parallel::Progress& progress) {
  Artist artist(settings, hashes, runner, progress);
  std::vector<std::vector<PagePicture>> pictures;
  for (const ScanResults& scan : scans) pictures.push_back(artist.PicturesOf(scan));
  artist.RemoveOthers();
  return pictures;
}

}  // namespace folprom::batch
