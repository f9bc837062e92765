// What an encoding keeps of itself comes back as it was, or not at all.
#include "engine/encode_state.h"

#include <gtest/gtest.h>

#include "engine/encode_estimate.h"

namespace folprom::hostile {
namespace {

template <class State>
std::vector<uint8_t> BytesOf(const State& state) {
  RecordWriter record;
  Write(state, &record);
  return record.bytes();
}

/// Bytes of what is read are those that were written; no shorter record is read.
template <class State>
void ExpectRoundTrip(const State& state) {
  const std::vector<uint8_t> bytes = BytesOf(state);
  State read;
  RecordReader whole(bytes);
  Read(&whole, &read);
  EXPECT_EQ(BytesOf(read), bytes);
  for (size_t size = 0; size < bytes.size(); ++size) {
    RecordReader cut{std::span(bytes).first(size)};
    EXPECT_THROW(Read(&cut, &read), Failure) << size;
  }
}

PartitionState SomePartition() {
  PartitionState state;
  state.resolution.lattice.origin = {1.5, -2, 3};
  state.resolution.lattice.unit = 0.25;
  state.resolution.lattice.extent = {10, 20, 30};
  state.resolution.tolerance = 0.125;
  state.typical_edge = 3.5;
  state.peak_spill_bytes = 12345;
  state.summaries.resize(2);
  state.summaries[0] = {7, 8, 9, {1, 2, 3}, {4, 5, 6}, {1}};
  state.summaries[1] = {17, 18, 19, {11, 12, 13}, {14, 15, 16}, {0}};
  state.ranges = {{3, 200}};
  state.hashes = {{1, 2}, {3, 4}};
  return state;
}

TEST(EncodeState, PartitionComesBackOrNotAtAll) {
  ExpectRoundTrip(PartitionState());
  PartitionState state = SomePartition();
  ExpectRoundTrip(state);
  state.resolution.lattice.exact.emplace();
  state.resolution.lattice.exact->first = {-5, 0, 5};
  state.resolution.lattice.exact->step.exponent = 6;
  ExpectRoundTrip(state);
}

TEST(EncodeState, OutcomesComeBackOrNotAtAll) {
  SubtreeOutcome subtree;
  subtree.inner_bytes = {1, 0, 3};
  subtree.distance = {4.5, 2, 0};
  subtree.vertices = {1, 5, 9};
  subtree.faces = {0, 4, 12};
  subtree.active = {true, false, true};
  subtree.digest = {99, 98};
  subtree.meters.connectivity.sides = 7;
  subtree.meters.attributes = {6, 5};
  subtree.inner_hash = 4;
  ExpectRoundTrip(subtree);
  SeamOutcome seam;
  seam.bytes = {3, 2};
  seam.faces = {1, 2};
  seam.active = {false, true};
  seam.face_digest = 77;
  ExpectRoundTrip(seam);
}

TEST(EncodeState, CountsBeyondTheRecordAllocateNothing) {
  RecordWriter record;
  record.Put(~uint64_t{0});
  RecordReader reader(record.bytes());
  std::vector<uint32_t> values;
  EXPECT_THROW(reader.TakeAll(&values), Failure);
  EXPECT_TRUE(values.empty());
}

// One disk has room for either, but not for both.
TEST(EncodeRoom, OneDiskMustHoldBothAndTwoDisksTheirOwn) {
  const RoomNeeded spill{"/a", {1, 100}, 70};
  EXPECT_NO_THROW(CheckRoom(spill, {"/b", {2, 50}, 50}));
  EXPECT_NO_THROW(CheckRoom(spill, {"/b", {1, 100}, 30}));
  const auto error_of = [](const RoomNeeded& first, const RoomNeeded& second) {
    try {
      CheckRoom(first, second);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kOutput);
      return failure.error().message;
    }
    return std::string();
  };
  EXPECT_TRUE(error_of(spill, {"/b", {1, 100}, 31}).starts_with("/a: no room"));
  EXPECT_TRUE(error_of({"/a", {1, 69}, 70}, {"/b", {2, 50}, 5}).starts_with("/a: no room"));
  EXPECT_TRUE(error_of(spill, {"/b", {2, 50}, 51}).starts_with("/b: no room"));
}

}  // namespace
}  // namespace folprom::hostile
