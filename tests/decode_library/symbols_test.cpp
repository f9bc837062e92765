// What the decoder library asks the linker for.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/decode_library/program_files.h"

namespace folprom::decode_library {
namespace {

TEST(Symbols, OfTheDecoderNeedNoThreadsAndNoOtherLibrary) {
  std::istringstream archives(FOLPROM_DECODE_ARCHIVES);
  int seen = 0;
  for (std::string archive; std::getline(archives, archive, ':');) {
    std::istringstream symbols(OutputOf({FOLPROM_NM, "-C", "-u", archive}));
    for (std::string line; std::getline(symbols, line);) {
      ++seen;
      for (const char* foreign :
           {"tbb", "openvdb", "spdlog", "fmt::", "pthread_create", "std::thread", "std::mutex",
            "std::condition_variable", "std::filesystem", "mmap", "Eigen", "nlohmann",
            "folprom::parallel"}) {
        EXPECT_EQ(line.find(foreign), std::string::npos) << archive << " needs " << line;
      }
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(Symbols, OfThisProgramComeFromNoOtherLibrary) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    for (const char* foreign :
         {"libtbb", "libopenvdb", "libspdlog", "libfmt", "libHalf", "libblosc"}) {
      EXPECT_EQ(line.find(foreign), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace folprom::decode_library
