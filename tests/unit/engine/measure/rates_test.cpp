#include <gtest/gtest.h>

#include "folprom/folprom.h"
#include "folprom/measure.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"

namespace folprom::measure {
namespace {

class Rates : public testing::Test {
 protected:
  RateCurve Run(const std::vector<double>& rates) {
    EncodeOptions options;
    options.temporary_folder = folder_.path();
    return MeasureRates(scan_, options, rates, 20'000, *runner_, progress_).value();
  }
  void SetUp() override {
    support::WritePly(scan_, support::BumpySphere(4000, false, 1), support::CoordinateType::kFloat);
  }

  support::TemporaryFolder folder_;
  const std::string scan_ = folder_.File("scan.ply");
  const std::unique_ptr<parallel::Runner> runner_ = parallel::MakeTbbRunner(2);
  parallel::Progress progress_;
};

TEST_F(Rates, ErrorFallsAsTheRateRises) {
  const RateCurve curve = Run({2, 8, 1000});
  ASSERT_EQ(curve.points.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const RatePoint& point = curve.points[i];
    EXPECT_LE(point.bits_per_vertex, point.requested);
    EXPECT_DOUBLE_EQ(point.bits_per_vertex,
                     static_cast<double>(point.bytes * 8) / static_cast<double>(curve.vertices));
    if (i == 0) continue;
    EXPECT_GT(point.vertices, curve.points[i - 1].vertices);
    EXPECT_LT(point.comparison.forward.mean, curve.points[i - 1].comparison.forward.mean);
    EXPECT_LT(point.comparison.backward.mean, curve.points[i - 1].comparison.backward.mean);
  }
  EXPECT_EQ(curve.points.back().bytes, curve.bytes);
  EXPECT_EQ(curve.points.back().faces, curve.faces);
}

TEST_F(Rates, AgreeWithEncodingDecodingAndComparing) {
  const RateCurve curve = Run({3});
  const std::string folp = folder_.File("scan.folp"), lod = folder_.File("lod.ply");
  EncodeFile(scan_, folp, {}, *runner_, progress_).value();
  DecodeOptions options;
  options.bits_per_vertex = 3;
  const DecodeReport report = DecodeFile(folp, lod, options, *runner_, progress_).value();
  const Comparison c = CompareFiles(scan_, lod, {20'000, "", {}}, *runner_, progress_).value();
  EXPECT_EQ(curve.points[0].vertices, report.vertices);
  EXPECT_EQ(curve.points[0].bytes, ReadInfo(folp).value().layers[report.layers - 1].end_byte);
  EXPECT_EQ(curve.points[0].comparison.forward.mean, c.forward.mean);
  EXPECT_EQ(curve.points[0].comparison.backward.max, c.backward.max);
}

TEST_F(Rates, LeavesNothingBehind) {
  Run({1, 2});
  EXPECT_EQ(folder_.Names(), std::vector<std::string>{"scan.ply"});
}

}  // namespace
}  // namespace folprom::measure
