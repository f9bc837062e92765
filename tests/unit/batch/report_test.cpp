// The report as JSON and back, names of outputs, and the budgets.
#include <gtest/gtest.h>

#include "apps/batch/batch_display.h"
#include "apps/batch/batch_report.h"
#include "apps/batch/budget.h"
#include "apps/batch/name_pattern.h"

namespace folprom::batch {
namespace {

OperationResult FullResult() {
  OperationResult r;
  r.job = "j";
  r.scan = "s.ply";
  r.operation = Operation::kRd;
  r.status = Status::kUpToDate;
  r.input = "/s.ply";
  r.output = "/s.rd.json";
  r.vertices = 3;
  r.error_bound = 0.5;
  r.verified = false;
  r.exit_code = 4;
  r.error = "e";
  r.warnings = {"w"};
  r.points = {{1, 0.9, 10, 2, 3, 4, 0.1, 0.2, 0.3, 0.01}, {2, 2, 20, 3, 4, 5, 0.1, 0.2, 0.3, {}}};
  return r;
}

TEST(BatchReportJson, ComesBackAsItWas) {
  BatchReport report;
  report.program = "folprom 1";
  report.threads = 7;
  report.interrupted = true;
  report.results = {FullResult(), OperationResult()};
  const Json json = ToJson(report);
  auto back = ReportFromJson(Json::parse(json.dump()));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(ToJson(*back), json);
}

TEST(BatchReportJson, RefusesEachMissingAndWrongField) {
  const Json whole = ToJson(FullResult());
  for (const auto& [key, value] : whole.items()) {
    Json cut = whole;
    cut.erase(key);
    EXPECT_FALSE(OperationFromJson(cut)) << key;
    Json wrong = whole;
    wrong[key] = Json::object({{"x", 1}});
    EXPECT_FALSE(OperationFromJson(wrong)) << key;
  }
  Json unknown = whole;
  unknown["status"] = "perhaps";
  EXPECT_FALSE(OperationFromJson(unknown));
  Json later = ToJson(BatchReport());
  later["schema"] = kReportSchema + 1;
  EXPECT_FALSE(ReportFromJson(later));
}

TEST(NamePattern, FillsFieldsIn) {
  const NameFields fields{"a", "a.ply", "x/y", "j"};
  EXPECT_EQ(ExpandPattern("{stem}", fields), "a");
  EXPECT_EQ(ExpandPattern("{job}/{folder}/lod-{name}", fields), "j/x/y/lod-a.ply");
  EXPECT_EQ(ExpandPattern("{folder}/{stem}", {"a", "a.ply", "", "j"}), "a");
  for (const char* wrong : {"", "{", "}", "{}", "{stem", "stem}", "{{stem}}", "{x}", "{stem}/",
                            "/{stem}", "../{stem}", "a/../../{stem}", ".{stem}"}) {
    EXPECT_FALSE(CheckPattern(wrong)) << wrong;
  }
}

TEST(BatchBudget, SharesNeverExceedIt) {
  Budget budget(4, 1000);
  const auto half = budget.Take({2, 100});
  ASSERT_TRUE(half);
  EXPECT_EQ(half->threads, 2);
  EXPECT_EQ(half->memory_bytes, 500);
  EXPECT_FALSE(budget.Take({3, 0}));
  EXPECT_FALSE(budget.Take({1, 501}));
  const auto rest = budget.Take({1, 450});
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->memory_bytes, 450);
  EXPECT_FALSE(budget.Take({1, 51}));
  budget.GiveBack(*half);
  budget.GiveBack(*rest);
  // What is larger than all of it runs alone, with all of it.
  const auto all = budget.Take({9, 5000});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->threads, 4);
  EXPECT_EQ(all->memory_bytes, 1000);
  EXPECT_FALSE(budget.Take({1, 1}));
}

TEST(BatchProgress, TellsScansRateTimeAndMemory) {
  BatchReading reading;
  reading.scans = 340;
  reading.scans_done = 12;
  reading.scans_failed = 1;
  reading.fraction = 0.35;
  reading.seconds_left = 40;
  reading.vertices_per_second = 180000;
  reading.memory_bytes = uint64_t{1200} << 20;
  EXPECT_EQ(TextOf(reading),
            "12 of 340 scans  1 failed  35 %  180.0 k vertices/s  0:40 left  1.2 GiB");
  EXPECT_EQ(RunningText(reading), "");
  reading.running = {{"j", "a.ply", Operation::kEncode, {"encode", "vertices", 50, 100, 10, 0}},
                     {"j", "b.ply", Operation::kVerify, {}}};
  EXPECT_EQ(RunningText(reading),
            "encode a.ply: encode  50 %  5.0 vertices/s  0:10 left  and 1 more");
  EXPECT_EQ(JsonOf(reading).at("running")[0].at("fraction"), 0.5);
}

}  // namespace
}  // namespace folprom::batch
