// The three runners, as a parameter of the tests that hold for each of them.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "parallel/runner.h"

namespace folprom::parallel {

struct RunnerCase {
  const char* name;
  std::function<std::unique_ptr<Runner>()> make;
};

inline void PrintTo(const RunnerCase& runner, std::ostream* out) { *out << runner.name; }

inline std::vector<RunnerCase> AllRunners() {
  return {{"Serial", [] { return MakeSerialRunner(); }},
          {"Tbb1", [] { return MakeTbbRunner(1); }},
          {"Tbb2", [] { return MakeTbbRunner(2); }},
          {"Tbb8", [] { return MakeTbbRunner(8); }},
          {"TbbAll", [] { return MakeTbbRunner(0); }},
          {"Shuffled", [] { return MakeShuffledRunner(7); }}};
}

class EachRunner : public testing::TestWithParam<RunnerCase> {
 protected:
  std::unique_ptr<Runner> runner_ = GetParam().make();
};

inline std::string RunnerName(const testing::TestParamInfo<RunnerCase>& info) {
  return info.param.name;
}

}  // namespace folprom::parallel
