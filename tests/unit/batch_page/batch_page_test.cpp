// The page of a batch: complete, escaped, and with nothing from outside.
#include "apps/batch/batch_page.h"

#include <gtest/gtest.h>

#include <regex>

#include "apps/folprom/markup.h"

namespace folprom::batch {
namespace {

OperationResult Result(const std::string& scan, Operation operation, Status status) {
  OperationResult result;
  result.job = "job1";
  result.scan = scan;
  result.operation = operation;
  result.status = status;
  result.input = "/scans/" + scan;
  result.folp = "/out/" + scan + ".folp";
  return result;
}

// Two scans: one encoded, verified, decoded and measured; one that failed.
BatchReport TwoScans() {
  BatchReport report;
  report.program = "folprom 0.1.0";
  report.job_file = "/jobs/scans.toml";
  report.scans = 2;
  report.scans_done = report.scans_failed = 1;
  OperationResult encode = Result("good.ply", Operation::kEncode, Status::kDone);
  encode.input_bytes = 4096;
  encode.output_bytes = 1024;
  encode.vertices = 1234;
  encode.faces = 2345;
  encode.bits_per_vertex = 6.64;
  encode.seconds = 75.5;
  encode.peak_memory_bytes = uint64_t{300} << 20;
  OperationResult verify = Result("good.ply", Operation::kVerify, Status::kDone);
  verify.verified = true;
  OperationResult rd = Result("good.ply", Operation::kRd, Status::kUpToDate);
  rd.vertices = 1234;
  rd.points = {{1, 0.97, 100, 3, 55, 77, 0.5, 0.6, 0.7, 0.001},
               {4, 3.9, 400, 9, 555, 777, 0.05, 0.06, 0.07, 0.0001}};
  OperationResult failed = Result("bad.ply", Operation::kEncode, Status::kFailed);
  failed.error = "/scans/bad.ply: the header ends too early";
  failed.exit_code = 3;
  report.results = {encode, verify, rd, failed};
  return report;
}

size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool Has(const std::string& text, const std::string& part) { return Count(text, part) > 0; }

// Every element that is opened is closed, in the right order.
void ExpectBalanced(const std::string& page) {
  const std::regex tag("<(/?)([a-z0-9]+)([^<>]*?)(/?)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(page.begin(), page.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if (name == "meta" || name == "link" || name == "img" || name == "br") continue;
    if ((*it)[4] == "/") continue;
    if ((*it)[1] == "/") {
      ASSERT_FALSE(open.empty()) << name;
      ASSERT_EQ(open.back(), name) << it->position();
      open.pop_back();
    } else {
      open.push_back(name);
    }
  }
  EXPECT_TRUE(open.empty());
}

std::string Body(const std::string& page) {
  const size_t begin = page.find("</head>") + 7;
  return page.substr(begin, page.rfind("</html>") - begin);
}

TEST(BatchPage, TellsOfEveryScan) {
  const std::string page = PageOf(TwoScans(), {});
  for (const char* part :
       {"good.ply", "bad.ply", "scans.toml", "folprom 0.1.0", "1 of 2", "1,234", "2,345", "4.0 KiB",
        "1.0 KiB", "25.0 %", "6.64", "75.5 s", "300.0 MiB", "lossless", "failed", "up to date"}) {
    EXPECT_TRUE(Has(page, part)) << part;
  }
  EXPECT_EQ(Count(page, "<tr><td><a href=\"#scan-"), 2u);
  EXPECT_EQ(Count(page, "<section "), 2u);
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
}

TEST(BatchPage, TellsWhatFailedAtItsTop) {
  const std::string page = PageOf(TwoScans(), {});
  EXPECT_TRUE(Has(page, "What failed"));
  EXPECT_LT(page.find("the header ends too early"), page.find("<h2>Scans</h2>"));
  EXPECT_EQ(Count(page, "the header ends too early"), 2u);
  BatchReport fine = TwoScans();
  fine.results.pop_back();
  EXPECT_FALSE(Has(PageOf(fine, {}), "What failed"));
  fine.interrupted = true;
  EXPECT_TRUE(Has(PageOf(fine, {}), "was interrupted"));
}

TEST(BatchPage, ShowsACurveWhereOneWasMeasured) {
  const std::string page = PageOf(TwoScans(), {});
  EXPECT_EQ(Count(page, "<svg "), 1u);
  EXPECT_TRUE(Has(page, "rate and distortion"));
  EXPECT_TRUE(Has(page, "<td>4 bpv</td>"));
}

TEST(BatchPage, ShowsPicturesOrWhyThereAreNone) {
  PagePicture drawn{"55 vertices", "0.97 bits per vertex", {1, 2, 3}, ""};
  PagePicture missing{"bad.ply", "", {}, "to draw it takes too much"};
  const std::string page = PageOf(TwoScans(), {{drawn, drawn}, {missing}});
  EXPECT_EQ(Count(page, "src=\"data:image/png;base64,AQID\""), 2u);
  EXPECT_EQ(Count(page, "to draw it takes too much"), 1u);
  EXPECT_EQ(Count(page, "<figure>"), 3u);
}

TEST(BatchPage, NeedsNothingFromOutside) {
  PagePicture drawn{"55 vertices", "", {1, 2, 3}, ""};
  const std::string page = PageOf(TwoScans(), {{drawn}, {}});
  for (const char* part :
       {"http:", "https:", "//", "<script", "@import", "url(", "<iframe", "onload="}) {
    EXPECT_FALSE(Has(page, part)) << part;
  }
  for (const char* attribute : {"src=\"", "href=\""}) {
    for (size_t at = page.find(attribute); at != std::string::npos;
         at = page.find(attribute, at + 1)) {
      const std::string value = page.substr(at + std::string(attribute).size(), 5);
      EXPECT_TRUE(value == "data:" || value[0] == '#') << value;
    }
  }
}

TEST(BatchPage, EscapesAllText) {
  const std::string evil = "</td><script>alert(\"1\")</script>&'\n\x01\xff";
  BatchReport report = TwoScans();
  report.program = report.job_file = report.started = evil;
  for (OperationResult& result : report.results) {
    result.scan += evil;
    for (std::string* text : {&result.job, &result.input, &result.folp, &result.output,
                              &result.reason, &result.settings, &result.lod, &result.error}) {
      *text = evil;
    }
    result.warnings = {evil};
  }
  const PagePicture picture{evil, evil, {1}, ""}, missing{evil, evil, {}, evil};
  const std::string page = PageOf(report, {{picture, missing}, {}});
  EXPECT_FALSE(Has(page, "<script"));
  EXPECT_FALSE(Has(page, "\x01"));
  EXPECT_FALSE(Has(page, "\xff"));
  EXPECT_FALSE(Has(page, "alert(\""));
  EXPECT_TRUE(Has(page, "&lt;/td&gt;&lt;script&gt;"));
  ExpectBalanced(Body(page));
}

TEST(BatchPage, ClosesWhatItOpens) {
  const PagePicture picture{"1 vertex", "", {1}, ""};
  ExpectBalanced(Body(PageOf(TwoScans(), {{picture}, {picture}})));
  ExpectBalanced(Body(PageOf({}, {})));
  BatchReport every = TwoScans();
  for (const Operation operation :
       {Operation::kEncode, Operation::kDecode, Operation::kVerify, Operation::kRd}) {
    for (const Status status : {Status::kDone, Status::kUpToDate, Status::kFailed,
                                Status::kInterrupted, Status::kNotRun}) {
      every.results.push_back(Result("x", operation, status));
    }
  }
  every.results.back().verified = false;
  ExpectBalanced(Body(PageOf(every, {})));
}

TEST(Markup, WritesBase64) {
  const auto address = [](const std::string& text) {
    return cli::PngAddress({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  };
  const std::string head = "data:image/png;base64,";
  EXPECT_EQ(address(""), head);
  EXPECT_EQ(address("f"), head + "Zg==");
  EXPECT_EQ(address("fo"), head + "Zm8=");
  EXPECT_EQ(address("foo"), head + "Zm9v");
  EXPECT_EQ(address("foobar"), head + "Zm9vYmFy");
  EXPECT_EQ(address("\xff\xfe\xfd"), head + "//79");
}

TEST(Markup, KeepsWhatIsHarmless) {
  EXPECT_EQ(cli::Escaped("B\xc3\xbcste 1.ply"), "B\xc3\xbcste 1.ply");
  EXPECT_EQ(cli::Escaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(cli::Escaped("\xc3"), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace folprom::batch
