#include <gtest/gtest.h>

#include "partition_check.h"

namespace folprom::partition {
namespace {

template <class Action>
Error FailureOf(const Action& action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure.error();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(PartitionFailure, RejectsSubtreesOfNoVertices) {
  const TestSource source(WavySheet(3, 3));
  PartitionSettings settings;
  settings.subtree_vertices = 0;
  const Error error =
      FailureOf([&] { PartitionOf(source, LatticeOf(source.mesh(), 8), settings); });
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
}

TEST(PartitionFailure, CancelStopsThePartition) {
  const TestSource source(WavySheet(50, 50));
  const auto runner = parallel::MakeTbbRunner(2);
  io::SpillDirectory spill("");
  parallel::Progress progress;
  progress.Cancel();
  PartitionSettings settings;
  settings.subtree_vertices = 100;
  EXPECT_THROW(PartitionScan(source, LatticeOf(source.mesh(), 12), settings, kTestMemory, *runner,
                             spill, progress),
               parallel::Cancelled);
}

TEST(PartitionFailure, NamesTheFileThatCannotBeWritten) {
  const TestSource source(WavySheet(10, 10));
  const auto runner = parallel::MakeSerialRunner();
  io::SpillDirectory spill("");
  io::WriteSpillFile(spill, "partition.vertices", {});
  parallel::Progress progress;
  const Error error = FailureOf([&] {
    PartitionScan(source, LatticeOf(source.mesh(), 12), {}, kTestMemory, *runner, spill, progress);
  });
  EXPECT_EQ(error.kind, ErrorKind::kOutput);
  EXPECT_NE(error.message.find("partition.vertices"), std::string::npos) << error.message;
}

}  // namespace
}  // namespace folprom::partition
