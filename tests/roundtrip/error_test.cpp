#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/folp_file.h"
#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/surface_distance.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

/// Mean distance of every `step`-th vertex of the original from each LOD.
std::vector<double> MeanErrors(const Mesh& original, const std::string& folp, size_t step) {
  std::vector<double> means;
  std::vector<uint8_t> bytes = FileBytes(folp);
  MemoryDecoder decoder = MemoryDecoder::Open(bytes).value();
  while (means.size() < decoder.layer_count()) {
    decoder.DecodeNextLayer().value();
    Mesh lod = decoder.Mesh();
    SurfaceDistance distance(lod);
    double sum = 0;
    size_t samples = 0;
    for (size_t v = 0; v < original.positions.size(); v += step, ++samples) {
      sum += distance.To(original.positions[v]);
    }
    means.push_back(sum / static_cast<double>(samples));
  }
  return means;
}

/// Every layer is nearer than the one before, and the last that splits sets lies within
/// `largest_after_splits`, in the mesh's units. Returns the part of that error that the last layer
/// leaves.
double ExpectErrorFalls(const Mesh& original, const std::string& scan, const EncodeOptions& options,
                        size_t step, double largest_after_splits) {
  TemporaryFolder folder;
  std::string folp = folder.File("scan.folp");
  Encode(scan, folp, options);
  size_t split_layers = FolpFile(folp).parameters().schedule.split_layers();
  std::vector<double> means = MeanErrors(original, folp, step);
  for (size_t layer = 1; layer < means.size(); ++layer) {
    EXPECT_LE(means[layer], means[layer - 1] * 1.01)
        << "from layer " << layer - 1 << " to " << layer << " of " << means.size() << ", "
        << split_layers << " of which split";
  }
  EXPECT_LT(means[split_layers - 1], largest_after_splits);
  return means.back() / means[split_layers - 1];
}

class ErrorTest : public ::testing::TestWithParam<Coder> {
 protected:
  static EncodeOptions Options() {
    EncodeOptions options;
    options.codec = GetParam().settings;
    return options;
  }
  static bool IsLattice() { return GetParam().settings.offsets == Offsets::kLattice; }
  /// Precision follows the splits of lattice offsets to the last bit, so that nothing is left to
  /// the layers after them.
  static double MostLeft() { return IsLattice() ? 1.001 : 1; }
};
INSTANTIATE_TEST_SUITE_P(Coder, ErrorTest, EveryCoder(), NameOfCoder);

TEST_P(ErrorTest, FallsFromLayerToLayerOnASyntheticSurface) {
  TemporaryFolder folder;
  Mesh mesh = BumpySphere(20000, false, 1);
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kDouble);
  EncodeOptions options = Options();
  options.codec.subtree_vertices = 6000;
  EXPECT_LT(ExpectErrorFalls(mesh, folder.File("scan.ply"), options, 7, 2.5e-4), MostLeft());
}

TEST(LodFit, DrawsLodsOfASmoothSurfaceNearerWithoutMoreBytes) {
  TemporaryFolder folder;
  const Mesh mesh = Torus(120, 60);
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kDouble);
  std::vector<double> means[2];
  for (const bool fit : {false, true}) {
    EncodeOptions options;
    options.codec.lod_fit = fit;
    const std::string folp = folder.File(fit ? "fit.folp" : "plain.folp");
    Encode(folder.File("scan.ply"), folp, options);
    means[fit] = MeanErrors(mesh, folp, 3);
  }
  EXPECT_LT(FileBytes(folder.File("fit.folp")).size() * 100,
            FileBytes(folder.File("plain.folp")).size() * 101);
  const size_t layers = means[0].size();
  ASSERT_EQ(means[1].size(), layers);
  for (size_t layer = 0; layer < layers; ++layer) {
    EXPECT_LE(means[1][layer], means[0][layer] * 1.01) << layer;
  }
  EXPECT_LT(means[1][layers / 2], means[0][layers / 2] * 0.8);
  EXPECT_EQ(means[1].back(), means[0].back());
}

TEST_P(ErrorTest, FallsFromLayerToLayerOnDragon) {
  std::string scan = SharedFile("scans/dragon_vrip.ply");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  if (kSanitized) GTEST_SKIP() << "too large for a build with sanitizers";
  const Mesh mesh = ReadPly(scan).mesh;
  EncodeOptions options = Options();
  options.codec.subtree_vertices = 128 * 1024;
  options.bits = 14;
  EXPECT_LT(ExpectErrorFalls(mesh, scan, options, 100, 1e-5), MostLeft());
  options.bits = 12;  // the last splits' offsets are as fine as the lattice
  const double quarter_step = 0.25 * 0.205 / 4095;  // the mean where a normal lies along an axis
  EXPECT_LT(ExpectErrorFalls(mesh, scan, options, 100, IsLattice() ? quarter_step : 1e-5), 1.001);
}

}  // namespace
}  // namespace folprom::support
