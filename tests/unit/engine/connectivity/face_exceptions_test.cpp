#include "engine/connectivity/face_exceptions.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

Complex OneTriangle() {
  Complex complex;
  for (int v = 0; v < 3; ++v) complex.AddVertex();
  for (uint32_t v = 0; v < 3; ++v) complex.AddEdge(v, (v + 1) % 3);
  complex.AddFace(0, 1, 2);
  return complex;
}

std::vector<uint8_t> Coded(const Complex& complex, const FaceCensus& census) {
  BitEncoder encoder;
  FaceExceptions(~uint64_t{0} / 4).Code(encoder, complex, &census);
  return encoder.TakeSegment();
}

TEST(FaceExceptions, GiveBackCopiesAndDegenerateFaces) {
  const Complex complex = OneTriangle();
  const std::vector<Face> originals{{0, 1, 2}, {0, 1, 2}, {0, 2, 1}, {1, 1, 2}, {2, 2, 2}};
  const FaceCensus census = TakeCensus(complex, originals, {0, 0, 0, kNone, kNone});
  const std::vector<uint8_t> bytes = Coded(complex, census);
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  FaceExceptions decoded(originals.size());
  decoded.Code(decoder, complex, nullptr);
  EXPECT_EQ(decoded.FaceCount(complex), originals.size());
  std::vector<Face> faces;
  decoded.AppendFaces(complex, &faces);
  EXPECT_EQ(faces.size(), originals.size());
}

TEST(FaceExceptions, AnnouncedBillionsCostNoMemoryAndAreRefused) {
  const Complex complex = OneTriangle();
  FaceCensus census = TakeCensus(complex, {{0, 1, 2}}, {0});
  census.forward[0] = 4'000'000'000;
  const std::vector<uint8_t> bytes = Coded(complex, census);
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  FaceExceptions decoded(uint64_t{1} << 40);
  decoded.Code(decoder, complex, nullptr);
  EXPECT_EQ(decoded.FaceCount(complex), 4'000'000'000u);
  std::vector<Face> faces;
  try {
    decoded.AppendFaces(complex, &faces);
    FAIL() << "48 GB of faces";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kLimit);
  }
  EXPECT_EQ(faces.capacity(), 0u);
}

}  // namespace
}  // namespace folprom
