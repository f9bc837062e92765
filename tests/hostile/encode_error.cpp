#include "tests/hostile/encode_error.h"

#include <gtest/gtest.h>

#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::hostile {

std::string EncodeError(const std::string& scan, EncodeOptions options) {
  TemporaryFolder folder;
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  options.temporary_folder = folder.path();
  auto report = EncodeFile(scan, folder.File("out.folp"), options, *runner, progress);
  if (!report.ok()) {
    EXPECT_EQ(report.error().kind, ErrorKind::kInput) << scan << ": " << report.error().message;
    EXPECT_TRUE(folder.Names().empty()) << scan;
    EXPECT_FALSE(report.error().message.empty());
    return report.error().message;
  }
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"out.folp"}) << scan;
  DecodeOptions decode;
  decode.temporary_folder = folder.path();
  auto verified = VerifyFile(folder.File("out.folp"), scan, decode, *runner, progress);
  EXPECT_TRUE(verified.ok()) << scan;
  if (verified.ok()) {
    EXPECT_TRUE(verified->lossless) << scan << ": " << verified->reason;
  }
  return "";
}

std::string EncodeErrorOfBytes(std::string_view bytes, const EncodeOptions& options,
                               const std::string& name) {
  TemporaryFolder folder;
  WriteFile(folder.File(name), bytes);
  return EncodeError(folder.File(name), options);
}

}  // namespace folprom::hostile
